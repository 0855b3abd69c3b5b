/* JSON documents of a playground session: its settings in a request, and its state. Any thread. */
#ifndef KD_SERVER_PLAYGROUND_DOCUMENT_H
#define KD_SERVER_PLAYGROUND_DOCUMENT_H

#include "playground/json.h"
#include "scene/asset.h"
#include "scene/scene.h"
#include "server/playground/sessions.h"

/* Removes "rate" and "paused" from the tree, and stores them in *pace. A member that is absent in the tree is left
 * unchanged in *pace. Returns KD_EINVAL with a pointer. */
enum kd_status kd_playground_session_read_pace(cJSON *tree, struct kd_playground_session_pace *pace,
                                               struct kd_error *error);
/* Merges "scene" onto *scene, and checks that the result can show the playground. item: NULL if "scene" is absent.
 * Returns KD_EINVAL with a pointer. */
enum kd_status kd_playground_session_read_scene(const cJSON *item, const struct kd_playground *p,
                                                const struct kd_assets *assets, struct kd_scene *scene,
                                                struct kd_error *error);
/* Returns the rate of the preset that the document names; otherwise the default rate. */
double kd_playground_session_usual_rate(const cJSON *tree);
/* Parses the body of a step, {"by": M}. */
enum kd_status kd_playground_session_read_step(const char *text, size_t length, double *by, struct kd_error *error);

struct kd_playground_session_json_options {
    const struct kd_scene *scene; /* scene of the picture of the playground */
    /* true: the token is included, because the client has just opened the session */
    bool token;
    /* bodies with higher ids are listed as "added"; UINT32_MAX: this list is left out */
    uint32_t before;
    const struct kd_playground_progress *progress; /* progress of a step; NULL if this is not the answer to a step */
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
