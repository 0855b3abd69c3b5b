#include "render/selftest/parts.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

void kd_selftest_begin(struct kd_selftest_row *row, const char *source, const char *by, const char *what, ...)
{
    va_list args;
    *row = (struct kd_selftest_row) { .source = source, .ok = true };
    va_start(args, what);
    vsnprintf(row->what, sizeof row->what, what, args);
    va_end(args);
    snprintf(row->by, sizeof row->by, "%s", by);
}

/* The error as a fraction of its bound. If the bound is 0, the result is 0 for no error, and infinite for any other. */
static double share(double error, double bound) { return error <= 0 ? 0 : error / bound; }

void kd_selftest_compare(struct kd_selftest_row *row, double error, double bound)
{
    error = isnan(error) ? INFINITY : fabs(error);
    if (row->compared == 0 || share(error, bound) > share(row->error, row->bound)) {
        row->error = error;
        row->bound = bound;
    }
    row->compared++;
    row->ok = row->ok && error <= bound;
}

enum kd_status kd_selftest_end(const struct kd_selftest *test, struct kd_selftest_row *row)
{
    row->ok = row->ok && row->compared > 0;
    if (!test->row(test->user, row))
        return kd_error_set(test->error, KD_ECANCELLED, "the self-test was cancelled");
    return KD_OK;
}

enum kd_status kd_selftest_run(struct kd_renderer *renderer, const struct kd_selftest_reference *reference,
                               kd_selftest_fn row, void *user, struct kd_error *error)
{
    const struct kd_selftest test = { renderer, reference, row, user, error };
    enum kd_status status;
    KD_TRY(kd_selftest_orbits(&test));
    KD_TRY(kd_selftest_rays(&test));
    KD_TRY(kd_selftest_maps(&test));
    KD_TRY(kd_selftest_light(&test));
    KD_TRY(kd_selftest_same(&test));
done:
    return status;
}
