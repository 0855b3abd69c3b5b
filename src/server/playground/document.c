#include "server/playground/document.h"

#include "playground/preset.h"
#include "playground/show.h"
#include "document/members.h"
#include "scene/tree.h"

#include <string.h>

#define USUAL_RATE 50.
#define STEP_VALUES 16 /* maximum number of JSON values in the body of a step, which has one field */
#define STEP_MOST KD_PLAYGROUND_TIME

#define AT(name) offsetof(struct kd_playground_session_pace, name)
static const struct kd_row pace_rows[] = {
    { .name = "rate",
      .kind = KD_KIND_REAL,
      .offset = AT(rate),
      .initial = USUAL_RATE,
      .most = KD_PLAY_RATE_MAX,
      .help = "pace in M per second of real time" },
    { .name = "paused", .kind = KD_KIND_BOOL, .offset = AT(paused), .help = "whether the simulation is paused" },
};
static const struct kd_document pace_document = { .rows = pace_rows, .n = sizeof pace_rows / sizeof *pace_rows };
static const struct kd_row step_row = { .name = "by", .kind = KD_KIND_REAL, .most = STEP_MOST };
static const struct kd_document step_document = { .rows = &step_row, .n = 1 };

enum kd_status kd_playground_session_read_pace(cJSON *tree, struct kd_playground_session_pace *pace,
                                               struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sizeof pace_rows / sizeof *pace_rows; i++) {
        char pointer[40] = "/";
        cJSON *item = cJSON_DetachItemFromObjectCaseSensitive(tree, pace_rows[i].name);
        if (!item)
            continue;
        const struct kd_value value = kd_tree_value(item);
        status = kd_row_put(&pace_rows[i], pace, &value, pace_rows[i].name, strcat(pointer, pace_rows[i].name), error);
        cJSON_Delete(item);
        if (status)
            break;
    }
    return status;
}

enum kd_status kd_playground_session_read_scene(const cJSON *item, const struct kd_playground *p,
                                                const struct kd_assets *assets, struct kd_scene *scene,
                                                struct kd_error *error)
{
    enum kd_status status;
    if (!item)
        return KD_OK;
    if (!cJSON_IsObject(item))
        return kd_error_field(error, "/scene", "scene is not an object");
    KD_TRY(kd_scene_from_tree(scene, item, true, error));
    KD_TRY(kd_scene_resolve(scene, assets, error));
    KD_TRY(kd_scene_validate(scene, error));
    KD_TRY(kd_playground_may_show(p, scene, error));
done:
    return kd_member_inside(status, "/scene", error);
}

double kd_playground_session_usual_rate(const cJSON *tree)
{
    const struct kd_playground_preset *preset = kd_playground_preset_in(tree);
    return preset ? preset->rate : USUAL_RATE;
}

enum kd_status kd_playground_session_read_step(const char *text, size_t length, double *by, struct kd_error *error)
{
    cJSON *tree = NULL;
    enum kd_status status;
    uint64_t given = 0;
    KD_TRY(kd_tree_parse(text, length, 4096, STEP_VALUES, &tree, error));
    if (!cJSON_IsObject(tree))
        KD_TRY(kd_error_set(error, KD_EINVAL, "the body is not a JSON object"));
    KD_TRY(kd_document_read(&step_document, by, tree, "", &given, error));
    if (!given || !(*by > 0))
        KD_TRY(kd_error_field(error, "/by", "by is %s; it must be a number above 0", given ? "0" : "missing"));
done:
    cJSON_Delete(tree);
    return status;
}

static void add_added(struct kd_json *json, const struct kd_playground *p, uint32_t before)
{
    kd_json_array(json, "added");
    for (size_t i = 0; i < p->n; i++)
        if (p->bodies[i].id > before)
            kd_json_number(json, NULL, p->bodies[i].id);
    kd_json_end(json);
}

enum kd_status kd_playground_session_to_json(const struct kd_playground_session *play,
                                             const struct kd_playground_session_state *state, struct kd_playground *p,
                                             const struct kd_playground_session_json_options *told,
                                             struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "id", kd_playground_session_id(play));
    if (told->token)
        kd_json_string(&json, "token", kd_playground_session_token(play));
    kd_json_number(&json, "rate", state->pace.rate);
    kd_json_number(&json, "rate_reached", state->reached);
    kd_json_bool(&json, "paused", state->pace.paused);
    kd_json_bool(&json, "slowed", told->progress ? told->progress->slowed : state->slowed);
    kd_json_bool(&json, "resting", state->resting);
    kd_json_number(&json, "watchers", state->watchers);
    kd_json_number(&json, "generation", (double)state->generation);
    if (told->progress) {
        kd_json_number(&json, "asked", told->progress->asked);
        kd_json_number(&json, "done", told->progress->done);
    }
    if (told->before != UINT32_MAX)
        add_added(&json, p, told->before);
    kd_playground_status_json(p, &json);
    struct kd_buffer scene = { 0 };
    enum kd_status status = kd_scene_to_json(told->scene, &scene);
    kd_json_raw(&json, "scene", status ? "null" : (const char *)scene.data, status ? 4 : scene.size);
    kd_buffer_finish(&scene);
    kd_json_end(&json);
    return kd_json_finish_line(&json) || status ? KD_ENOMEM : KD_OK;
}

enum kd_status kd_playground_session_series_json(const struct kd_playground_series *series,
                                                 const double now[KD_SERIES_N], struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_object(&json, "columns");
    for (int i = 0; i < KD_SERIES_N; i++) {
        kd_json_array(&json, kd_series_column(i));
        for (size_t k = 0; k < series->n; k++)
            kd_json_number(&json, NULL, series->rows[k][i]);
        if (kd_series_lacks(series, now))
            kd_json_number(&json, NULL, now[i]);
        kd_json_end(&json);
    }
    kd_json_end(&json);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

enum kd_status kd_playground_session_catalogue_json(struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_array(&json, "presets");
    for (size_t i = 0; i < kd_playground_n_presets; i++) {
        const struct kd_playground_preset *preset = &kd_playground_presets[i];
        kd_json_object(&json, NULL);
        kd_json_string(&json, "name", preset->name);
        kd_json_string(&json, "title", preset->title);
        kd_json_number(&json, "rate", preset->rate);
        kd_json_array(&json, "centre");
        for (int k = 0; k < 3; k++)
            kd_json_number(&json, NULL, preset->centre[k]);
        kd_json_end(&json);
        kd_json_number(&json, "reach", preset->reach);
        kd_json_end(&json);
    }
    kd_json_end(&json);
    kd_document_describe(&json, "settings", &kd_playground_settings);
    kd_document_describe(&json, "pace", &pace_document);
    kd_document_describe(&json, "body", &kd_playground_body_fields);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}
