/* /v1/physics/NAME in openapi.json: one path for each quantity. Private to src/server. */
#ifndef KD_SERVER_OPENAPI_PHYSICS_H
#define KD_SERVER_OPENAPI_PHYSICS_H

#include "base/json.h"
#include "server/http/route.h"

/* Writes "/v1/physics/kerr" and so on as members of the paths. */
void kd_openapi_physics_paths(struct kd_json *json, const struct kd_route *route);

#endif
