/* Reads a JSON document as cJSON's tree, and refuses what cJSON lets pass (scan.h). Any thread. */
#ifndef KD_SCENE_TREE_H
#define KD_SCENE_TREE_H

#include "base/error.h"
#include "scene/value.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* text need not end in a NUL. KD_EINVAL without a pointer: not a JSON document, or one of more than `most` bytes or
 * `values` values. Lets other requests run meanwhile (base/pause.h). Free *out with kd_tree_free, which does so too,
 * or with cJSON_Delete if it cannot be large. */
enum kd_status kd_tree_parse(const char *text, size_t length, size_t most, size_t values, cJSON **out,
                             struct kd_error *error);
void kd_tree_free(cJSON *root); /* accepts NULL */

/* Parses text of kerrd's own files. NULL: not JSON, or, with *starved set, out of memory. Free it with cJSON_Delete. */
cJSON *kd_tree_read(const char *text, size_t length, bool *starved);

/* Converts an item to a value, which is valid as long as the item. */
struct kd_value kd_tree_value(const cJSON *item);

/* Reads a scene within a larger document, as kd_scene_from_json does, or with patch as kd_scene_patch. On error
 * *scene is unchanged, and the error's pointer is relative to the scene. */
enum kd_status kd_scene_from_tree(struct kd_scene *scene, const cJSON *object, bool patch, struct kd_error *error);

#endif
