/* This is what openapi.json says of POST /v1/orbits. */
#ifndef KD_SERVER_OPENAPI_ORBITS_H
#define KD_SERVER_OPENAPI_ORBITS_H

#include "base/json.h"

/* The operation's requestBody; what belongs into the content of its answer. */
void kd_openapi_orbits_body(struct kd_json *json);
void kd_openapi_orbits_schema(struct kd_json *json); /* "Orbit", of components.schemas */
void kd_openapi_orbits_answer(struct kd_json *json);

#endif
