/* What the server says of itself: health, device, presets, schema. */
#include "base/json.h"
#include "server/reply.h"
#include "server/request.h"

enum MHD_Result kd_handle_health(struct kd_request *request)
{
    static const char alive[] = "{\"status\":\"alive\"}\n";
    return kd_reply_send(request, MHD_HTTP_OK,
                         kd_reply_static(alive, sizeof alive - 1, request->route->answer));
}

enum MHD_Result kd_handle_ready(struct kd_request *request)
{
    static const char ready[] = "{\"status\":\"ready\"}\n";
    struct kd_error error;
    if (kd_render_queue_lost(request->server->renders, &error))
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING, .detail = error.message });
    if (atomic_load(&request->server->phase) != KD_SERVING)
        return kd_reply_problem(request,
                                &(struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                                       .retry_after = 1,
                                                       .detail = "the server has been asked to stop" });
    return kd_reply_send(request, MHD_HTTP_OK,
                         kd_reply_static(ready, sizeof ready - 1, request->route->answer));
}

enum MHD_Result kd_handle_device(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    enum kd_status status = kd_render_queue_device_json(request->server->renders, &json);
    return kd_reply_json(request, status, &json, request->route->answer);
}

static enum kd_status presets_json(struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_array(&json, "presets");
    for (size_t i = 0; i < kd_scene_preset_count(); i++) {
        kd_json_object(&json, NULL);
        kd_json_string(&json, "name", kd_scene_preset_name(i));
        kd_json_string(&json, "title", kd_scene_preset_title(i));
        kd_json_end(&json);
    }
    kd_json_end(&json);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

enum MHD_Result kd_handle_presets(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    return kd_reply_json(request, presets_json(&json), &json, request->route->answer);
}

enum MHD_Result kd_handle_preset(struct kd_request *request)
{
    struct kd_scene scene;
    struct kd_error error;
    struct kd_buffer json = { 0 };

    if (kd_scene_preset(&scene, request->rest, &error))
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = error.message });
    return kd_reply_json(request, kd_scene_to_json(&scene, &json), &json, request->route->answer);
}

enum MHD_Result kd_handle_schema(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    return kd_reply_json(request, kd_scene_schema(&json), &json, request->route->answer);
}
