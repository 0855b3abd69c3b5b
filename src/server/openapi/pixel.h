/* This is what openapi.json says of a pixel that is explained, and of the stars of a picture. */
#ifndef KD_SERVER_OPENAPI_PIXEL_H
#define KD_SERVER_OPENAPI_PIXEL_H

#include "base/json.h"

void kd_openapi_pixel_schemas(struct kd_json *json);

#endif
