/* These are schemas of answers, for openapi.json: objects that have these members and no others, so that a test which holds real answers against them sees what is new and
 * what is gone. */
#ifndef KD_SERVER_OPENAPI_STRICT_H
#define KD_SERVER_OPENAPI_STRICT_H

#include "base/json.h"

#include <stdbool.h>
#include <string.h>

#define KD_SCHEMA_NUMBER "{\"type\":\"number\"}"
#define KD_SCHEMA_NUMBER_OR_NULL "{\"type\":[\"number\",\"null\"]}"
#define KD_SCHEMA_COUNT "{\"type\":\"integer\",\"minimum\":0}"
#define KD_SCHEMA_TRUTH "{\"type\":\"boolean\"}"
#define KD_SCHEMA_TEXT "{\"type\":\"string\"}"
#define KD_SCHEMA_LIST(items) "{\"type\":\"array\",\"items\":" items "}"
#define KD_SCHEMA_VECTOR "{\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{\"type\":\"number\"}}"
#define KD_SCHEMA_REF(name) "{\"$ref\":\"#/components/schemas/" name "\"}"

struct kd_openapi_member {
    const char *name, *schema; /* JSON */
    bool may_lack;
};

/* Writes the component `name`. */
static inline void kd_openapi_strict(struct kd_json *json, const char *name, const struct kd_openapi_member *members, size_t n)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
    for (size_t i = 0; i < n; i++)
        kd_json_raw(json, members[i].name, members[i].schema, strlen(members[i].schema));
    kd_json_end(json);
    kd_json_array(json, "required");
    for (size_t i = 0; i < n; i++)
        if (!members[i].may_lack)
            kd_json_string(json, NULL, members[i].name);
    kd_json_end(json);
    kd_json_end(json);
}

/* The same of a table whose length the compiler knows. */
#define KD_OPENAPI_STRICT(json, name, table) kd_openapi_strict(json, name, table, sizeof(table) / sizeof *(table))

#endif
