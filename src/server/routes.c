#include "server/routes.h"

#include "server/request.h"

#include <string.h>

#define JSON "application/json"

const struct kd_route kd_routes[] = {
    { "/", KD_GET, kd_handle_page, "text/html; charset=utf-8", "The page: a live view, its controls and what is computed",
      .status = { 200, 304 } },
    { "/web/{name}", KD_GET, kd_handle_page, "*/*", "What the page loads", .status = { 200, 304 } },
    { "/web/vendor/uplot/{name}", KD_GET, kd_handle_page, "*/*", "uPlot, which draws its plots", .status = { 200, 304 } },
    { "/healthz", KD_GET, kd_handle_health, JSON, "200 while the process lives" },
    { "/readyz", KD_GET, kd_handle_ready, JSON, "200 while renders are taken, 503 on the way down" },
    { "/metrics", KD_GET, kd_handle_metrics, "text/plain; version=0.0.4; charset=utf-8", "Counters and gauges for Prometheus" },
    { "/openapi.json", KD_GET, kd_handle_kept, JSON, "This description", .status = { 200, 304 } },
    { "/v1/device", KD_GET, kd_handle_device, JSON, "Device, driver, precision, memory, versions" },
    { "/v1/accuracy", KD_GET, kd_handle_accuracy, JSON,
      "Measured speed and error of the engines on this device; made by `kerrd bench accuracy`" },
    { "/v1/presets", KD_GET, kd_handle_kept, JSON, "Names and titles of the presets", .status = { 200, 304 } },
    { "/v1/presets/{name}", KD_GET, kd_handle_kept, JSON, "The scene of a preset", .status = { 200, 304 } },
    { "/v1/schema", KD_GET, kd_handle_kept, "application/schema+json", "JSON Schema of a scene", .status = { 200, 304 } },
    { "/v1/plan", KD_POST, kd_handle_plan, JSON,
      "What a scene requires: passes, rays, bytes, estimated time, approximations", KD_TAKES_SCENE },
    { "/v1/rays", KD_POST, kd_handle_rays, JSON,
      "End points of listed rays: equatorial crossings, redshift, delay, direction of escape, error", KD_TAKES_RAYS },
    { "/v1/physics", KD_GET, kd_handle_kept, JSON, "The quantities that /v1/physics/NAME gives",
      .status = { 200, 304 } },
    { "/v1/physics/{name}", KD_GET, kd_handle_quantity, JSON, "A quantity at a point, or along ranges of its parameters",
      KD_TAKES_QUANTITY },
    { "/v1/orbits", KD_POST, kd_handle_orbits, JSON,
      "Timelike orbits: path, turning points, constants of motion and their drift, frequencies, periastron advance", KD_TAKES_ORBITS },
    { "/v1/sessions", KD_POST, kd_handle_sessions, JSON, "A live session of a scene: its id, and the token that changes it",
      KD_TAKES_SCENE, .status = { 201 } },
    { "/v1/sessions/{id}", KD_GET | KD_PATCH | KD_DELETE, kd_handle_session, JSON,
      "A session's scene; a merge patch of it (RFC 7396); its end", KD_TAKES_SCENE },
    { "/v1/sessions/{id}/ringdown", KD_POST, kd_handle_session_ringdown, JSON,
      "Strikes the hole: style.ringdown, from now on the session's clock; the session's scene", KD_TAKES_STRIKE },
    { "/v1/sessions/{id}/particles", KD_GET, kd_handle_session_particles, "application/octet-stream",
      "Where its particles are, and their constants and rates: 32-bit little-endian floats, row by row", KD_TAKES_PARTICLES },
    { "/v1/sessions/{id}/frame.png", KD_GET, kd_handle_session_frame, "image/png",
      "The newest frame, as soon as it is newer than the one whose number is given as after; 204 if there is none in wait_ms",
      .status = { 200, 204 } },
    { "/v1/sessions/{id}/frames", KD_GET, kd_handle_session_frames, "multipart/x-mixed-replace",
      "Frames as they come, the newest only; with Accept: application/x-kerrd-frames length, number, revision and 0 before each",
      .also = "application/x-kerrd-frames" },
    { "/v1/sessions/{id}/events", KD_GET, kd_handle_session_events, "text/event-stream",
      "Numbers of each frame: quality in force, times, accuracy" },
    { "/v1/jobs", KD_POST, kd_handle_jobs, JSON, "A job, of one scene, of a list, or of a scene with keyframes: its id, and the token that ends it",
      KD_TAKES_JOB, .status = { 202 } },
    { "/v1/jobs/{id}", KD_GET | KD_DELETE, kd_handle_job, JSON, "How far a job is; its end, with its files" },
    { "/v1/jobs/{id}/events", KD_GET, kd_handle_job_events, "text/event-stream", "The same whenever it changes" },
    { "/v1/jobs/{id}/preview.png", KD_GET, kd_handle_job_preview, "image/png",
      "The frame that is being rendered, as far as it is drawn, else the last finished one; 409 while there is nothing" },
    { "/v1/jobs/{id}/result", KD_GET, kd_handle_job_result, "application/zip",
      "The picture of a job of one, or a ZIP of all; with format=png one frame, with format=stream the frames as they come; "
      "of a light curve its rows, as application/json or text/csv",
      .also = "image/png application/x-kerrd-frames application/json text/csv" },
    { "/v1/render", KD_GET | KD_POST, kd_handle_render, "image/png", "The picture of a scene", KD_TAKES_SCENE, .status = { 200, 304 } },
};
const size_t kd_n_routes = sizeof kd_routes / sizeof *kd_routes;

