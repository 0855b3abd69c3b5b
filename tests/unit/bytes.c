/* Tests of the limits on bytes that clients hold. The limits are the total, a client's share, and the reserve for small
 * requests. One client at a time may exceed the total. */
#include "server/http/bytes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static struct kd_bytes *make(bool lone)
{
    struct kd_bytes *b = kd_bytes_create(&(struct kd_bytes_params) { 3, 100, 60, 20, 5, lone });
    assert_non_null(b);
    return b;
}

enum { TAKEN, FULL, OVER_SHARE };
static int take(struct kd_bytes *b, const char *client, size_t n)
{
    bool quota = false;
    return !kd_bytes_take(b, client, n, n, &quota) ? TAKEN : quota ? OVER_SHARE : FULL;
}

static void test_shares(void **state)
{
    struct kd_bytes *b = make(false);
    (void)state;
    assert_int_equal(take(b, "a", 61), OVER_SHARE);
    assert_int_equal(take(b, "a", 59), TAKEN);
    assert_int_equal(take(b, "a", 6), OVER_SHARE);
    kd_bytes_give(b, "a", 59);
    assert_int_equal(take(b, "a", 50), TAKEN);
    assert_int_equal(take(b, "a", 11), OVER_SHARE);
    assert_int_equal(take(b, "b", 51), FULL);
    assert_int_equal(take(b, "b", 50), TAKEN);
    assert_int_equal(kd_bytes_held(b), 100);
    kd_bytes_give(b, "a", 50);
    assert_int_equal(take(b, "b", 11), OVER_SHARE);
    assert_int_equal(take(b, "a", 50), TAKEN);
    kd_bytes_destroy(b);
}

static void test_room_for_small_ones(void **state)
{
    struct kd_bytes *b = make(false);
    (void)state;
    assert_int_equal(take(b, "a", 50), TAKEN);
    assert_int_equal(take(b, "b", 50), TAKEN);
    assert_int_equal(take(b, "c", 6), FULL);
    for (int i = 0; i < 4; i++)
        assert_int_equal(take(b, "c", 5), TAKEN);
    assert_int_equal(take(b, "c", 5), FULL);
    assert_int_equal(take(b, "a", 5), FULL);
    kd_bytes_give(b, "b", 50);
    for (int i = 0; i < 4; i++)
        /* of these 20 bytes, 8 fit into the client's share and 12 exceed it */
        assert_int_equal(take(b, "a", 5), TAKEN);
    assert_int_equal(take(b, "a", 5), OVER_SHARE);
    kd_bytes_destroy(b);
}

/* A client that holds no bytes may take any size that fits beside the bytes of others. If no client holds bytes, any
 * size is allowed. */
static void test_a_lone_one(void **state)
{
    struct kd_bytes *b = make(true);
    (void)state;
    assert_int_equal(take(b, "a", 150), TAKEN);
    assert_int_equal(take(b, "a", 1), OVER_SHARE);
    /* the reserve for small requests is closed while a client exceeds the total */
    assert_int_equal(take(b, "b", 1), FULL);
    kd_bytes_give(b, "a", 150);
    assert_int_equal(take(b, "b", 30), TAKEN);
    assert_int_equal(take(b, "a", 70), TAKEN);
    assert_int_equal(take(b, "a", 5), OVER_SHARE);
    kd_bytes_destroy(b);
}

static void test_what_is_there_already(void **state)
{
    struct kd_bytes *b = make(true);
    (void)state;
    kd_bytes_add(b, "a", 90);
    assert_int_equal(take(b, "a", 0), OVER_SHARE);
    assert_int_equal(take(b, "b", 10), TAKEN);
    kd_bytes_add(b, "b", 200);
    assert_int_equal(kd_bytes_held(b), 300);
    kd_bytes_give(b, "a", 90);
    kd_bytes_give(b, "b", 210);
    assert_int_equal(kd_bytes_held(b), 0);
    kd_bytes_destroy(b);
}

/* There are more clients than entries in the table. Clients without an entry are counted together. At the end all bytes
 * are returned. */
static void test_many_clients(void **state)
{
    struct kd_bytes *b = make(false);
    char name[8];
    (void)state;
    for (int i = 0; i < 6; i++) {
        snprintf(name, sizeof name, "%d", i);
        assert_int_equal(take(b, name, 15), TAKEN);
    }
    assert_int_equal(take(b, "6", 20), OVER_SHARE);
    for (int i = 0; i < 6; i++) {
        snprintf(name, sizeof name, "%d", i);
        kd_bytes_give(b, name, 15);
    }
    assert_int_equal(kd_bytes_held(b), 0);
    assert_int_equal(take(b, "6", 60), TAKEN);
    kd_bytes_destroy(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares),       cmocka_unit_test(test_room_for_small_ones),
        cmocka_unit_test(test_a_lone_one),   cmocka_unit_test(test_what_is_there_already),
        cmocka_unit_test(test_many_clients),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
