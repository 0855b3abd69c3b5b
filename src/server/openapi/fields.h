/* Fields of a scene by their dotted paths in openapi.json: as query parameters and as names of a sweep's axes. */
#ifndef KD_SERVER_OPENAPI_FIELDS_H
#define KD_SERVER_OPENAPI_FIELDS_H

#include "base/json.h"

#include <cjson/cJSON.h>

/* Writes the query parameters of an operation: one for every scalar in the schema of a scene, but not for deprecated
 * names. */
void kd_openapi_field_parameters(struct kd_json *json, const cJSON *schema);
/* Writes the member "schema" of a preset's name. */
void kd_openapi_preset_schema(struct kd_json *json);
/* Writes the parameters of operations that take a scene. kd_openapi_preset_parameter is for operations that take the
 * scene only in the body. */
void kd_openapi_preset_parameter(struct kd_json *json, unsigned method, const cJSON *schema);
void kd_openapi_scene_parameters(struct kd_json *json, unsigned method, const cJSON *schema);
/* Writes FieldPath, a member of components.schemas: the enumeration of these paths. */
void kd_openapi_field_paths(struct kd_json *json, const cJSON *schema);

#endif
