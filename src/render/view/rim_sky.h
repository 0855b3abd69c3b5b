/* This follows the rays of the rim (rim.h) in double precision: so near to the critical curve 32 bits lose 1e-4 to 1e-2 radians of where a ray goes.
 *
 * The two angles of physics/null_bend.h, and the tangent, are smooth functions of the curve's point and of the logarithm of the distance. They are found at some
 * hundred to some thousand rays and interpolated to the others, round the curve by trigonometric polynomials, across it by those of Chebyshev's extrema: as many as it takes, ever
 * more, to meet rays between them within KD_RIM_EXACT, up to all columns and some 90 intervals: from |a| = 0.99 on, next to the equator, that is not enough, and 5e-6 rad are left at 0.998, 4e-5 at 0.99999. Pure; any thread. */
#ifndef KD_RENDER_VIEW_RIM_SKY_H
#define KD_RENDER_VIEW_RIM_SKY_H

#include "base/error.h"
#include "render/view/rim.h"

#define KD_RIM_EXACT 1e-6 /* rad */

/* Writes where rays come from, unit vectors in the hole's frame as the lens map has them: x of all rays, row by row, then y, then z. 1.5 to 20 ms. KD_ENOMEM;
 * KD_EINVAL: a ray of the rim does not escape, which kd_rim_of sees to. */
enum kd_status kd_rim_sky(const struct kd_scene *scene, const struct kd_rim *rim, float *out, struct kd_error *error);

/* The same of one ray, not interpolated: that of the angle `turn`, KD_RIM_ANGLES to the whole, at a distance `off`. False: it does not escape. */
bool kd_rim_sky_at(const struct kd_scene *scene, const struct kd_rim *rim, uint32_t k, double off, double out[3]);

#endif
