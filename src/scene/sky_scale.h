/* Keeps the width of the image plane consistent in its two units. camera.field_m is what renderers read; if
 * camera.field_uas is a number, camera.field_m is computed from it. Pure, any thread. */
#ifndef KD_SCENE_SKY_SCALE_H
#define KD_SCENE_SKY_SCALE_H

#include "scene/scene.h"

/* The width in M that camera.field_uas stands for; INFINITY if that is "none". */
double kd_scene_field_of_uas(const struct kd_scene *scene);

/* Call after fields have changed. given: which of kd_fields were given anew; NULL: none. If camera.field_m was given
 * and camera.field_uas was not, the latter becomes "none". If camera.field_uas is a number, camera.field_m is
 * computed from it, unless the result is out of range; kd_scene_validate refuses that. */
void kd_scene_settle(struct kd_scene *scene, const bool *given);

#endif
