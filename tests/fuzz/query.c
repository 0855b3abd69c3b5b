/* Fuzz target: a scene in a request to the server. The input is a target and, after a line "---", the body of a POST.
 * The request must be refused, or give a valid scene. */
#include "fuzz.h"

#include "server/asset/store.h"
#include "server/render/scene_source.h"

static struct kd_asset_store *store; /* without assets; lives as long as the process */

static void begin(void)
{
    const struct kd_asset_limits limits = { 1, 1, 1, 1, 1 };
    if (!store)
        CHECK(!kd_asset_store_create(&limits, &store, NULL), "no store of assets can be made");
}

int kd_fuzz_query(const uint8_t *data, size_t size)
{
    static const struct kd_query own[] = { { .name = "format" }, { 0 } };
    static const struct kd_route get = { .path = "/v1/render", .methods = KD_GET | KD_POST, .queries = own };
    struct kd_fuzz_text raw = kd_fuzz_part(&data, &size), body = kd_fuzz_bare(data, size);
    struct kd_error error = { 0 };
    struct kd_problem problem = { 0 };
    struct kd_scene scene;
    begin();
    struct kd_server server = { .assets = store };
    struct kd_request request = { .server = &server,
                                  .route = &get,
                                  .method = body.size ? "POST" : "GET",
                                  .body = { (uint8_t *)body.at, body.size, body.size } };
    enum kd_status status = kd_target_parse(&request.target, raw.at, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else if (kd_scene_of_request(&request, &scene, &problem, &error)) {
        kd_fuzz_sound(&scene);
        CHECK(!kd_scene_validate(&scene, &error), "a request's scene is not valid: %s", error.message);
    } else {
        kd_fuzz_refused(error.status, &error);
        CHECK(problem.detail == error.message && kd_problem_status(problem.type) >= 400, "a refusal is no problem");
    }
    kd_target_finish(&request.target);
    free(raw.at);
    free(body.at);
    return 0;
}
