/* Tests that an integral ends at once when its result is no longer needed, at any point of its computation, and leaves
 * no incomplete result in a cache.
 * kd_pause returns true from its Nth call on, for many N. Images and tables of a hole are cached, so each N has a hole
 * whose spin differs by 1e-9. Afterwards some of these integrals are computed without interruption. Their values must
 * be those of an integral that was never interrupted. */
#include "base/pause.h"
#include "integral/request.h"
#include "integral/run.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STOPS = 6, WHOLE = 3, AFTER = 40 }; /* AFTER: largest number of pauses that follow an interruption */
#define APART 1e-9                         /* difference between two spins */

static unsigned long calls, stops_at; /* stops_at: number of the pause that interrupts; 0: none */

static bool count(void)
{
    calls++;
    return stops_at && calls >= stops_at;
}

static const struct {
    const char *name;
    enum kd_integral what;
    const char *fields; /* all fields except the spin */
} cases[] = {
    { "line of a power law", KD_INTEGRAL_LINE, "\"inclination_deg\":60,\"bins\":50,\"tolerance\":0" },
    { "line of a ring", KD_INTEGRAL_LINE,
      "\"inclination_deg\":40,\"emissivity\":\"ring\",\"corona_radius\":5,\"height\":4,\"bins\":20" },
    { "line of a disk-shaped corona", KD_INTEGRAL_LINE,
      "\"inclination_deg\":40,\"emissivity\":\"disk\",\"corona_radius\":8,\"height\":5,\"bins\":20" },
    { "transfer function", KD_INTEGRAL_TRANSFER, "\"inclination_deg\":50,\"rings\":9,\"g_stars\":40" },
    { "spectrum", KD_INTEGRAL_SPECTRUM, "\"inclination_deg\":60,\"returning\":\"yes\",\"frequencies\":20" },
    { "polarised spectrum", KD_INTEGRAL_SPECTRUM,
      "\"inclination_deg\":60,\"limb\":\"scattering\",\"returning\":\"scattered\",\"polarization\":\"yes\","
      "\"frequencies\":20" },
    { "impulse", KD_INTEGRAL_IMPULSE, "\"inclination_deg\":50,\"height\":6,\"bins\":20,\"times\":50" },
    { "lags", KD_INTEGRAL_LAGS,
      "\"inclination_deg\":50,\"emissivity\":\"ring\",\"corona_radius\":4,\"height\":5,\"bins\":5,\"frequencies\":4" },
};

static void begin(int i, double spin, struct kd_integral_request *request)
{
    char text[400];
    struct kd_error error;
    kd_integral_request_init(request, cases[i].what);
    const int length = snprintf(text, sizeof text, "{\"spin\":%.17g,%s}", spin, cases[i].fields);
    if (kd_integral_request_json(request, text, (size_t)length, &error))
        fail_msg("%s: %s", cases[i].name, error.message);
}

/* Computes an integral without an interruption, and copies its last column. */
static double *whole(int i, double spin, size_t *rows)
{
    struct kd_integral_request request;
    struct kd_integral_run run;
    struct kd_error error;
    begin(i, spin, &request);
    calls = stops_at = 0;
    if (kd_integral_run_begin(&run, &request, &error))
        fail_msg("%s: %s", cases[i].name, error.message);
    *rows = run.answer.rows;
    /* the column with the light */
    const int column = cases[i].what == KD_INTEGRAL_LINE ? 2 : cases[i].what == KD_INTEGRAL_SPECTRUM ? 1 : 4;
    double *values = malloc(*rows * sizeof *values);
    assert_non_null(values);
    memcpy(values, run.answer.columns[column], *rows * sizeof *values);
    kd_integral_run_finish(&run);
    kd_integral_request_finish(&request);
    return values;
}

/* Returns false if the integral had ended before. If other threads help, this thread pauses less often than in another
 * run. */
static bool interrupt(int i, double spin, unsigned long at)
{
    struct kd_integral_request request;
    struct kd_integral_run run;
    struct kd_error error = { 0 };
    begin(i, spin, &request);
    calls = 0, stops_at = at;
    const enum kd_status status = kd_integral_run_begin(&run, &request, &error);
    if (!status && calls < at) {
        kd_integral_run_finish(&run);
        kd_integral_request_finish(&request);
        return false;
    }
    if (status != KD_ECANCELLED || calls < at || calls > at + AFTER)
        fail_msg("%s, interrupted at pause %lu: status %d after %lu pauses, %s", cases[i].name, at, status, calls,
                 error.message);
    kd_integral_request_finish(&request);
    return true;
}

static void each_ends_and_leaves_nothing_incomplete(void **state)
{
    (void)state;
    kd_pause_hook = count;
    for (int i = 0; i < (int)(sizeof cases / sizeof *cases); i++) {
        const double spin = 0.9 - 0.01 * i;
        size_t n, m;
        double *want = whole(i, spin, &n);
        const unsigned long all = calls;
        double most = 0;
        int ended = 0;
        for (size_t k = 0; k < n; k++)
            most = fmax(most, fabs(want[k]));
        for (int stop = 0; stop < STOPS; stop++) {
            const double other = spin + APART * (stop + 1);
            ended += interrupt(i, other, 1 + all * (unsigned long)stop / STOPS);
            if (stop % WHOLE != 1)
                continue;
            double *got = whole(i, other, &m);
            assert_int_equal(m, n);
            for (size_t k = 0; k < n; k++)
                if (!(fabs(got[k] - want[k]) <= 1e-5 * most))
                    fail_msg("%s, row %zu: %.9g after an interruption, not %.9g", cases[i].name, k, got[k], want[k]);
            free(got);
        }
        print_message("%s: %lu pauses, %d of %d interrupted\n", cases[i].name, all, ended, STOPS);
        assert_in_range(ended, STOPS / 2, STOPS);
        free(want);
    }
    kd_pause_hook = NULL;
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(each_ends_and_leaves_nothing_incomplete) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
