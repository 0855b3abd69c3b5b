/* Follows the rays of the rim (rim_grid.h) in double precision. So near to the critical curve, single precision loses
 * 1e-4 to 1e-2 rad of a ray's final direction.
 *
 * The angles of physics/null/null_bend.h are smooth functions of the curve's point and of the logarithm of the
 * distance. In each grid these angles are computed at some tens to hundreds of rays. For the other rays they are
 * interpolated by polynomials through Chebyshev extrema, along the curve and across it. The number of nodes is chosen
 * so that the interpolation at rays between them is accurate to KD_RIM_EXACT. Pure; any thread. */
#ifndef KD_RENDER_VIEW_RIM_SKY_H
#define KD_RENDER_VIEW_RIM_SKY_H

#include "base/error.h"
#include "render/view/rim_grid.h"

#define KD_RIM_EXACT 1e-6 /* rad */

/* Writes a rim's buffer as rim_grid.h describes it: the edges, then for each grid the directions from which its rays
 * come, and its table. Directions are unit vectors in the hole's frame, as in the lens map: x of all rays row by row,
 * then y, then z. About 0.2 us a ray. Returns KD_ENOMEM, or KD_EINVAL if a ray of the rim does not escape, which cannot
 * happen after kd_rim_of. */
enum kd_status kd_rim_sky(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_rim_grids *grids,
                          float *out, struct kd_error *error);

/* Direction of one ray, computed without interpolation. Returns false if the ray does not escape. */
bool kd_rim_sky_at(const struct kd_scene *scene, const struct kd_rim *rim, double u, double off, double out[3]);

#endif
