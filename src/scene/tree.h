/* Reads a JSON document as cJSON's tree, and refuses what cJSON lets pass (scan.h). Any thread. */
#ifndef KD_SCENE_TREE_H
#define KD_SCENE_TREE_H

#include "base/error.h"
#include "scene/value.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* text need not end in a NUL. KD_EINVAL without a pointer: this is no JSON document, or one of more than `most`
 * bytes or `values` values. Lets others go first (base/pause.h). Free *out with kd_tree_free, which does so too, or
 * with cJSON_Delete where it cannot be large. */
enum kd_status kd_tree_parse(const char *text, size_t length, size_t most, size_t values, cJSON **out,
                             struct kd_error *error);
void kd_tree_free(cJSON *root); /* accepts NULL */

/* Parses text of a file of our own. NULL: it is no JSON, or with *starved memory was short. Free it with
 * cJSON_Delete. */
cJSON *kd_tree_read(const char *text, size_t length, bool *starved);

/* Makes a value of the item. It is valid as long as the item. */
struct kd_value kd_tree_value(const cJSON *item);

/* Reads a scene that is part of a larger document, as kd_scene_from_json does, or with patch as kd_scene_patch.
 * *scene is unchanged on error; its pointer counts from the scene. */
enum kd_status kd_scene_from_tree(struct kd_scene *scene, const cJSON *object, bool patch, struct kd_error *error);

#endif
