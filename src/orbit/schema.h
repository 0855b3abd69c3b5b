/* Writes the JSON Schema of requests for orbits, from the tables of their fields, and of the answers. Any thread. */
#ifndef KD_ORBIT_SCHEMA_H
#define KD_ORBIT_SCHEMA_H

#include "base/json.h"

/* Writes the component Orbit and the components of its forms. */
void kd_orbit_schemas(struct kd_json *json);
/* Writes the schema of the whole request, which refers to these components. */
void kd_orbit_request_schema(struct kd_json *json, const char *name);

/* Writes the components of answers in JSON (orbit/answer.h): OrbitPath for one orbit, OrbitPaths for many. */
void kd_orbit_answer_schemas(struct kd_json *json);

#endif
