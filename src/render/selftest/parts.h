/* Parts of the self-test. Private to src/render; render thread. */
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
/* Delivers a finished row. */
enum kd_status kd_selftest_end(const struct kd_selftest *test, struct kd_selftest_row *row);

enum kd_status kd_selftest_orbits(const struct kd_selftest *test); /* orbits, and the disk's flux; no device needed */
enum kd_status kd_selftest_rays(const struct kd_selftest *test);   /* listed rays, by every engine */
enum kd_status kd_selftest_maps(const struct kd_selftest *test);   /* the lens map's kernels */
enum kd_status kd_selftest_light(const struct kd_selftest *test);  /* brightness and encoding */
enum kd_status kd_selftest_same(const struct kd_selftest *test);   /* repeated pictures, and pictures in pieces */

/* For each number, bounds allow for this many operations with an error of one unit roundoff each (rays.c). */
#define KD_SELFTEST_OPERATIONS 64

#endif
