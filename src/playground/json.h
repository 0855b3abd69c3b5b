/* Playgrounds as JSON: documents that create one, patches, and snapshots from which a playground continues exactly. Any
 * thread.
 *
 *     {"preset": "system", "waves": true, "bodies": [{"name", "mass", "radius", "temperature_k", "position": [x, y,
 *       z], "velocity": [x, y, z]}]}
 *
 * creates one: first the preset's settings and bodies, if any, then the given settings and bodies. A snapshot is such a
 * document with a "state", which holds everything else on which the motion depends. After kd_playground_read the motion
 * continues bit for bit.
 *
 *     {"amplification": 100, "add": [{...}], "change": [{"id": 3, "velocity": [0, 0.1, 0]}], "remove": [1, 2]}
 *
 * patches one: settings first, then add, change, remove in this order. On an error nothing is changed. */
#ifndef KD_PLAYGROUND_JSON_H
#define KD_PLAYGROUND_JSON_H

#include "playground/playground.h"
#include "playground/preset.h"

#include <cjson/cJSON.h>

#define KD_PLAYGROUND_JSON_MAX ((size_t)96 << 20) /* maximum size of a document: a million pieces take 72 MiB */

/* Reads a playground. KD_EINVAL with a pointer; if there is no pointer, the text is not JSON. */
enum kd_status kd_playground_read(const char *text, size_t length, struct kd_playground **out, struct kd_error *error);
/* Replaces *p; on an error *p is unchanged. */
enum kd_status kd_playground_patch(struct kd_playground **p, const char *text, size_t length, struct kd_error *error);
/* Creates a playground in two steps. Between them the caller may remove members of its own, such as "rate", from the
 * tree. Free *tree with cJSON_Delete. */
enum kd_status kd_playground_parse(const char *text, size_t length, cJSON **tree, struct kd_error *error);
enum kd_status kd_playground_read_tree(const cJSON *tree, struct kd_playground **out, struct kd_error *error);
enum kd_status kd_playground_patch_tree(struct kd_playground **p, const cJSON *tree, struct kd_error *error);
/* The preset that a document names; NULL if the document names none, or none that exists. */
const struct kd_playground_preset *kd_playground_preset_in(const cJSON *tree);
/* Sets a setting by name from text, as on a command line. */
enum kd_status kd_playground_params_set(struct kd_playground_params *params, const char *name, const char *text,
                                        struct kd_error *error);

/* Writes {settings, "bodies"}. With `snapshot`, also writes "state". KD_ENOMEM. */
enum kd_status kd_playground_write(struct kd_playground *p, bool snapshot, struct kd_buffer *out);
/* Writes the present state: {"t", "settings", "bodies" with ids, "totals", "debris", "approximations"}. Leaves out
 * members that only snapshots need. */
void kd_playground_status_json(struct kd_playground *p, struct kd_json *json);

#endif
