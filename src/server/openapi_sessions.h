/* What /openapi.json says of the routes of a session that take more than a scene. */
#ifndef KD_SERVER_OPENAPI_SESSIONS_H
#define KD_SERVER_OPENAPI_SESSIONS_H

#include <cjson/cJSON.h>

void kd_openapi_strike_body(cJSON *operation);
void kd_openapi_particles_parameters(cJSON *list);

#endif
