/* The self-test has these parts. Private to src/render; render thread. */
#ifndef KD_RENDER_SELFTEST_PARTS_H
#define KD_RENDER_SELFTEST_PARTS_H

#include "render/selftest/selftest.h"
#include "render/frame/frame.h"
#include "render/rays/rays.h"

struct kd_selftest {
    struct kd_renderer *renderer;
    const struct kd_selftest_reference *reference;
    kd_selftest_fn row;
    void *user;
    struct kd_error *error;
};
/* Hand a finished row over. */
enum kd_status kd_selftest_end(const struct kd_selftest *test, struct kd_selftest_row *row);

enum kd_status kd_selftest_orbits(const struct kd_selftest *test); /* orbits, the disk's flux: no device */
enum kd_status kd_selftest_rays(const struct kd_selftest *test);   /* listed rays, by every engine */
enum kd_status kd_selftest_maps(const struct kd_selftest *test);   /* the lens map's kernels */
enum kd_status kd_selftest_light(const struct kd_selftest *test);  /* brightness and encoding */
enum kd_status kd_selftest_same(const struct kd_selftest *test);   /* the same again, and in pieces */

/* Operations of a unit roundoff each that a number may have gone through: rays.c. */
#define KD_SELFTEST_OPERATIONS 64

#endif
