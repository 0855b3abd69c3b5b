/* Makes a value for the hole of a scene. */
#ifndef KD_SCENE_HOLE_H
#define KD_SCENE_HOLE_H

#include "physics/spacetime/hole.h"
#include "scene/scene.h"

/* For use as an argument. The value lives until the end of the enclosing block. */
#define kd_scene_hole(scene) ((const struct kd_hole[]) { kd_hole_in(&(scene)->spacetime) })

#endif
