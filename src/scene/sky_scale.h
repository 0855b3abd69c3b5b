/* Keeps the width of the image plane consistent in its two units. Renderers read camera.field_m. If camera.field_uas is
 * a number, camera.field_m is computed from it. Pure, any thread. */
#ifndef KD_SCENE_SKY_SCALE_H
#define KD_SCENE_SKY_SCALE_H

#include "scene/scene.h"

/* The width in M to which camera.field_uas corresponds; INFINITY if camera.field_uas is "none". */
double kd_scene_field_of_uas(const struct kd_scene *scene);

/* Call it after fields have changed. given: which of kd_fields were given; NULL: none. If camera.field_m was given
 * and camera.field_uas was not, camera.field_uas becomes "none". If camera.field_uas is a number, camera.field_m is
 * computed from it. If the result is out of range, camera.field_m is left unchanged; kd_scene_validate then refuses
 * the scene. */
void kd_scene_settle(struct kd_scene *scene, const uint64_t *given);

#endif
