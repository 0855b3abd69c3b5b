/* The self-test says whether a device can be trusted. Rays, orbits, radii, brightnesses and encodings that are known
 * from elsewhere, computed here by the same calls that pictures and answers are made with, each error beside its
 * bound. A few seconds on two CPU cores.
 *
 * What a bound allows for is said where it is set: so many operations of the unit roundoff each, times how much the
 * answer amplifies them (reference.h), and what the steps of a method lose. */
#ifndef KD_RENDER_SELFTEST_SELFTEST_H
#define KD_RENDER_SELFTEST_SELFTEST_H

#include "render/device/renderer.h"
#include "render/selftest/reference.h"

/* One line of the table: many comparisons, of which the one nearest to its bound, or furthest beyond, is shown. */
struct kd_selftest_row {
    char what[64], by[32]; /* "rays, bulk: r (relative)", "mino-rkn6 f32" */
    const char *source;    /* the reference, in few words */
    unsigned compared;
    double error, bound; /* the error is INFINITY where a number was missing or NaN */
    bool ok;             /* every comparison within its bound, and there was one */
};
void kd_selftest_begin(struct kd_selftest_row *row, const char *source, const char *by, const char *what, ...)
    __attribute__((format(printf, 4, 5)));
void kd_selftest_compare(struct kd_selftest_row *row, double error, double bound);

/* Called with each finished row; false stops the test: KD_ECANCELLED. */
typedef bool (*kd_selftest_fn)(void *user, const struct kd_selftest_row *row);

/* Runs the whole test, in double precision too where the device has it. KD_OK also when rows failed; an error only
 * where the test could not be made. Render thread. */
enum kd_status kd_selftest_run(struct kd_renderer *renderer, const struct kd_selftest_reference *reference,
                               kd_selftest_fn row, void *user, struct kd_error *error);

#endif
