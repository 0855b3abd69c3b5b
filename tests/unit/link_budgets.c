/* Tests of the budgets of signed links: what is spent, what a full table refuses, and that expired links make room. */
#include "server/http/link.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { NOW = 1000000, LATER = NOW + 100 };

static struct kd_link link_of(uint64_t id, uint64_t budget_ms)
{
    return (struct kd_link) { .on = true, .id = id, .terms = { .expires_s = LATER, .budget_ms = budget_ms } };
}

static void a_budget_is_spent(void **state)
{
    (void)state;
    struct kd_link_budgets *all = calloc(1, sizeof *all);
    const struct kd_link one = link_of(7, 100), other = link_of(8, 100), endless = link_of(9, 0);
    assert_int_equal(kd_link_budget(all, &one, NOW), KD_LINK_LEFT);
    kd_link_charge(all, &one, 60, NOW);
    assert_int_equal(kd_link_budget(all, &one, NOW), KD_LINK_LEFT);
    kd_link_charge(all, &one, 40, NOW);
    assert_int_equal(kd_link_budget(all, &one, NOW), KD_LINK_SPENT);
    assert_int_equal(kd_link_budget(all, &other, NOW), KD_LINK_LEFT);
    kd_link_charge(all, &endless, 1e9, NOW);
    assert_int_equal(kd_link_budget(all, &endless, NOW), KD_LINK_LEFT);
    free(all);
}

static void a_full_table_takes_no_other_link_until_one_has_expired(void **state)
{
    (void)state;
    struct kd_link_budgets *all = calloc(1, sizeof *all);
    for (uint64_t i = 0; i < KD_LINK_BUDGETS; i++) {
        const struct kd_link link = link_of(i + 1, 100);
        kd_link_charge(all, &link, 100, NOW);
    }
    const struct kd_link last = link_of(KD_LINK_BUDGETS, 100), next = link_of(KD_LINK_BUDGETS + 1, 100);
    assert_int_equal(kd_link_budget(all, &last, NOW), KD_LINK_SPENT);
    assert_int_equal(kd_link_budget(all, &next, NOW), KD_LINK_CROWDED);
    assert_int_equal(kd_link_budget(all, &next, LATER + KD_LINK_LEEWAY_S), KD_LINK_CROWDED);
    assert_int_equal(kd_link_budget(all, &next, LATER + KD_LINK_LEEWAY_S + 1), KD_LINK_LEFT);
    free(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_budget_is_spent),
        cmocka_unit_test(a_full_table_takes_no_other_link_until_one_has_expired),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
