/* The fields of a scene in openapi.json, by their dotted paths. They are query parameters, and names of the axes of
 * a sweep. */
#ifndef KD_SERVER_OPENAPI_FIELDS_H
#define KD_SERVER_OPENAPI_FIELDS_H

#include "base/json.h"

#include <cjson/cJSON.h>

/* Writes the query parameters of an operation: one for each scalar in the schema of a scene. Deprecated names are
 * left out. */
void kd_openapi_field_parameters(struct kd_json *json, const cJSON *schema);
/* Writes the member "schema" of a preset's name. */
void kd_openapi_preset_schema(struct kd_json *json);
/* Write the parameters of operations with a scene. kd_openapi_preset_parameter is for operations that accept the
 * scene only in the body. */
void kd_openapi_preset_parameter(struct kd_json *json, unsigned method, const cJSON *schema);
void kd_openapi_scene_parameters(struct kd_json *json, unsigned method, const cJSON *schema);
/* Writes FieldPath, a member of components.schemas, which enumerates these paths. */
void kd_openapi_field_paths(struct kd_json *json, const cJSON *schema);

#endif
