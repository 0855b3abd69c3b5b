/* Answers in openapi.json: statuses, headers and media types of each route. One thread at a time for a document. */
#ifndef KD_SERVER_OPENAPI_RESPONSES_H
#define KD_SERVER_OPENAPI_RESPONSES_H

#include "base/json.h"
#include "server/http/route.h"

/* The success statuses of an operation, and their maximum number. */
enum { KD_OPENAPI_SUCCESSES = 4 };
size_t kd_openapi_successes(const struct kd_route *route, unsigned method, unsigned out[KD_OPENAPI_SUCCESSES]);
/* Writes the member "responses" of an operation. */
void kd_openapi_responses(struct kd_json *json, const struct kd_route *route, unsigned method);

#endif
