/* What openapi.json says of answers: their statuses, headers and media types, by the route. One thread a document. */
#ifndef KD_SERVER_OPENAPI_RESPONSES_H
#define KD_SERVER_OPENAPI_RESPONSES_H

#include "base/json.h"
#include "server/http/route.h"

/* The member "responses" of an operation. */
void kd_openapi_responses(struct kd_json *json, const struct kd_route *route, unsigned method);
/* What the member "headers" of any answer says to a page of another origin that the server lists. */
void kd_openapi_cors(struct kd_json *json);
/* The component of the document that each refusal is; the headers that all answers have for pages of other origins, and the answer that
 * carries it, the members "headers" and "responses" of the components. */
void kd_openapi_problem_schema(struct kd_json *json);
void kd_openapi_problem(struct kd_json *json);
/* The header of every answer, the member "headers" of the components. */
void kd_openapi_headers(struct kd_json *json);

#endif
