/* This is what openapi.json says of sessions: what they answer, and what some of their routes take beside a scene. */
#ifndef KD_SERVER_OPENAPI_SESSIONS_H
#define KD_SERVER_OPENAPI_SESSIONS_H

#include "base/json.h"

/* Schemas of what a session answers. */
void kd_openapi_session_schemas(struct kd_json *json);
void kd_openapi_strike_body(struct kd_json *json);
void kd_openapi_path_body(struct kd_json *json);
void kd_openapi_particles_parameters(struct kd_json *json);

#endif
