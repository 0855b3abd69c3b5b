/* Playgrounds as JSON: documents that create one, patches, and snapshots from which a playground continues exactly. Any
 * thread.
 *
 *     {"preset": "system", "waves": true, "bodies": [{"name", "mass", "radius", "temperature_k", "position": [x, y,
 *       z], "velocity": [x, y, z]}]}
 *
 * creates a playground. The preset's settings and bodies, if any, are set first, then the given settings and bodies. A
 * snapshot is such a document with a "state", which holds everything else on which the motion depends. After
 * kd_playground_read the motion continues bit for bit.
 *
 *     {"amplification": 100, "add": [{...}], "change": [{"id": 3, "velocity": [0, 0.1, 0]}], "remove": [1, 2]}
 *
 * patches a playground. Settings are changed first, then add, change and remove are applied in this order. After an
 * error nothing is changed. */
#ifndef KD_PLAYGROUND_JSON_H
#define KD_PLAYGROUND_JSON_H

#include "playground/playground.h"
#include "playground/preset.h"

#include <cjson/cJSON.h>

#define KD_PLAYGROUND_JSON_MAX ((size_t)96 << 20) /* largest size of a document; a million pieces take 72 MiB */

/* Reads a playground. An error is KD_EINVAL with a pointer, or without one if the text is not JSON. */
enum kd_status kd_playground_read(const char *text, size_t length, struct kd_playground **out, struct kd_error *error);
/* Replaces *p by the patched playground. On an error *p is unchanged. */
enum kd_status kd_playground_patch(struct kd_playground **p, const char *text, size_t length, struct kd_error *error);
/* Creates a playground in two steps. Between the two, the caller may remove members of its own, such as "rate", from
 * the tree. The caller frees *tree with cJSON_Delete. */
enum kd_status kd_playground_parse(const char *text, size_t length, cJSON **tree, struct kd_error *error);
enum kd_status kd_playground_read_tree(const cJSON *tree, struct kd_playground **out, struct kd_error *error);
enum kd_status kd_playground_patch_tree(struct kd_playground **p, const cJSON *tree, struct kd_error *error);
/* The preset that a document names; NULL if the document names no preset, or one that does not exist. */
const struct kd_playground_preset *kd_playground_preset_in(const cJSON *tree);
/* Sets a setting by name from a text, such as one from a command line. */
enum kd_status kd_playground_params_set(struct kd_playground_params *params, const char *name, const char *text,
                                        struct kd_error *error);

/* Writes {settings, "bodies"} and, if `snapshot` is true, also "state". Returns KD_ENOMEM if memory is short. */
enum kd_status kd_playground_write(struct kd_playground *p, bool snapshot, struct kd_buffer *out);
/* Writes the present state: {"t", "settings", "bodies" with ids, "totals", "debris", "approximations"}. It leaves out
 * members that only snapshots need. */
void kd_playground_status_json(struct kd_playground *p, struct kd_json *json);

#endif
