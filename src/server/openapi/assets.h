/* /v1/assets in openapi.json. */
#ifndef KD_SERVER_OPENAPI_ASSETS_H
#define KD_SERVER_OPENAPI_ASSETS_H

#include "base/json.h"

/* Writes Asset, a member of components.schemas. */
void kd_openapi_asset_schema(struct kd_json *json);

#endif
