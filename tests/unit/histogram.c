/* Tests of histograms for /metrics: the bucket of a duration, and the cost of counting one. */
#include "base/clock.h"
#include "server/http/histogram.h"
#include "server/http/request_id.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static struct kd_histogram one;

static const char *shown(struct kd_buffer *out)
{
    out->size = 0;
    assert_int_equal(kd_histogram_write(&one, out, "t", "a=\"b\""), KD_OK);
    return (const char *)out->data;
}

static void test_buckets(void **state)
{
    struct kd_buffer out = { 0 };
    (void)state;
    memset(&one, 0, sizeof one);
    assert_true(kd_histogram_is_empty(&one));
    const double durations[] = { -1, 0, 1, 1.001, 2.5, 99.9, 100, 600000, 600001, 1e7 };
    for (size_t i = 0; i < sizeof durations / sizeof *durations; i++)
        kd_histogram_add(&one, durations[i]);
    assert_false(kd_histogram_is_empty(&one));
    const char *text = shown(&out);
    static const char *const lines[] = {
        "t_bucket{a=\"b\",le=\"0.001\"} 3\n", "t_bucket{a=\"b\",le=\"0.0025\"} 5\n",
        "t_bucket{a=\"b\",le=\"0.05\"} 5\n",  "t_bucket{a=\"b\",le=\"0.1\"} 7\n",
        "t_bucket{a=\"b\",le=\"600\"} 8\n",   "t_bucket{a=\"b\",le=\"+Inf\"} 10\n",
        "t_sum{a=\"b\"} 11200.2054",          "t_count{a=\"b\"} 10\n",
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (!strstr(text, lines[i]))
            fail_msg("%s is not in\n%s", lines[i], text);
    kd_buffer_finish(&out);
}

/* Printed, not judged. */
static void test_cost(void **state)
{
    enum { N = 1000000 };
    (void)state;
    const double begun = kd_clock_ms();
    for (int i = 0; i < N; i++)
        kd_histogram_add(&one, i % 1000);
    print_message("a duration is counted in %.1f ns\n", (kd_clock_ms() - begun) * 1e6 / N);
    char id[KD_REQUEST_ID_MAX + 1];
    const double made = kd_clock_ms();
    for (int i = 0; i < N / 10; i++)
        kd_request_id_choose(NULL, id);
    print_message("an id is made in %.0f ns\n", (kd_clock_ms() - made) * 1e6 / (N / 10));
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_buckets), cmocka_unit_test(test_cost) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
