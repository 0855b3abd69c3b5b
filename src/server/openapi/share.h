/* Answers of /v1/share and /oembed in openapi.json. */
#ifndef KD_SERVER_OPENAPI_SHARE_H
#define KD_SERVER_OPENAPI_SHARE_H

#include "base/json.h"

/* Schema of the code of a shared scene. */
#define KD_OPENAPI_CODE "{\"type\":\"string\",\"pattern\":\"^[-0-9A-Z_a-z]{1,2048}$\"}"

void kd_openapi_share_schemas(struct kd_json *json);

#endif
