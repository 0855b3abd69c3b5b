/* Tests of the budgets of signed links: charges, refusals when the table is full, and the reuse of entries of expired
 * links. */
#include "server/http/link_budgets.h"

#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { NOW = 1000000, LATER = NOW + 100 };

static struct kd_link link_of(uint64_t id, uint64_t budget_ms)
{
    return (struct kd_link) { .on = true, .id = id, .terms = { .expires_s = LATER, .budget_ms = budget_ms } };
}

static void a_budget_is_spent(void **state)
{
    (void)state;
    struct kd_link_budgets *all = kd_link_budgets_create();
    const struct kd_link one = link_of(7, 100), other = link_of(8, 100), endless = link_of(9, 0);
    assert_int_equal(kd_link_budget(all, &one, NOW), KD_LINK_LEFT);
    kd_link_charge(all, &one, 60, NOW);
    assert_int_equal(kd_link_budget(all, &one, NOW), KD_LINK_LEFT);
    kd_link_charge(all, &one, 40, NOW);
    assert_int_equal(kd_link_budget(all, &one, NOW), KD_LINK_SPENT);
    assert_int_equal(kd_link_budget(all, &other, NOW), KD_LINK_LEFT);
    kd_link_charge(all, &endless, 1e9, NOW);
    assert_int_equal(kd_link_budget(all, &endless, NOW), KD_LINK_LEFT);
    kd_link_budgets_destroy(all);
}

static void a_full_table_takes_no_other_link_until_one_has_expired(void **state)
{
    (void)state;
    struct kd_link_budgets *all = kd_link_budgets_create();
    for (uint64_t i = 0; i < KD_LINK_BUDGETS; i++) {
        const struct kd_link link = link_of(i + 1, 100);
        kd_link_charge(all, &link, 100, NOW);
    }
    const struct kd_link last = link_of(KD_LINK_BUDGETS, 100), next = link_of(KD_LINK_BUDGETS + 1, 100);
    assert_int_equal(kd_link_budget(all, &last, NOW), KD_LINK_SPENT);
    assert_int_equal(kd_link_budget(all, &next, NOW), KD_LINK_CROWDED);
    assert_int_equal(kd_link_budget(all, &next, LATER + KD_LINK_LEEWAY_S), KD_LINK_CROWDED);
    assert_int_equal(kd_link_budget(all, &next, LATER + KD_LINK_LEEWAY_S + 1), KD_LINK_LEFT);
    kd_link_budgets_destroy(all);
}

static struct kd_link_budgets *opened(const char *folder)
{
    struct kd_error error = { 0 };
    struct kd_link_budgets *all = kd_link_budgets_create();
    if (kd_link_budgets_open(all, folder, &error))
        fail_msg("%s", error.message);
    return all;
}

/* Each charge is written to the file at once, so that no charge is lost if the server is killed. In the file, as in
 * memory, entries of expired links are reused. */
static void a_folder_keeps_them(void **state)
{
    (void)state;
    char folder[] = "/tmp/kd-link-budgets-XXXXXX", path[64];
    const struct kd_link one = link_of(7, 100), other = link_of(8, 100), late = link_of(9, 10);
    assert_non_null(mkdtemp(folder));
    struct kd_link_budgets *killed = opened(folder);
    kd_link_charge(killed, &one, 60, NOW);
    kd_link_charge(killed, &other, 30, NOW);
    kd_link_charge(killed, &one, 40, NOW);
    struct kd_link_budgets *next = opened(folder);
    assert_int_equal(kd_link_budget(next, &one, NOW), KD_LINK_SPENT);
    assert_int_equal(kd_link_budget(next, &other, NOW), KD_LINK_LEFT);
    kd_link_charge(next, &other, 70, NOW);
    assert_int_equal(kd_link_budget(next, &other, NOW), KD_LINK_SPENT);
    kd_link_charge(next, &late, 10, LATER + KD_LINK_LEEWAY_S + 1);
    kd_link_budgets_destroy(next);
    kd_link_budgets_destroy(killed);
    next = opened(folder);
    assert_int_equal(kd_link_budget(next, &one, NOW), KD_LINK_LEFT); /* the entry now belongs to another link */
    assert_int_equal(kd_link_budget(next, &other, NOW), KD_LINK_SPENT);
    assert_int_equal(kd_link_budget(next, &late, NOW), KD_LINK_SPENT);
    kd_link_budgets_destroy(next);
    snprintf(path, sizeof path, "%s/" KD_LINK_BUDGETS_FILE, folder);
    assert_int_equal(unlink(path) | rmdir(folder), 0);
}

static void write_file(const char *path, const void *data, size_t size)
{
    const int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    assert_true(fd >= 0 && write(fd, data, size) == (ssize_t)size);
    close(fd);
}

/* A file of another kind is refused and not changed. Damaged entries count as unused. A truncated file is read up to
 * its end. */
static void a_damaged_file(void **state)
{
    (void)state;
    char folder[] = "/tmp/kd-link-budgets-XXXXXX", path[64], text[24 + 24 + 5] = "kerrd link budgets 1\n";
    const struct kd_link one = link_of(7, 100);
    const uint64_t numbers[2] = { 7, LATER };
    const double ms[] = { 100, -1, (double)INFINITY, (double)NAN };
    struct kd_error error = { 0 };
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/" KD_LINK_BUDGETS_FILE, folder);
    for (size_t i = 0; i < sizeof ms / sizeof *ms; i++) {
        memcpy(text + 24, numbers, sizeof numbers);
        memcpy(text + 40, &ms[i], sizeof ms[i]);
        write_file(path, text, sizeof text);
        struct kd_link_budgets *all = opened(folder);
        assert_int_equal(kd_link_budget(all, &one, NOW), i ? KD_LINK_LEFT : KD_LINK_SPENT);
        kd_link_budgets_destroy(all);
    }
    for (size_t size = 5; size <= sizeof text; size += 24) {
        text[0] = size > 24 ? 'K' : 'k';
        write_file(path, text, size);
        struct kd_link_budgets *all = kd_link_budgets_create();
        assert_int_equal(kd_link_budgets_open(all, folder, &error), KD_EINVAL);
        assert_non_null(strstr(error.message, "is not a file of link budgets; remove it"));
        kd_link_budgets_destroy(all);
    }
    assert_int_equal(unlink(path) | rmdir(folder), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_budget_is_spent),
        cmocka_unit_test(a_full_table_takes_no_other_link_until_one_has_expired),
        cmocka_unit_test(a_folder_keeps_them),
        cmocka_unit_test(a_damaged_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
