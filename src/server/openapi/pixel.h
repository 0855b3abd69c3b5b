/* Answers about a pixel and about the stars of a picture in openapi.json. */
#ifndef KD_SERVER_OPENAPI_PIXEL_H
#define KD_SERVER_OPENAPI_PIXEL_H

#include "base/json.h"

void kd_openapi_pixel_schemas(struct kd_json *json);

#endif
