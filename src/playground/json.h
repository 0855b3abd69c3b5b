/* A playground as JSON: what is asked for, what is changed, and a snapshot that starts again exactly. Any thread.
 *
 *     {"preset": "system", "waves": true, "bodies": [{"name", "mass", "radius", "temperature_k", "position": [x, y,
 *       z], "velocity": [x, y, z]}]}
 *
 * makes one: the preset's settings and bodies, if any, then the settings and bodies that are given. A snapshot is
 * such a document with "state" in it, which holds all that the motion depends on besides: kd_playground_read of it
 * goes on to the bit as if nothing had been.
 *
 *     {"amplification": 100, "add": [{...}], "change": [{"id": 3, "velocity": [0, 0.1, 0]}], "remove": [1, 2]}
 *
 * changes one: settings first, then in the order add, change, remove. Nothing is changed unless all of it can be. */
#ifndef KD_PLAYGROUND_JSON_H
#define KD_PLAYGROUND_JSON_H

#include "playground/playground.h"
#include "playground/preset.h"

#include <cjson/cJSON.h>

#define KD_PLAYGROUND_JSON_MAX ((size_t)96 << 20) /* bytes of a document: a million pieces take 72 MiB */

/* KD_EINVAL with a pointer; without one this is no JSON document. */
enum kd_status kd_playground_read(const char *text, size_t length, struct kd_playground **out, struct kd_error *error);
/* *p is replaced, or left as it was. */
enum kd_status kd_playground_patch(struct kd_playground **p, const char *text, size_t length, struct kd_error *error);
/* The same in two steps, for the holder of a playground whose documents ask for more, such as "rate": it takes that
 * out in between. Free *tree with cJSON_Delete. */
enum kd_status kd_playground_parse(const char *text, size_t length, cJSON **tree, struct kd_error *error);
enum kd_status kd_playground_read_tree(const cJSON *tree, struct kd_playground **out, struct kd_error *error);
enum kd_status kd_playground_patch_tree(struct kd_playground **p, const cJSON *tree, struct kd_error *error);
/* The preset that a document names; NULL: it names none that there is. */
const struct kd_playground_preset *kd_playground_preset_in(const cJSON *tree);
/* A setting by its name from text, as on a command line. */
enum kd_status kd_playground_params_set(struct kd_playground_params *params, const char *name, const char *text,
                                        struct kd_error *error);

/* {settings, "bodies"}, and with `snapshot` "state". KD_ENOMEM. */
enum kd_status kd_playground_write(struct kd_playground *p, bool snapshot, struct kd_buffer *out);
/* {"t", "settings", "bodies" with ids, "totals", "debris", "approximations"}: how it stands, without what a snapshot
 * needs. */
void kd_playground_status_json(struct kd_playground *p, struct kd_json *json);

#endif
