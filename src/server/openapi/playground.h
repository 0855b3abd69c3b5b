/* Playgrounds in openapi.json. */
#ifndef KD_SERVER_OPENAPI_PLAYGROUND_H
#define KD_SERVER_OPENAPI_PLAYGROUND_H

#include "base/json.h"

/* Writes the schemas that the bodies below refer to. */
void kd_openapi_playground_schemas(struct kd_json *json);
/* Writes the requestBody that creates a playground; if patch is true, the one that changes it. That one has a second
 * media type, `other`. */
void kd_openapi_playground_body(struct kd_json *json, bool patch, const char *other);
void kd_openapi_step_body(struct kd_json *json);

#endif
