#include "server/openapi/playground.h"

#include "playground/preset.h"
#include "server/openapi/media.h"
#include "server/playground/plays.h"

#include <string.h>

#define BODIES(schema) "{\"type\":\"array\",\"maxItems\":4096,\"items\":{\"$ref\":\"#/components/schemas/" schema "\"}}"

static void add_words(struct kd_json *json, const char *words)
{
    char word[40];
    kd_json_array(json, "enum");
    for (int i = 0; kd_playground_word(words, i, word, sizeof word); i++)
        kd_json_string(json, NULL, word);
    kd_json_end(json);
}

static void add_row(struct kd_json *json, const struct kd_playground_setting *row)
{
    static const char *const types[] = { [KD_SETTING_REAL] = "number", [KD_SETTING_WHOLE] = "integer", [KD_SETTING_TRUTH] = "boolean", [KD_SETTING_WORD] = "string" };
    kd_json_object(json, row->name);
    kd_json_string(json, "type", types[row->kind]);
    if (row->kind == KD_SETTING_WORD)
        add_words(json, row->words);
    if (row->kind == KD_SETTING_REAL || row->kind == KD_SETTING_WHOLE) {
        kd_json_number(json, "minimum", row->least);
        kd_json_number(json, "maximum", row->most);
    }
    kd_json_string(json, "description", row->help);
    kd_json_end(json);
}

static void add_vector(struct kd_json *json, const char *name, double most, const char *help)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", 3);
    kd_json_number(json, "maxItems", 3);
    kd_json_object(json, "items");
    kd_json_string(json, "type", "number");
    kd_json_number(json, "minimum", -most);
    kd_json_number(json, "maximum", most);
    kd_json_end(json);
    kd_json_string(json, "description", help);
    kd_json_end(json);
}

static void add_raw(struct kd_json *json, const char *name, const char *schema) { kd_json_raw(json, name, schema, strlen(schema)); }

/* A body; id: one that is there already, which says which. */
static void add_body(struct kd_json *json, const char *name, bool id)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    add_raw(json, "required", id ? "[\"id\"]" : "[\"position\"]");
    kd_json_object(json, "properties");
    if (id)
        add_raw(json, "id", "{\"type\":\"integer\",\"minimum\":1,\"maximum\":4294967295}");
    add_raw(json, "name", "{\"type\":\"string\",\"maxLength\":31}");
    for (size_t i = 0; i < kd_playground_n_body_fields; i++)
        add_row(json, &kd_playground_body_fields[i]);
    add_vector(json, "position", 1e6, "x, y, z in M; the hole is at the origin, its axis along z");
    add_vector(json, "velocity", 1, "in c, and in all no faster");
    kd_json_end(json);
    kd_json_end(json);
}

static void add_preset(struct kd_json *json)
{
    kd_json_object(json, "preset");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    for (size_t i = 0; i < kd_playground_n_presets; i++)
        kd_json_string(json, NULL, kd_playground_presets[i].name);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_properties(struct kd_json *json, bool patch)
{
    kd_json_object(json, "rate");
    kd_json_string(json, "type", "number");
    kd_json_number(json, "minimum", 0);
    kd_json_number(json, "maximum", KD_PLAY_RATE_MAX);
    kd_json_string(json, "description", "M a second of the clock; a preset has one of its own");
    kd_json_end(json);
    add_raw(json, "paused", "{\"type\":\"boolean\",\"default\":false}");
    add_raw(json, "scene", "{\"type\":\"object\",\"description\":\"merge patch of the scene of its pictures\"}");
    for (size_t i = 0; i < kd_playground_n_settings; i++)
        add_row(json, &kd_playground_settings[i]);
    if (patch) {
        add_raw(json, "add", BODIES("PlaygroundBody"));
        add_raw(json, "change", BODIES("PlaygroundBodyChange"));
        add_raw(json, "remove", "{\"type\":\"array\",\"items\":{\"type\":\"integer\",\"minimum\":1}}");
        return;
    }
    add_preset(json);
    add_raw(json, "bodies", BODIES("PlaygroundBody"));
    add_raw(json, "state", "{\"type\":\"object\",\"description\":\"of a snapshot: all that the motion depends on besides\"}");
}

static void add_document(struct kd_json *json, const char *name, bool patch)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
    add_properties(json, patch);
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_playground_schemas(struct kd_json *json)
{
    _Static_assert(KD_PLAYGROUND_BODIES_MAX == 4096, "BODIES says so");
    add_body(json, "PlaygroundBody", false);
    add_body(json, "PlaygroundBodyChange", true);
    add_document(json, "Playground", false);
    add_document(json, "PlaygroundChange", true);
}

void kd_openapi_playground_body(struct kd_json *json, bool patch, const char *other)
{
    static const char made[] = "{\"$ref\":\"#/components/schemas/Playground\"}", changed[] = "{\"$ref\":\"#/components/schemas/PlaygroundChange\"}";
    kd_openapi_body_begin(json);
    kd_openapi_media(json, "application/json", patch ? changed : made, patch ? sizeof changed - 1 : sizeof made - 1);
    if (patch)
        kd_openapi_media(json, other, changed, sizeof changed - 1);
    kd_openapi_body_end(json);
}

void kd_openapi_step_body(struct kd_json *json)
{
    static const char schema[] = "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"by\"],\"properties\":{\"by\":{\"type\":\"number\","
                                 "\"exclusiveMinimum\":0,\"maximum\":1e18,\"description\":\"M\"}}}";
    kd_openapi_body(json, schema, sizeof schema - 1, NULL);
}
