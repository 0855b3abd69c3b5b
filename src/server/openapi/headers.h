/* Headers of answers in openapi.json, except those that HTTP, caches and browsers know anyway. */
#ifndef KD_SERVER_OPENAPI_HEADERS_H
#define KD_SERVER_OPENAPI_HEADERS_H

#include "base/json.h"
#include "server/http/route.h"

/* The member "headers" of an answer that is no problem, where it has any. */
void kd_openapi_headers(struct kd_json *json, const struct kd_route *route, unsigned method, unsigned status);
/* The same of a problem. */
void kd_openapi_problem_headers(struct kd_json *json, unsigned status);
/* The member "headers" of the components, which both refer to. */
void kd_openapi_header_components(struct kd_json *json);

/* Parameters of the operation that stand in the header of a request: into its list of parameters, which is there if
 * there are any. */
bool kd_openapi_is_asked_by_header(const struct kd_route *route, unsigned method);
void kd_openapi_asked_headers(struct kd_json *json, const struct kd_route *route, unsigned method);

#endif
