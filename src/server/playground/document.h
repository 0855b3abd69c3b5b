/* JSON documents of a playground session: its settings in a request, and its state. Any thread. */
#ifndef KD_SERVER_PLAYGROUND_DOCUMENT_H
#define KD_SERVER_PLAYGROUND_DOCUMENT_H

#include "playground/json.h"
#include "scene/asset.h"
#include "scene/scene.h"
#include "server/playground/sessions.h"

/* Moves "rate" and "paused" out of the tree into *pace. If either of them is absent, the corresponding member of
 * *pace is unchanged. Returns KD_EINVAL with a pointer. */
enum kd_status kd_playground_session_read_pace(cJSON *tree, struct kd_playground_session_pace *pace,
                                               struct kd_error *error);
/* Merges "scene" over *scene, and checks that the playground can be shown in the result. item is NULL if "scene" is
 * absent. Returns KD_EINVAL with a pointer. */
enum kd_status kd_playground_session_read_scene(const cJSON *item, const struct kd_playground *p,
                                                const struct kd_assets *assets, struct kd_scene *scene,
                                                struct kd_error *error);
/* Returns the rate of the preset that the document names, or the default rate. */
double kd_playground_session_usual_rate(const cJSON *tree);
/* Parses {"by": M} of a step. */
enum kd_status kd_playground_session_read_step(const char *text, size_t length, double *by, struct kd_error *error);

struct kd_playground_session_json_options {
    const struct kd_scene *scene; /* scene of the picture of the playground */
    /* the token is included, because the client has just opened the session */
    bool token;
    /* bodies with ids above this are listed as "added"; UINT32_MAX: no such list */
    uint32_t before;
    const struct kd_playground_progress *progress; /* progress of a step; NULL: this is not the answer to a step */
};
enum kd_status kd_playground_session_to_json(const struct kd_playground_session *play,
                                             const struct kd_playground_session_state *state, struct kd_playground *p,
                                             const struct kd_playground_session_json_options *told,
                                             struct kd_buffer *out);
/* Writes {"columns": {name: [...]}}. */
enum kd_status kd_playground_session_series_json(const struct kd_playground_series *series,
                                                 const double now[KD_SERIES_N], struct kd_buffer *out);
/* Writes {"presets", "settings", "body"}, which describe what a request may contain. */
enum kd_status kd_playground_session_catalogue_json(struct kd_buffer *out);

#endif
