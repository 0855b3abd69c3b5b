/* Media types and their schemas in openapi.json. */
#ifndef KD_SERVER_OPENAPI_MEDIA_H
#define KD_SERVER_OPENAPI_MEDIA_H

#include "base/json.h"

#include <stdbool.h>
#include <string.h>

/* Schema of a media type for which the route names no schema. */
static inline const char *kd_openapi_schema_of(const char *type)
{
    if (strstr(type, "json") && !strstr(type, "ndjson"))
        return "{\"type\":\"object\"}";
    bool text = !strncmp(type, "text/", 5) || strstr(type, "ndjson");
    return text ? "{\"type\":\"string\"}" : "{\"type\":\"string\",\"format\":\"binary\"}";
}

/* Writes a member of "content". schema: JSON text; if its size is 0, the default schema of the media type is used. */
static inline void kd_openapi_media(struct kd_json *json, const char *type, const char *schema, size_t size)
{
    const char *plain = kd_openapi_schema_of(type);
    kd_json_object(json, type);
    kd_json_raw(json, "schema", size ? schema : plain, size ? size : strlen(plain));
    kd_json_end(json);
}

/* Writes an operationId that is a valid identifier in most languages, such as "get_sessions_id_frame_png" for GET
 * /v1/sessions/{id}/frame.png. */
static inline void kd_openapi_operation_id(char *out, size_t size, const char *method, const char *path)
{
    size_t n = strlen(strncpy(out, method, size - 1));
    path += !strncmp(path, "/v1/", 4) ? 3 : 0;
    for (const char *p = strcmp(path, "/") ? path : "/page"; *p && n + 1 < size; p++)
        if (*p != '{' && *p != '}')
            out[n++] = (*p >= 'a' && *p <= 'z') || (*p >= '0' && *p <= '9') ? *p : '_';
    out[n] = 0;
}

/* These two functions begin and end a required requestBody. The caller writes its media types between the two calls. */
static inline void kd_openapi_body_begin(struct kd_json *json)
{
    kd_json_object(json, "requestBody");
    kd_json_bool(json, "required", true);
    kd_json_object(json, "content");
}
static inline void kd_openapi_body_end(struct kd_json *json)
{
    kd_json_end(json);
    kd_json_end(json);
}

/* Writes a requestBody with a JSON schema. other: a second media type, or NULL. */
static inline void kd_openapi_body(struct kd_json *json, const char *schema, size_t size, const char *other)
{
    kd_openapi_body_begin(json);
    kd_openapi_media(json, KD_JSON_TYPE, schema, size);
    if (other)
        kd_openapi_media(json, other, "", 0);
    kd_openapi_body_end(json);
}

#endif
