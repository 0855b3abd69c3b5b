/* This is what openapi.json says of the routes of a session that take more than a scene. */
#ifndef KD_SERVER_OPENAPI_SESSIONS_H
#define KD_SERVER_OPENAPI_SESSIONS_H

#include "base/json.h"

void kd_openapi_strike_body(struct kd_json *json);
void kd_openapi_path_body(struct kd_json *json);
void kd_openapi_particles_parameters(struct kd_json *json);

#endif
