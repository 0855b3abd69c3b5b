/* The JSON Schema of requests for rays, from the rows of rays/fields.h, and of their answer. One thread a document. */
#ifndef KD_RENDER_RAYS_SCHEMA_H
#define KD_RENDER_RAYS_SCHEMA_H

#include "base/schema.h"

#include <stddef.h>

/* A request as JSON: the member `name`. */
void kd_rays_request_schema(struct kd_json *json, const char *name);
/* A field that stands by itself, as beside an array of rays: the member "schema". NULL behind the last; else its
 * name, and *help. */
const char *kd_rays_field_name(size_t index, const char **help);
void kd_rays_field_schema(struct kd_json *json, size_t index);

/* The components of an answer as JSON (rays/answer.h), which is the one named RaysAnswer. */
void kd_rays_answer_schemas(struct kd_json *json);

#endif
