/* Finds cameras for which the sky is noise. From close to the horizon of a fast hole the whole sky is seen in a narrow
 * cone, many times over: one pixel's step, or the rounding of a ray's labels, leads to somewhere else on the sky.
 * Pure; any thread. */
#ifndef KD_RENDER_EMIT_SKY_NOISE_H
#define KD_RENDER_EMIT_SKY_NOISE_H

#include "render/accuracy/engine.h"
#include "scene/scene.h"

/* Traces some hundred pixels of the picture in closed form, and says whether for most of those that see the sky the
 * next ray, or the same one with its labels rounded to the precision that the lens map is made in, ends more than
 * KD_SKY_STEP away. False from infinity and from KD_SKY_NEAR horizon radii on, where that is so next to the critical
 * curve alone. A fraction of a millisecond. */
#define KD_SKY_STEP 0.1 /* radians: the drawn grid has lines every 15 degrees or so */
#define KD_SKY_NEAR 1.5
bool kd_sky_is_noise(const struct kd_scene *scene, enum kd_precision precision);

#endif
