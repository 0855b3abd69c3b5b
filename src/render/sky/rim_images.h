/* Finds images of stars in the rim of the shadow (view/rim.h). The rim is next to the critical curve, where
 * neighbouring rays of a picture end too far apart. Pure; any thread. */
#ifndef KD_RENDER_SKY_RIM_IMAGES_H
#define KD_RENDER_SKY_RIM_IMAGES_H

#include "render/sky/star_images.h"
#include "render/view/rim_grid.h"

#define KD_RIM_COARSE 1.0 /* largest side in rad of the triangles in which images are searched for */

/* Reports each image in the rim, if the scene has a rim. A report has the image's place among the pixels' rays (one a
 * pixel), and how the map transforms a square of four such rays. stars: unit vectors in the frame of the lens map;
 * most: as in kd_sky_map. Returns KD_ENOMEM, or the status by which `found` ended the search. */
enum kd_status kd_rim_images(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_vec *stars,
                             const double *most, size_t n,
                             enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user,
                             struct kd_error *error);

#endif
