#include "server/openapi/access.h"

#include "base/schema.h"
#include "server/http/access.h"

void kd_openapi_access_schemes(struct kd_json *json)
{
    kd_schema_text(json, "securitySchemes",
                   "{\"token\":{\"type\":\"http\",\"scheme\":\"bearer\",\"description\":\"the token from the creation "
                   "of the session, playground, job or "
                   "asset\"},\"tokenQuery\":{\"type\":\"apiKey\",\"in\":\"query\",\"name\":\"token\",\"description\":"
                   "\"the token from the creation of the object, if Authorization has an access "
                   "token\"},\"access\":{\"type\":\"http\",\"scheme\":\"bearer\",\"description\":\"an access token of "
                   "the server's token file, if it has "
                   "one\"},\"accessHeader\":{\"type\":\"apiKey\",\"in\":\"header\",\"name\":\"" KD_ACCESS_HEADER
                   "\",\"description\":\"the access token, if Authorization has another "
                   "token\"},\"accessCookie\":{\"type\":\"apiKey\",\"in\":\"cookie\",\"name\":\"" KD_ACCESS_COOKIE
                   "\",\"description\":\"the access token, for a browser that opened a page with "
                   "?access=TOKEN\"},\"link\":{\"type\":\"apiKey\",\"in\":\"query\",\"name\":\"signature\","
                   "\"description\":\"the last parameter of a signed link, behind signer, expires and budget_ms\"}}");
}

/* The authentication methods for a role. Where OpenAPI expects scopes, it permits names of roles. */
#define WAYS(role) "{\"access\":[\"" role "\"]},{\"accessHeader\":[\"" role "\"]},{\"accessCookie\":[\"" role "\"]}]"

void kd_openapi_access_default(struct kd_json *json, bool closed)
{
    kd_schema_text(json, "security", closed ? "[" WAYS("view") : "[{}," WAYS("view"));
}

bool kd_openapi_is_owners(const struct kd_route *route, unsigned method)
{
    return method == KD_PATCH || method == KD_DELETE || (method == KD_POST && route->owner);
}

void kd_openapi_access_operation(struct kd_json *json, const struct kd_route *route, unsigned method, bool closed)
{
#define BOTH \
    "{\"token\":[],\"accessHeader\":[\"render\"]},{\"token\":[],\"accessCookie\":[\"render\"]},{\"tokenQuery\":[]," \
    "\"access\":[\"render\"]},{\"tokenQuery\":[],\"accessHeader\":[\"render\"]},{\"tokenQuery\":[],\"accessCookie\":[" \
    "\"render\"]}]"
    if (kd_openapi_is_owners(route, method))
        kd_schema_text(json, "security", closed ? "[" BOTH : "[{\"token\":[]},{\"tokenQuery\":[]}," BOTH);
    else if (route->open)
        kd_schema_text(json, "security", "[]");
    else if (kd_role_may(KD_ROLE_LINK, route, method))
        kd_schema_text(json, "security", closed ? "[{\"link\":[]}," WAYS("view") : "[{}," WAYS("view"));
    else if (!kd_role_may(KD_ROLE_VIEW, route, method))
        kd_schema_text(json, "security", closed ? "[" WAYS("render") : "[{}," WAYS("render"));
#undef BOTH
}
