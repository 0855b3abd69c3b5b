#include "server/openapi/assets.h"

#include "server/asset/store.h"
#include "server/http/route.h"
#include "server/openapi/media.h"

#define WHOLE "{\"type\":\"integer\",\"minimum\":0}"

static const char asset[] =
    "{\"type\":\"object\",\"required\":[\"sha256\",\"type\",\"bytes\"],\"properties\":{"
    "\"sha256\":{\"type\":\"string\",\"pattern\":\"^[0-9a-f]{64}$\",\"description\":\"of the bytes; what a scene names\"},"
    "\"token\":{\"type\":\"string\",\"description\":\"deletes it; for who has put it there first alone\"},"
    "\"type\":{\"type\":\"string\"},\"width\":" WHOLE ",\"height\":" WHOLE ",\"bit_depth\":" WHOLE ",\"channels\":" WHOLE ",\"bytes\":" WHOLE ","
    "\"nodes\":{\"type\":\"array\",\"items\":" WHOLE ",\"minItems\":3,\"maxItems\":3,\"description\":\"of a grid of matter, in r, theta and phi\"},"
    "\"spin\":{\"type\":\"number\",\"description\":\"of the hole that the grid is made for\"},"
    "\"created\":{\"type\":\"number\",\"description\":\"seconds since 1970\"}}}";

static const char reference[] = "{\"$ref\":\"#/components/schemas/Asset\"}";

static const char assets[] =
    "{\"type\":\"object\",\"title\":\"Assets\",\"required\":[\"assets\",\"bytes\",\"limits\",\"types\"],\"properties\":{"
    "\"assets\":" WHOLE ",\"bytes\":" WHOLE ",\"types\":{\"type\":\"array\",\"items\":{\"type\":\"string\"}},"
    "\"limits\":{\"type\":\"object\",\"properties\":{\"assets\":" WHOLE ",\"bytes\":" WHOLE ",\"asset_bytes\":" WHOLE ",\"asset_pixels\":" WHOLE "}}}}";

void kd_openapi_asset_schema(struct kd_json *json) { kd_json_raw(json, "Asset", asset, sizeof asset - 1); }

void kd_openapi_asset_body(struct kd_json *json)
{
    kd_json_object(json, "requestBody");
    kd_json_bool(json, "required", true);
    kd_json_object(json, "content");
    kd_openapi_media(json, KD_ASSET_TYPE, "", 0);
    kd_openapi_media(json, KD_ASSET_GRID_TYPE, "", 0);
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_asset_answer(struct kd_json *json, unsigned method)
{
    if (method == KD_PUT)
        kd_openapi_media(json, "application/json", reference, sizeof reference - 1);
    else
        kd_openapi_media(json, "application/json", assets, sizeof assets - 1);
}
