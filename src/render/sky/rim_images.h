/* Finds images of stars in the rim of the shadow (view/rim.h), next to the critical curve, where neighbouring
 * rays of a picture lead too far apart to tell. Pure; any thread. */
#ifndef KD_RENDER_SKY_RIM_IMAGES_H
#define KD_RENDER_SKY_RIM_IMAGES_H

#include "render/sky/star_images.h"
#include "render/view/rim_grid.h"

#define KD_RIM_COARSE 1.0 /* rad: sides of its triangles, at most */

/* Tells each image in the rim of a scene, if there is one, by its place among the pixels' rays (one a pixel), and
 * what the map does to the square of four of those. stars: unit vectors in the frame of the lens map; most: as of
 * kd_sky_map. KD_ENOMEM; a status of `found` ends it. */
enum kd_status kd_rim_images(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_vec *stars,
                             const double *most, size_t n,
                             enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user,
                             struct kd_error *error);

#endif
