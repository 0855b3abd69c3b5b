#include "server/http/route.h"

#include "document/text.h"
#include "server/http/request.h"

#include <stdio.h>
#include <string.h>

/* True if the path matches the route. *rest then points into the path, which is modified. */
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
    size_t n = strcspn(path + before, route->folders ? "" : "/");
    if (strcmp(path + before + n, after))
        return false;
    path[before + n] = 0;
    *rest = path + before;
    return true;
}

enum kd_status kd_route_path(const struct kd_route *route, const char *rest, struct kd_buffer *out)
{
    const size_t before = strcspn(route->path, "{");
    const char *brace = strchr(route->path, '}');
    return kd_buffer_printf(out, "%.*s%s%s", (int)before, route->path, rest, brace ? brace + 1 : "");
}

const struct kd_route *kd_route_of(char *path, const char **rest)
{
    for (size_t i = 0; i < kd_n_routes; i++)
        if (matches(&kd_routes[i], path, rest))
            return &kd_routes[i];
    return NULL;
}

const struct kd_method kd_methods[KD_METHODS] = {
    { "GET", "get", KD_GET },          { "POST", "post", KD_POST }, { "PATCH", "patch", KD_PATCH },
    { "DELETE", "delete", KD_DELETE }, { "PUT", "put", KD_PUT },
};

unsigned kd_route_method(const char *method)
{
    if (!strcmp(method, "HEAD"))
        return KD_GET;
    for (size_t i = 0; i < KD_METHODS; i++)
        if (!strcmp(kd_methods[i].name, method))
            return kd_methods[i].bit;
    return 0;
}

const char *kd_route_methods(const struct kd_route *route)
{
    static _Thread_local char text[48];
    size_t n = 0;
    for (size_t i = 0; i < KD_METHODS; i++)
        if (!route || route->methods & kd_methods[i].bit)
            n += (size_t)snprintf(text + n, sizeof text - n, "%s%s%s", n ? ", " : "", kd_methods[i].name,
                                  kd_methods[i].bit == KD_GET ? ", HEAD" : "");
    return text;
}

const char *kd_route_allow(const struct kd_route *route)
{
    static _Thread_local char text[64];
    snprintf(text, sizeof text, "%s, OPTIONS", kd_route_methods(route));
    return text;
}

static const char *const health[] = { "/healthz", "/readyz", "/metrics" };
#define N_HEALTH (sizeof health / sizeof *health)

static bool is_health(const char *path, size_t n)
{
    for (size_t i = 0; i < N_HEALTH; i++)
        if (n == strlen(health[i]) && !memcmp(path, health[i], n))
            return true;
    return false;
}

static bool refuse(struct kd_problem *problem, const char *detail)
{
    *problem = (struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = detail };
    return false;
}

bool kd_route_has_query(const struct kd_route *route, const char *name)
{
    for (const struct kd_query *query = route ? route->queries : NULL; query && query->name; query++)
        if (!strcmp(query->name, name) || (query->was && !strcmp(query->was, name)))
            return true;
    return false;
}

enum kd_status kd_route_query(const struct kd_request *request, const char *name, const char **given,
                              const char **value, struct kd_error *error)
{
    const struct kd_query *query = request->route->queries;
    while (query && query->name && strcmp(query->name, name))
        query++;
    const char *was = query && query->name ? query->was : NULL, *now = NULL, *before = NULL;
    if (query && query->name) {
        now = kd_target_value(&request->target, name);
        before = was ? kd_target_value(&request->target, was) : NULL;
    }
    char pointer[sizeof error->pointer] = "";
    *given = before ? was : name;
    *value = before ? before : now;
    if (!now || !before)
        return KD_OK;
    kd_text_pointer(pointer, sizeof pointer, was);
    return kd_error_field(error, pointer, "the query has %s, and its former name %s too", name, was);
}

bool kd_route_checks_query(const struct kd_route *route)
{
    const bool read = route->takes == KD_TAKES_QUANTITY || kd_taken[route->takes].parameters;
    return route->queries || !strncmp(route->path, "/v1/", 4) ? !read || route->methods & KD_PATCH : false;
}

enum kd_status kd_route_only(const struct kd_request *request, struct kd_error *error)
{
    enum { MOST = 15 };
    const unsigned method = kd_route_method(request->method);
    const char *known[MOST + 1] = { 0 }, *former[MOST + 1] = { 0 };
    size_t n = 0, n_former = 0;
    if (!kd_route_checks_query(request->route))
        return KD_OK;
    for (const struct kd_query *query = request->route->queries; query && query->name && n < MOST; query++)
        if (kd_route_for(query->methods, method)) {
            known[n++] = query->name;
            if (query->was)
                former[n_former++] = query->was;
        }
    if (!n)
        known[0] = "token";
    return kd_target_only(&request->target, known, former, error);
}

bool kd_route_is_dated(const struct kd_request *request)
{
    const struct kd_query *query = request->route ? request->route->queries : NULL;
    for (; query && query->name; query++)
        if (query->was && kd_target_value(&request->target, query->was))
            return true;
    return false;
}

bool kd_route_find(struct kd_request *request, struct kd_problem *problem)
{
    const struct kd_base_path *base = &request->server->base;
    char *path = request->target.path;
    const char *behind = kd_base_path_behind(base, path);
    if (!behind && !is_health(path, strlen(path)))
        return refuse(problem, base->outside);
    request->target.path = path += behind ? behind - path : 0;
    char home[] = "/";
    request->rest = "";
    const struct kd_route *route = kd_route_of(*base->path && !*path ? home : path, &request->rest);
    if (!route)
        return refuse(problem, base->unknown);
    request->route = request->matched = route;
    if (route->methods & kd_route_method(request->method))
        return true;
    *problem = (struct kd_problem) { .type = KD_PROBLEM_METHOD,
                                     .allow = kd_route_allow(route),
                                     .detail = "the Allow header lists the methods of this address" };
    return false;
}

bool kd_route_is_health(const struct kd_base_path *base, const char *raw)
{
    const char *behind = kd_base_path_behind(base, raw);
    return is_health(raw, strcspn(raw, "?")) || (behind && is_health(behind, strcspn(behind, "?")));
}

/* Tests whether the bytes begin with the two texts, one after the other. Returns 1 for yes, 0 for no, and -1 if more
 * bytes are needed. *end: position after the texts. */
static int begins_with(const char *bytes, size_t n, const char *const texts[3], size_t *end)
{
    *end = 0;
    for (size_t i = 0; i < 3; i++) {
        size_t size = strlen(texts[i]), left = n - *end;
        if (memcmp(bytes + *end, texts[i], left < size ? left : size))
            return 0;
        if (left < size)
            return -1;
        *end += size;
    }
    return 1;
}

enum kd_begins kd_route_begins(const struct kd_base_path *base, const char *bytes, size_t n)
{
    static const char *const methods[] = { "GET ", "HEAD " };
    const char *const bases[] = { "", base->path };
    bool unclear = false;
    for (size_t k = 0; k < 2 * 2 * N_HEALTH; k++) {
        size_t end;
        int path =
            begins_with(bytes, n, (const char *const[3]) { methods[k % 2], bases[k / 2 % 2], health[k / 4] }, &end);
        if (path > 0 && n > end && (bytes[end] == ' ' || bytes[end] == '?'))
            return KD_BEGINS_HEALTH;
        unclear |= path < 0 || (path > 0 && n == end);
    }
    return unclear ? KD_BEGINS_UNCLEAR : KD_BEGINS_OTHER;
}
