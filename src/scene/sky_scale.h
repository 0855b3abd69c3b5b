/* Keeps the two values for the width of the image plane, which are in different units, consistent. Renderers read
 * camera.field_m, which is computed from camera.field_uas if that is a number. Pure, any thread. */
#ifndef KD_SCENE_SKY_SCALE_H
#define KD_SCENE_SKY_SCALE_H

#include "scene/scene.h"

/* The width in M that corresponds to camera.field_uas; INFINITY if camera.field_uas is "none". */
double kd_scene_field_of_uas(const struct kd_scene *scene);

/* Call this after fields have changed. given: bit mask of the kd_fields that were given; NULL: none. If
 * camera.field_m was given and camera.field_uas was not, camera.field_uas becomes "none". If camera.field_uas is a
 * number, camera.field_m is computed from it. If the result is out of range, camera.field_m stays unchanged, and
 * kd_scene_validate later refuses the scene. */
void kd_scene_settle(struct kd_scene *scene, const uint64_t *given);

#endif
