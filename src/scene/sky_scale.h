/* The width of the image plane is one number in two units: camera.field_m, which all who draw read, and
 * camera.field_uas, from which it follows where that is a number. Pure, any thread. */
#ifndef KD_SCENE_SKY_SCALE_H
#define KD_SCENE_SKY_SCALE_H

#include "scene/scene.h"

/* The width in M that camera.field_uas comes to; INFINITY where that is "none". */
double kd_scene_field_of_uas(const struct kd_scene *scene);

/* Call it where fields have changed, given those of kd_fields that were given anew; NULL: nobody gave any. With
 * camera.field_m among them, and not camera.field_uas, that becomes "none". Where camera.field_uas is a number
 * camera.field_m becomes what it comes to; it stays as it was where that is out of its range, which kd_scene_validate
 * refuses. */
void kd_scene_settle(struct kd_scene *scene, const bool *given);

#endif
