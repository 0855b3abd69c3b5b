/* Sessions in openapi.json: their answers, and the bodies and parameters of those routes that accept more than a
 * scene. */
#ifndef KD_SERVER_OPENAPI_SESSIONS_H
#define KD_SERVER_OPENAPI_SESSIONS_H

#include "base/json.h"
#include "server/http/route.h"

/* Writes the schemas of a session's answers. */
void kd_openapi_session_schemas(struct kd_json *json);
void kd_openapi_strike_body(struct kd_json *json, const struct kd_route *route);
extern const char kd_openapi_path_schema[]; /* schema of the body of .../path */
void kd_openapi_particles_parameters(struct kd_json *json, unsigned method, const struct cJSON *schema);

#endif