/* *rest is cut out of the path, which is ours to change once it matches. */
static bool matches(const struct kd_route *route, char *path, const char **rest)
{
    const char *brace = strchr(route->path, '{');
    if (!brace) {
        *rest = "";
        return !strcmp(route->path, path);
    }
    size_t before = (size_t)(brace - route->path);
    const char *after = strchr(brace, '}') + 1;
    if (strncmp(route->path, path, before))
        return false;
    size_t n = strcspn(path + before, "/");
    if (strcmp(path + before + n, after))
        return false;
    path[before + n] = 0;
    *rest = path + before;
    return true;
}

static bool permits(const struct kd_route *route, const char *method)
{
    static const struct { const char *name; unsigned bit; } methods[] = {
        { "GET", KD_GET }, { "HEAD", KD_GET }, { "POST", KD_POST }, { "PATCH", KD_PATCH }, { "DELETE", KD_DELETE },
    };
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (!strcmp(methods[i].name, method))
            return route->methods & methods[i].bit;
    return false;
}

static const char *allow(unsigned methods)
{
    switch (methods) {
    case KD_GET: return "GET, HEAD";
    case KD_POST: return "POST";
    case KD_GET | KD_POST: return "GET, HEAD, POST";
    case KD_GET | KD_DELETE: return "GET, HEAD, DELETE";
    default: return "GET, HEAD, PATCH, DELETE";
    }
}

bool kd_route_find(struct kd_request *request, struct kd_problem *problem)
{
    for (size_t i = 0; i < kd_n_routes; i++) {
        const struct kd_route *route = &kd_routes[i];
        if (!matches(route, request->target.text, &request->rest))
            continue;
        request->route = route;
        if (permits(route, request->method))
            return true;
        *problem = (struct kd_problem) { .type = KD_PROBLEM_METHOD,
                                         .allow = allow(route->methods),
                                         .detail = "the Allow header names the methods this address takes" };
        return false;
    }
    *problem = (struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                     .detail = "there is no such path; /openapi.json lists those there are" };
    return false;
}

static const char *const health[] = { "/healthz", "/readyz", "/metrics" };
#define N_HEALTH (sizeof health / sizeof *health)

bool kd_route_is_health(const char *raw)
{
    size_t n = strcspn(raw, "?");
    for (size_t i = 0; i < N_HEALTH; i++)
        if (n == strlen(health[i]) && !memcmp(raw, health[i], n))
            return true;
    return false;
}

/* Whether the bytes begin with the text (1), do not (0), or end before that is clear (-1). */
static int begins_with(const char *bytes, size_t n, const char *text)
{
    size_t size = strlen(text);
    if (memcmp(bytes, text, n < size ? n : size))
        return 0;
    return n < size ? -1 : 1;
}

enum kd_begins kd_route_begins(const char *bytes, size_t n)
{
    static const char *const methods[] = { "GET ", "HEAD " };
    bool unclear = false;
    for (size_t m = 0; m < 2; m++) {
        size_t size = strlen(methods[m]);
        int method = begins_with(bytes, n, methods[m]);
        unclear |= method < 0;
        for (size_t i = 0; method > 0 && i < N_HEALTH; i++) {
            size_t end = size + strlen(health[i]);
            int path = begins_with(bytes + size, n - size, health[i]);
            if (path > 0 && n > end && (bytes[end] == ' ' || bytes[end] == '?'))
                return KD_BEGINS_HEALTH;
            unclear |= path < 0 || (path > 0 && n == end);
        }
    }
    return unclear ? KD_BEGINS_UNCLEAR : KD_BEGINS_OTHER;
}
