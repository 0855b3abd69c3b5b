/* Follows the rays of the rim (rim_grid.h) in double precision: so near to the critical curve 32 bits lose 1e-4
 * to 1e-2 radians of where a ray goes.
 *
 * The two angles of physics/null/null_bend.h, and the tangent, are smooth functions of the curve's point and of the
 * logarithm of the distance. In each grid they are found at some tens to some hundreds of rays, and interpolated to
 * the others by polynomials through Chebyshev's extrema, round the curve as well as across it: as many as it takes
 * to meet rays between them within KD_RIM_EXACT. Pure; any thread. */
#ifndef KD_RENDER_VIEW_RIM_SKY_H
#define KD_RENDER_VIEW_RIM_SKY_H

#include "base/error.h"
#include "render/view/rim_grid.h"

#define KD_RIM_EXACT 1e-6 /* rad */

/* Writes a rim's buffer, as rim_grid.h says: its edges, of each grid where its rays come from, unit vectors in the
 * hole's frame as the lens map has them, x of all rays, row by row, then y, then z; and the tables. Some 0.2 us a
 * ray. KD_ENOMEM; KD_EINVAL: a ray of the rim does not escape, which kd_rim_of sees to. */
enum kd_status kd_rim_sky(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_rim_grids *grids,
                          float *out, struct kd_error *error);

/* Where one ray comes from, not interpolated. False: it does not escape. */
bool kd_rim_sky_at(const struct kd_scene *scene, const struct kd_rim *rim, double u, double off, double out[3]);

#endif
