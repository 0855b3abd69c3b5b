/* Playgrounds in openapi.json. */
#ifndef KD_SERVER_OPENAPI_PLAYGROUND_H
#define KD_SERVER_OPENAPI_PLAYGROUND_H

#include "base/json.h"

/* Writes the schemas that bodies and answers refer to. */
void kd_openapi_playground_schemas(struct kd_json *json);
extern const char kd_openapi_step_schema[]; /* schema of the body of .../step */

#endif
