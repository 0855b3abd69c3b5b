#include "server/openapi/access.h"

#include "base/schema.h"
#include "server/http/access.h"

#define REFUSED "{\"$ref\":\"#/components/responses/Problem\"}"

void kd_openapi_access_schemes(struct kd_json *json)
{
    kd_schema_text(json, "securitySchemes",
        "{\"token\":{\"type\":\"http\",\"scheme\":\"bearer\",\"description\":\"the token that came with the session, playground, job or asset\"},"
        "\"access\":{\"type\":\"http\",\"scheme\":\"bearer\",\"description\":\"an access token of the server's token file, where it has one\"},"
        "\"accessHeader\":{\"type\":\"apiKey\",\"in\":\"header\",\"name\":\"" KD_ACCESS_HEADER "\",\"description\":\"the same, where Authorization holds another token\"},"
        "\"accessCookie\":{\"type\":\"apiKey\",\"in\":\"cookie\",\"name\":\"" KD_ACCESS_COOKIE "\",\"description\":\"the same, of a browser that opened the page with ?access=TOKEN\"}}");
}

void kd_openapi_access_default(struct kd_json *json)
{
    kd_schema_text(json, "security", "[{},{\"access\":[]},{\"accessHeader\":[]},{\"accessCookie\":[]}]");
}

void kd_openapi_access_operation(struct kd_json *json, const struct kd_route *route, bool owner)
{
    if (owner)
        kd_schema_text(json, "security", "[{\"token\":[]},{\"token\":[],\"accessHeader\":[]},{\"token\":[],\"accessCookie\":[]}]");
    else if (route->open)
        kd_schema_text(json, "security", "[]");
}

void kd_openapi_access_refusals(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    if (route->open)
        return;
    kd_schema_text(json, "401", REFUSED);
    if (!kd_role_may(KD_ROLE_VIEW, route, method))
        kd_schema_text(json, "403", REFUSED);
}
