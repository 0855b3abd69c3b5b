/* Lists the pixels that the critical curve passes, which get more rays than others. Image orders from 2 on (for a
 * distant observer from 1 on) are rings thinner than a pixel. With one ray a pixel they would show as dots. Double
 * precision; pure, any thread.
 *
 * In units of the shadow's radius the images of order n lie within about e^(-pi n) of the curve (lensing.h). Images
 * that are thinner than a pixel lie in the pixels listed here, whose centres are within KD_CRITICAL_NEAR of the curve.
 * */
#ifndef KD_RENDER_VIEW_CRITICAL_PIXELS_H
#define KD_RENDER_VIEW_CRITICAL_PIXELS_H

#include "base/error.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define KD_CRITICAL_NEAR 2.5 /* pixels */
#define KD_CRITICAL_SIDE 16  /* largest number of rays along each side of such a pixel */

struct kd_pixel { uint32_t x, y; };
struct kd_critical_pixels {
    struct kd_pixel *pixels; /* the listed pixels, row by row; NULL: none */
    size_t n;
};

/* Lists the pixels of a valid scene whose projection is plane or pinhole. The only error is KD_ENOMEM. */
enum kd_status kd_critical_pixels_of(const struct kd_scene *scene, struct kd_critical_pixels *out,
                                     struct kd_error *error);
uint64_t kd_critical_pixels_made(void); /* number of lists that this process has made so far, for tests */
void kd_critical_pixels_finish(struct kd_critical_pixels *pixels);

/* Number of listed pixels above row y. */
size_t kd_critical_pixels_above(const struct kd_critical_pixels *pixels, uint32_t y);

/* The scene with the camera of these rays, for a lattice of `rays` rays a pixel. Its picture has `rays` times as many
 * steps along each axis, so that kd_camera_exact and kd_camera_block count places in steps of the lattice. */
struct kd_scene kd_critical_camera(const struct kd_scene *scene, uint32_t rays);

/* The rays of a pixel form a lattice of K rays: ray k is in column k and row (generator k + shift) mod K of a K x K
 * grid. No two rays share a row or a column, so rays have different distances from the curve whatever its direction.
 * Among all lattices of this kind, this one has the largest distance between nearest points. It is symmetric about the
 * pixel's centre. place.glsl computes the same. */
struct kd_critical_lattice { uint32_t rays, generator, shift; };
struct kd_critical_lattice kd_critical_lattice(uint32_t rays); /* 1 to 256 */

/* The square grid of side x side rays that all pixels have if image.samples is `side`. It is marked by generator 0, and
 * shift holds the side. */
struct kd_critical_lattice kd_critical_grid(uint32_t side);
/* Steps along a pixel's side in the picture of kd_critical_camera. */
static inline uint32_t kd_critical_steps(const struct kd_critical_lattice *l)
{
    return l->generator ? l->rays : l->shift;
}

/* Place of a ray, in steps of kd_critical_steps. */
static inline struct kd_pixel kd_critical_place(const struct kd_critical_lattice *l, struct kd_pixel pixel,
                                                uint32_t ray)
{
    if (!l->generator)
        return (struct kd_pixel) { pixel.x * l->shift + ray % l->shift, pixel.y * l->shift + ray / l->shift };
    return (struct kd_pixel) { pixel.x * l->rays + ray, pixel.y * l->rays + (ray * l->generator + l->shift) % l->rays };
}

/* Four vectors from a ray of a lattice (not a grid) to neighbours. For each vector (x, y) there is a neighbour at (x,
 * y) and one at (-x, -y). The four vectors are the two shortest that are not parallel, the sum of these two, and their
 * difference. */
struct kd_critical_neighbours {
    struct { int32_t x, y; } to[4];
};
struct kd_critical_neighbours kd_critical_neighbours(const struct kd_critical_lattice *lattice);

#endif
