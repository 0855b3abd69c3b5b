/* What /openapi.json says of POST /v1/rays. */
#ifndef KD_SERVER_OPENAPI_RAYS_H
#define KD_SERVER_OPENAPI_RAYS_H

#include <cjson/cJSON.h>

/* Appended to the operation's list: what goes with an array. */
void kd_openapi_rays_parameters(cJSON *list);
/* requestBody of the operation and content of its 200. */
void kd_openapi_rays_bodies(cJSON *operation, cJSON *ok);

#endif
