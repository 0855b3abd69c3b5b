/* What openapi.json says of POST /v1/orbits. HTTP thread only. */
#ifndef KD_SERVER_OPENAPI_ORBITS_H
#define KD_SERVER_OPENAPI_ORBITS_H

#include <cjson/cJSON.h>

void kd_openapi_orbits_bodies(cJSON *operation, cJSON *ok);

#endif
