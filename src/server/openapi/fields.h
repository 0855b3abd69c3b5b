/* Fields of a scene by their dotted paths, as openapi.json has them: parameters of a query, and names of a sweep's
 * axes. */
#ifndef KD_SERVER_OPENAPI_FIELDS_H
#define KD_SERVER_OPENAPI_FIELDS_H

#include "base/json.h"

#include <cjson/cJSON.h>

/* Parameters of an operation: every scalar of the schema of a scene, but for old names. */
void kd_openapi_field_parameters(struct kd_json *json, const cJSON *schema);
/* FieldPath, a member of components.schemas: the enumeration of these paths. */
void kd_openapi_field_paths(struct kd_json *json, const cJSON *schema);

#endif
