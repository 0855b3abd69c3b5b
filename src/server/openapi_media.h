/* Media types with the schemas of what they carry, for openapi.json. */
#ifndef KD_SERVER_OPENAPI_MEDIA_H
#define KD_SERVER_OPENAPI_MEDIA_H

#include "base/json.h"

/* A member of a "content": schema is JSON text; size 0: nothing is said of what it carries. */
static inline void kd_openapi_media(struct kd_json *json, const char *type, const char *schema, size_t size)
{
    kd_json_object(json, type);
    if (size)
        kd_json_raw(json, "schema", schema, size);
    kd_json_end(json);
}

/* A requestBody that must be there, as JSON of this schema; other: a second media type, NULL for none. */
static inline void kd_openapi_body(struct kd_json *json, const char *schema, size_t size, const char *other)
{
    kd_json_object(json, "requestBody");
    kd_json_bool(json, "required", true);
    kd_json_object(json, "content");
    kd_openapi_media(json, "application/json", schema, size);
    if (other)
        kd_openapi_media(json, other, "", 0);
    kd_json_end(json);
    kd_json_end(json);
}

#endif
