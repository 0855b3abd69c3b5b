/* POST /v1/orbits in openapi.json. */
#ifndef KD_SERVER_OPENAPI_ORBITS_H
#define KD_SERVER_OPENAPI_ORBITS_H

#include "base/json.h"

void kd_openapi_orbits_schema(struct kd_json *json); /* writes "Orbit" of components.schemas */

#endif
