#include "server/http/route.h"

#include "server/http/request.h"

#include <string.h>

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
        { "GET", KD_GET }, { "HEAD", KD_GET }, { "POST", KD_POST }, { "PATCH", KD_PATCH }, { "DELETE", KD_DELETE }, { "PUT", KD_PUT },
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
    case KD_GET | KD_PUT: return "GET, HEAD, PUT";
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
