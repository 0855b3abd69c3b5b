/* This writes the JSON Schema of requests for orbits, from the table of their fields, and of their answers. Any thread. */
#ifndef KD_ORBIT_SCHEMA_H
#define KD_ORBIT_SCHEMA_H

#include "base/json.h"

/* One orbit: a value of this name. */
void kd_orbit_schema(struct kd_json *json, const char *name);
/* The whole document; orbit: JSON that stands for the schema of one orbit, as {"$ref": ...}. */
void kd_orbit_request_schema(struct kd_json *json, const char *name, const char *orbit);

/* The components of an answer as JSON (orbit/answer.h): OrbitPath of one orbit, OrbitPaths of many. */
void kd_orbit_answer_schemas(struct kd_json *json);

#endif
