/* This is what openapi.json says of playgrounds. */
#ifndef KD_SERVER_OPENAPI_PLAYGROUND_H
#define KD_SERVER_OPENAPI_PLAYGROUND_H

#include "base/json.h"

/* Schemas that the bodies below refer to. */
void kd_openapi_playground_schemas(struct kd_json *json);
/* The document that makes one, or with `patch` the one that changes it, which may also have the media type `other`. */
void kd_openapi_playground_body(struct kd_json *json, bool patch, const char *other);
void kd_openapi_step_body(struct kd_json *json);

#endif
