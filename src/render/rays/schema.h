/* The JSON Schema of requests for rays, from the rows of rays/fields.h, and of their answers. One thread a document. */
#ifndef KD_RENDER_RAYS_SCHEMA_H
#define KD_RENDER_RAYS_SCHEMA_H

#include "base/schema.h"

#include <stddef.h>

/* Writes the schema of a request as the JSON member `name`. */
void kd_rays_request_schema(struct kd_json *json, const char *name);
/* kd_rays_field_name: name of a field outside a JSON request, for use with an NPY array; NULL after the last field.
 * *help describes the field. kd_rays_field_schema writes the field's schema as the member "schema". */
const char *kd_rays_field_name(size_t index, const char **help);
void kd_rays_field_schema(struct kd_json *json, size_t index);

/* The schema components of a JSON answer (rays/answer.h); the answer itself is RaysAnswer. */
void kd_rays_answer_schemas(struct kd_json *json);

#endif
