/* The headers of answers in openapi.json, except those that HTTP, caches or browsers define in general. */
#ifndef KD_SERVER_OPENAPI_HEADERS_H
#define KD_SERVER_OPENAPI_HEADERS_H

#include "base/json.h"
#include "server/http/route.h"

/* Writes the member "headers" of an operation's successful answer, if it has such headers. */
void kd_openapi_headers(struct kd_json *json, const struct kd_route *route, unsigned method, unsigned status);
/* Writes the member "headers" of a problem. */
void kd_openapi_problem_headers(struct kd_json *json, unsigned status);
/* Writes the member "headers" of the components, to which the two functions above refer. */
void kd_openapi_header_components(struct kd_json *json);

/* kd_openapi_asked_headers writes the request headers of an operation into its list of parameters.
 * kd_openapi_is_asked_by_header returns whether there are any. */
bool kd_openapi_is_asked_by_header(const struct kd_route *route, unsigned method);
void kd_openapi_asked_headers(struct kd_json *json, const struct kd_route *route, unsigned method);

#endif
