/* Reads scenes that are parts of larger documents. Any thread. */
#ifndef KD_SCENE_TREE_H
#define KD_SCENE_TREE_H

#include "document/tree.h"
#include "scene/scene.h"

/* Reads a scene that is part of a larger document, like kd_scene_from_json or, if patch is true, like
 * kd_scene_patch. On error *scene is unchanged, and the error's pointer is relative to the scene. */
enum kd_status kd_scene_from_tree(struct kd_scene *scene, const cJSON *object, bool patch, struct kd_error *error);

#endif
