#include "scene/scene.h"

int32_t kd_scene_side(const struct kd_scene *scene) { return scene->image.samples ? scene->image.samples : 1; }

bool kd_scene_adapts(const struct kd_scene *scene) { return !scene->image.samples; }
