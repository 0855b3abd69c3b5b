#include "server/openapi/share.h"

#include "image/text_code.h"
#include "server/openapi/strict.h"

_Static_assert(KD_TEXT_CODE_MOST == 2048, "KD_OPENAPI_CODE says so");

void kd_openapi_share_schemas(struct kd_json *json)
{
    static const struct kd_openapi_member share[] = {
        { "url", "{\"type\":\"string\",\"format\":\"uri-reference\"}", false },
        { "embed", "{\"type\":\"string\",\"format\":\"uri-reference\"}", true },
        { "code", KD_OPENAPI_CODE, false },
        { "other", KD_OPENAPI_CODE, true },
        { "title", KD_SCHEMA_TEXT, false },
        { "about", KD_SCHEMA_TEXT, false },
        { "expires",
          "{\"type\":\"integer\",\"description\":\"Unix time at which the url ends, if the server signed it\"}", true },
    };
    static const struct kd_openapi_member oembed[] = {
        { "version", "{\"const\":\"1.0\"}", false },
        { "type", "{\"const\":\"photo\"}", false },
        { "title", KD_SCHEMA_TEXT, false },
        { "provider_name", KD_SCHEMA_TEXT, false },
        { "provider_url", "{\"type\":\"string\",\"format\":\"uri\"}", false },
        { "url", "{\"type\":\"string\",\"format\":\"uri\"}", false },
        { "width", KD_SCHEMA_COUNT, false },
        { "height", KD_SCHEMA_COUNT, false },
    };
    KD_OPENAPI_STRICT(json, "Share", share);
    KD_OPENAPI_STRICT(json, "OEmbed", oembed);
}
