#include "server/openapi/links.h"

#include "base/schema.h"
#include "server/openapi/access.h"
#include "server/openapi/media.h"

#include <stdio.h>
#include <string.h>

/* Adds a link and its parameters. If the operation of the link changes an object, it also needs the token of the
 * object. */
static void add_link(struct kd_json *json, const struct kd_route *to, const struct kd_method *method)
{
    char id[80], parameter[20], value[40];
    const char *brace = strchr(to->path, '{') + 1;
    kd_openapi_operation_id(id, sizeof id, method->lower, to->path);
    snprintf(parameter, sizeof parameter, "%.*s", (int)strcspn(brace, "}"), brace);
    snprintf(value, sizeof value, "$response.body#/%s", parameter);
    kd_json_object(json, id);
    kd_json_string(json, "operationId", id);
    kd_json_object(json, "parameters");
    kd_json_string(json, parameter, value);
    if (kd_openapi_is_owners(to, method->bit))
        kd_json_string(json, "query.token", "$response.body#/token");
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_links(struct kd_json *json, const struct kd_route *route, unsigned status)
{
    const size_t n = strlen(route->path);
    if (status != 201 && status != 202)
        return;
    kd_json_object(json, "links");
    for (size_t i = 0; i < kd_n_routes; i++)
        for (size_t k = 0;
             k < KD_METHODS && !strncmp(kd_routes[i].path, route->path, n) && !strncmp(kd_routes[i].path + n, "/{", 2);
             k++)
            if (kd_routes[i].methods & kd_methods[k].bit)
                add_link(json, &kd_routes[i], &kd_methods[k]);
    kd_json_end(json);
}
