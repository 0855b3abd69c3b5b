/* Self-test: whether a device can be trusted. It computes rays, orbits, radii, brightnesses and encodings by the same
 * calls as pictures and answers. It compares them with independently known values, and reports each error with its
 * bound. It takes a few seconds on two CPU cores.
 *
 * Each bound is explained where it is set. A bound is the error of some operations of unit roundoff each, times the
 * amplification of the answer (reference.h), plus the error of a method's steps. */
#ifndef KD_RENDER_SELFTEST_SELFTEST_H
#define KD_RENDER_SELFTEST_SELFTEST_H

#include "render/device/renderer.h"
#include "render/selftest/reference.h"

/* One line of the table, for many comparisons. It shows the comparison with the largest ratio of error to bound. */
struct kd_selftest_row {
    char what[64], by[32]; /* "rays, bulk: r (relative)", "mino-rkn6 f32" */
    const char *source;    /* the reference in a few words */
    unsigned compared;
    double error, bound; /* error is INFINITY if a number was missing or NaN */
    bool ok;             /* true if there were comparisons, and all are within their bounds */
};
void kd_selftest_begin(struct kd_selftest_row *row, const char *source, const char *by, const char *what, ...)
    __attribute__((format(printf, 4, 5)));
void kd_selftest_compare(struct kd_selftest_row *row, double error, double bound);

/* Called with each finished row. It returns false to stop the test, which then ends with KD_ECANCELLED. */
typedef bool (*kd_selftest_fn)(void *user, const struct kd_selftest_row *row);

/* Runs the whole test, also in double precision if the device has it. Returns KD_OK even if rows failed, and an
 * error only if the test could not run. Render thread. */
enum kd_status kd_selftest_run(struct kd_renderer *renderer, const struct kd_selftest_reference *reference,
                               kd_selftest_fn row, void *user, struct kd_error *error);

#endif
