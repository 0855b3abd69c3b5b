/* The critical curve passes these pixels, which have rays of their own. Image orders from 2 on, and from far away
 * order 1, are rings thinner than a pixel: one ray a pixel finds them here and there and shows dots. So these pixels
 * are given more rays than the others. Double precision; pure, any thread.
 *
 * In units of the shadow's radius the images of order n lie within some e^(-pi n) of the curve (lensing.h): those
 * that are thinner than a pixel lie in the pixels listed here, whose middles are within KD_CRITICAL_NEAR of it. */
#ifndef KD_RENDER_VIEW_CRITICAL_PIXELS_H
#define KD_RENDER_VIEW_CRITICAL_PIXELS_H

#include "base/error.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define KD_CRITICAL_NEAR 2.5 /* pixels */
#define KD_CRITICAL_SIDE 16  /* rays along each side of such a pixel, at most */

struct kd_pixel { uint32_t x, y; };
struct kd_critical_pixels {
    struct kd_pixel *pixels; /* row by row; NULL: none */
    size_t n;
};

/* Lists those of a picture of a valid scene, plane or pinhole. KD_ENOMEM. */
enum kd_status kd_critical_pixels_of(const struct kd_scene *scene, struct kd_critical_pixels *out,
                                     struct kd_error *error);
uint64_t kd_critical_pixels_made(void); /* lists, by this process so far: tests ask */
void kd_critical_pixels_finish(struct kd_critical_pixels *pixels);

/* How many pixels of the list are above row y. */
size_t kd_critical_pixels_above(const struct kd_critical_pixels *pixels, uint32_t y);

/* The camera of these rays, which are `rays` a pixel: kd_camera_exact and kd_camera_block of it count its pixels in
 * `rays` steps each way, from one of which to the next it is as far as from ray to ray. */
struct kd_scene kd_critical_camera(const struct kd_scene *scene, uint32_t rays);

/* The rays of a pixel: ray number k of K stands in column k and row (generator k + shift) mod K of K x K. A lattice:
 * no two rays share a row or a column, so that whichever way the curve goes through the pixel they stand at
 * different distances from it; of all such ones the one whose nearest points are furthest apart; and symmetric about
 * the middle of the pixel. As place.glsl does it. */
struct kd_critical_lattice { uint32_t rays, generator, shift; };
struct kd_critical_lattice kd_critical_lattice(uint32_t rays); /* 1 to 256 */

/* The square grid of side x side rays, as all pixels have where image.samples is `side`: one whose generator is 0,
 * and shift the side. */
struct kd_critical_lattice kd_critical_grid(uint32_t side);
/* Steps to a pixel, of kd_critical_camera. */
static inline uint32_t kd_critical_steps(const struct kd_critical_lattice *l)
{
    return l->generator ? l->rays : l->shift;
}

/* In these steps. */
static inline struct kd_pixel kd_critical_place(const struct kd_critical_lattice *l, struct kd_pixel pixel,
                                                uint32_t ray)
{
    if (!l->generator)
        return (struct kd_pixel) { pixel.x * l->shift + ray % l->shift, pixel.y * l->shift + ray / l->shift };
    return (struct kd_pixel) { pixel.x * l->rays + ray, pixel.y * l->rays + (ray * l->generator + l->shift) % l->rays };
}

/* These are, on a lattice and not on a grid, four vectors from a ray to neighbours of it, one of which is at (x, y)
 * and at (-x, -y) each: the two shortest of the lattice that do not point the same way, their sum and their
 * difference. */
struct kd_critical_neighbours {
    struct { int32_t x, y; } to[4];
};
struct kd_critical_neighbours kd_critical_neighbours(const struct kd_critical_lattice *lattice);

#endif
