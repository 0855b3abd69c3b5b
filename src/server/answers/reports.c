/* Reports of the server about itself: health, device and cached documents. */
#include "server/openapi/cached_documents.h"
#include "server/http/reply.h"
#include "server/http/representation.h"
#include "server/http/request.h"
#include "server/render/queue.h"
#include "scene/scene.h"

#include <stdio.h>

enum MHD_Result kd_handle_health(struct kd_request *request)
{
    static const char alive[] = "{\"status\":\"alive\"}\n";
    return kd_reply_send(request, MHD_HTTP_OK, kd_reply_static(alive, sizeof alive - 1, request->route->answer));
}

enum MHD_Result kd_handle_ready(struct kd_request *request)
{
    static const char ready[] = "{\"status\":\"ready\"}\n";
    struct kd_error error;
    if (kd_render_queue_lost(request->server->renders, &error))
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING, .detail = error.message });
    if (atomic_load(&request->server->phase) != KD_SERVING)
        return kd_reply_problem(
            request,
            &(struct kd_problem) { .type = KD_PROBLEM_STOPPING, .retry_after = 1, .detail = "the server is stopping" });
    return kd_reply_send(request, MHD_HTTP_OK, kd_reply_static(ready, sizeof ready - 1, request->route->answer));
}

enum MHD_Result kd_handle_device(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    enum kd_status status = kd_render_queue_device_json(request->server->renders, &json);
    return kd_reply_json(request, status, &json, request->route->answer);
}

enum MHD_Result kd_handle_docs(struct kd_request *request)
{
    static const char *const guarded[] = { "Content-Security-Policy",
                                           "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'",
                                           "Referrer-Policy", "no-referrer", NULL };
    return kd_reply_served(request, kd_cached_documents_find(request->server->documents, "/docs"), guarded);
}

enum MHD_Result kd_handle_cached_document(struct kd_request *request)
{
    const struct kd_served *document = kd_cached_documents_find(request->server->documents, request->target.path);
    char preset[128];
    if (!document && request->rest &&
        snprintf(preset, sizeof preset, "/v1/presets/%s", kd_scene_preset_name_now(request->rest)) < (int)sizeof preset)
        document = kd_cached_documents_find(request->server->documents, preset);
    struct kd_scene scene;
    struct kd_error error = { 0 };
    if (document)
        return kd_reply_served(request, document, NULL);
    kd_scene_preset(&scene, request->rest, &error); /* called only for its error message, which lists the presets */
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = error.message });
}
