/* What openapi.json says of answers: their statuses, headers and media types, by the route. One thread a document. */
#ifndef KD_SERVER_OPENAPI_RESPONSES_H
#define KD_SERVER_OPENAPI_RESPONSES_H

#include "base/json.h"
#include "server/http/route.h"

/* The member "responses" of an operation. */
void kd_openapi_responses(struct kd_json *json, const struct kd_route *route, unsigned method);

#endif
