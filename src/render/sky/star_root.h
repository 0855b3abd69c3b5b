/* Newton's method from a place near a star's image to the image itself (star_images.h). Pure; any thread. */
#ifndef KD_RENDER_SKY_STAR_ROOT_H
#define KD_RENDER_SKY_STAR_ROOT_H

#include "render/sky/star_images.h"

#include <math.h>

#define KD_STAR_ROOT_NEAR 1.5 /* images that are further than this from the start, in rays, are not searched for */

/* UNKNOWN: the map cannot follow the first ray. UNWANTED: there may be an image, but it need not be reported. */
enum kd_star_root { KD_STAR_ROOT_NONE, KD_STAR_ROOT_FOUND, KD_STAR_ROOT_UNKNOWN, KD_STAR_ROOT_UNWANTED };

/* Moves a place to the place of the ray that ends at a star; *at becomes the linearised map there. */
enum kd_star_root kd_star_root(const struct kd_sky_map *map, struct kd_vec star, double *x, double *y,
                               struct kd_sky_tangent *at);

/* Solves star ~ n + dx across + dy down, up to a factor (Cramer's rule). */
void kd_sky_steps_to(const struct kd_sky_tangent *from, struct kd_vec star, double *dx, double *dy);

static inline double kd_vec_dot(struct kd_vec a, struct kd_vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline struct kd_vec kd_vec_less(struct kd_vec a, struct kd_vec b)
{
    return (struct kd_vec) { a.x - b.x, a.y - b.y, a.z - b.z };
}
static inline struct kd_vec kd_vec_times(double by, struct kd_vec a)
{
    return (struct kd_vec) { by * a.x, by * a.y, by * a.z };
}
static inline double kd_vec_volume(struct kd_vec a, struct kd_vec b, struct kd_vec c)
{
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}
static inline double kd_vec_apart(struct kd_vec a, struct kd_vec b)
{
    return sqrt(kd_vec_dot(kd_vec_less(a, b), kd_vec_less(a, b)));
}

#endif
