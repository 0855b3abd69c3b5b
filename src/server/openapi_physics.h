/* /v1/physics/NAME in openapi.json: a path a quantity. Private to src/server. */
#ifndef KD_SERVER_OPENAPI_PHYSICS_H
#define KD_SERVER_OPENAPI_PHYSICS_H

#include <cjson/cJSON.h>

/* Add "/v1/physics/kerr" and so on to `paths`. */
void kd_openapi_physics_paths(cJSON *paths);

#endif
