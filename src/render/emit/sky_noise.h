/* Detects cameras from which the sky looks like noise. From close to the horizon of a fast-spinning hole the whole
 * sky appears many times over in a narrow cone. A step of one pixel, or the rounding of a ray's labels, then leads
 * to an unrelated place on the sky. Pure; any thread. */
#ifndef KD_RENDER_EMIT_SKY_NOISE_H
#define KD_RENDER_EMIT_SKY_NOISE_H

#include "render/accuracy/engine.h"
#include "scene/scene.h"

/* Traces 96 pixels of the picture in closed form. Compares each ray with two others: the next pixel's ray, and the same
 * ray with labels rounded to the lens map's precision. A pixel counts if one of these two rays misses the sky or ends
 * more than KD_SKY_STEP away on it. Returns true if most pixels that see the sky count. Returns false for a camera at
 * infinity or beyond KD_SKY_NEAR horizon radii, because such jumps occur there only next to the critical curve. Takes a
 * fraction of a millisecond. */
#define KD_SKY_STEP 0.1 /* in radians (5.7 degrees); the lines of the drawn grid are about 15 degrees apart */
#define KD_SKY_NEAR 1.5
bool kd_sky_is_noise(const struct kd_scene *scene, enum kd_precision precision);

#endif
