/* /v1/assets in openapi.json. */
#ifndef KD_SERVER_OPENAPI_ASSETS_H
#define KD_SERVER_OPENAPI_ASSETS_H

#include "base/json.h"

/* Writes Asset, a member of components.schemas. */
void kd_openapi_asset_schema(struct kd_json *json);
void kd_openapi_asset_body(struct kd_json *json);
/* Writes the members of "content". method: KD_GET or KD_PUT. */
void kd_openapi_asset_answer(struct kd_json *json, unsigned method);

#endif
