#include "server/openapi/assets.h"

#include "server/asset/store.h"
#include "server/http/route.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"

#define HASH \
    "{\"type\":\"string\",\"pattern\":\"^[0-9a-f]{64}$\",\"description\":\"SHA-256 of the bytes; the name of the " \
    "asset in a scene\"}"

static const char *type(size_t i)
{
    static const char *const types[] = { KD_PNG_TYPE, KD_NPZ_TYPE, KD_UVFITS_TYPE, KD_CSV_TYPE };
    return i < sizeof types / sizeof *types ? types[i] : NULL;
}

/* Writes the schema Asset. Pictures have members for size and depth, grids of matter for nodes and the parameters of
 * the hole, observations for visibilities and stations. The token is sent only to the client that first uploaded the
 * asset. */
void kd_openapi_asset_schema(struct kd_json *json)
{
    static const struct kd_openapi_member asset[] = {
        { "sha256", HASH },
        { "token", "{\"type\":\"string\",\"description\":\"token that deletes the asset\"}", true },
        { "type", NULL, false, type },
        { "width", KD_SCHEMA_COUNT, true },
        { "height", KD_SCHEMA_COUNT, true },
        { "bit_depth", KD_SCHEMA_COUNT, true },
        { "channels", KD_SCHEMA_COUNT, true },
        { "bytes", KD_SCHEMA_COUNT },
        { "created", "{\"type\":\"number\",\"description\":\"seconds since 1970\"}" },
        { "nodes",
          "{\"type\":\"array\",\"items\":" KD_SCHEMA_COUNT
          ",\"minItems\":3,\"maxItems\":3,\"description\":\"numbers of nodes in r, theta and phi\"}",
          true },
        { "frames", "{\"type\":\"integer\",\"minimum\":2,\"description\":\"frames in time, of a series of grids\"}",
          true },
        { "times",
          "{\"type\":\"array\",\"items\":{\"type\":\"number\"},\"minItems\":2,\"maxItems\":2,\"description\":\"times "
          "of the first and the last frame, in M\"}",
          true },
        { "spin", "{\"type\":\"number\",\"description\":\"spin of the hole that the grid is for\"}", true },
#define MORE(x, name, member, least, most, shown, unit, ...) \
    { #name, "{\"type\":\"number\",\"description\":\"" #name " of the hole that the grid is for, in " unit "\"}", \
      true },
        KD_HOLE_MORE(MORE, )
#undef MORE
            { "visibilities", KD_SCHEMA_COUNT, true },
        { "stations", KD_SCHEMA_COUNT, true },
    };
    static const struct kd_openapi_member limits[] = {
        { "assets", KD_SCHEMA_COUNT },
        { "bytes", KD_SCHEMA_COUNT },
        { "asset_bytes", KD_SCHEMA_COUNT },
        { "asset_pixels", KD_SCHEMA_COUNT },
    };
    static const struct kd_openapi_member assets[] = {
        { "assets", KD_SCHEMA_COUNT },
        { "bytes", KD_SCHEMA_COUNT },
        { "limits", KD_SCHEMA_REF("AssetLimits") },
        { "sky",
          "{\"type\":[\"string\",\"null\"],\"pattern\":\"^[0-9a-f]{64}$\","
          "\"description\":\"SHA-256 of the operator's photograph of the sky, for sky.image; null: there is none\"}" },
        { "types", KD_SCHEMA_LIST(KD_SCHEMA_TEXT) },
    };
    KD_OPENAPI_STRICT(json, "Asset", asset);
    KD_OPENAPI_STRICT(json, "AssetLimits", limits);
    KD_OPENAPI_STRICT(json, "Assets", assets);
}
