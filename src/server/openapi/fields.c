#include "server/openapi/fields.h"

#include "base/buffer.h"
#include "scene/scene.h"
#include "server/http/route.h"

#include <string.h>

/* A function that writes the description of one field of openapi.json. path: path of the field. */
typedef void writer(struct kd_json *json, const char *path, const cJSON *property);

static void each(struct kd_json *json, const cJSON *schema, const char *prefix, writer *write);

/* Visits the elements of a list, by index. */
static void each_element(struct kd_json *json, const cJSON *list, const char *prefix, writer *write)
{
    const cJSON *most = cJSON_GetObjectItemCaseSensitive(list, "maxItems");
    for (int i = 0; i < (int)cJSON_GetNumberValue(most); i++) {
        struct kd_buffer name = { 0 };
        if (kd_buffer_printf(&name, "%s.%d", prefix, i))
            json->status = KD_ENOMEM;
        else
            each(json, cJSON_GetObjectItemCaseSensitive(list, "items"), (const char *)name.data, write);
        kd_buffer_finish(&name);
    }
}

static void one(struct kd_json *json, const cJSON *property, const char *name, writer *write)
{
    if (cJSON_GetObjectItemCaseSensitive(property, "deprecated"))
        return;
    if (cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(property, "items"), "properties"))
        each_element(json, property, name, write);
    else if (cJSON_GetObjectItemCaseSensitive(property, "properties"))
        each(json, property, name, write);
    else
        write(json, name, property);
}

static void each(struct kd_json *json, const cJSON *schema, const char *prefix, writer *write)
{
    const cJSON *property;
    cJSON_ArrayForEach(property, cJSON_GetObjectItemCaseSensitive(schema, "properties"))
    {
        struct kd_buffer name = { 0 };
        if (kd_buffer_printf(&name, "%s%s%s", prefix, *prefix ? "." : "", property->string))
            json->status = KD_ENOMEM;
        else
            one(json, property, (const char *)name.data, write);
        kd_buffer_finish(&name);
    }
}

static void add_parameter(struct kd_json *json, const char *path, const cJSON *property)
{
    char *text = cJSON_PrintUnformatted(property);
    const char *type = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(property, "type"));
    kd_json_object(json, NULL);
    kd_json_string(json, "name", path);
    kd_json_string(json, "in", "query");
    if (type && !strcmp(type, "array")) { /* the list is one text, with commas between its items */
        kd_json_string(json, "style", "form");
        kd_json_bool(json, "explode", false);
    }
    kd_json_raw(json, "schema", text ? text : "", text ? strlen(text) : 0);
    kd_json_end(json);
    if (!text)
        json->status = KD_ENOMEM;
    cJSON_free(text);
}

static void add_path(struct kd_json *json, const char *path, const cJSON *property)
{
    (void)property;
    kd_json_string(json, NULL, path);
}

void kd_openapi_field_parameters(struct kd_json *json, const cJSON *schema) { each(json, schema, "", add_parameter); }

void kd_openapi_field_paths(struct kd_json *json, const cJSON *schema)
{
    kd_json_object(json, "FieldPath");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    each(json, schema, "", add_path);
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_preset_schema(struct kd_json *json)
{
    kd_json_object(json, "schema");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    for (size_t i = 0; i < kd_scene_preset_count(); i++)
        kd_json_string(json, NULL, kd_scene_preset_name(i));
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_preset_parameter(struct kd_json *json, unsigned method, const cJSON *schema)
{
    (void)method, (void)schema;
    kd_json_object(json, NULL);
    kd_json_string(json, "name", "preset");
    kd_json_string(json, "in", "query");
    kd_openapi_preset_schema(json);
    kd_json_end(json);
}

void kd_openapi_scene_parameters(struct kd_json *json, unsigned method, const cJSON *schema)
{
    kd_openapi_preset_parameter(json, method, schema);
    if (method != KD_POST)
        kd_openapi_field_parameters(json, schema);
}
