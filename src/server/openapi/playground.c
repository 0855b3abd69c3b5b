#include "server/openapi/playground.h"

#include "playground/preset.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"
#include "server/playground/sessions.h"

#include <string.h>

/* Each member of the schemas below is described in docs/playground.md. */
#define UNITS \
    "lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second of " \
    "real time"
#define BODIES(schema) "{\"type\":\"array\",\"maxItems\":4096,\"items\":{\"$ref\":\"#/components/schemas/" schema "\"}}"

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

static void add_raw(struct kd_json *json, const char *name, const char *schema)
{
    kd_json_raw(json, name, schema, strlen(schema));
}

/* Writes the schema of a body. id: true if the body already exists and therefore has an id. */
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
    kd_document_properties(json, &kd_playground_body_fields);
    add_vector(json, "position", 1e6, "x, y, z in M; the hole is at the origin, its axis along z");
    add_vector(json, "velocity", 1, "velocity in c; the speed must be at most 1");
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
    kd_json_string(json, "description", "pace in M per second of real time; a preset has its own default");
    kd_json_end(json);
    add_raw(json, "paused", "{\"type\":\"boolean\",\"default\":false}");
    add_raw(json, "scene", KD_SCHEMA_REF("Scene")); /* merge patch for the scene of the playground's pictures */
    kd_document_properties(json, &kd_playground_settings);
    if (patch) {
        add_raw(json, "add", BODIES("PlaygroundBody"));
        add_raw(json, "change", BODIES("PlaygroundBodyChange"));
        add_raw(json, "remove",
                "{\"type\":\"array\",\"maxItems\":4096,\"items\":{\"type\":\"integer\",\"minimum\":1,"
                "\"maximum\":4294967295}}");
        return;
    }
    add_preset(json);
    add_raw(json, "bodies", BODIES("PlaygroundBody"));
    add_raw(json, "state",
            "{\"type\":\"object\",\"additionalProperties\":true,\"description\":\"further state of a snapshot, on "
            "which the motion depends. Return it unchanged; its form depends on the version\"}");
}

static void add_document(struct kd_json *json, const char *name, bool patch)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
    add_properties(json, patch);
    kd_json_end(json);
    if (!patch)
        add_raw(json, "dependentSchemas",
                "{\"state\":{\"required\":[\"bodies\"],\"not\":{\"required\":[\"preset\"]}}}");
    kd_json_end(json);
}

static const char *const kinds[] = { [KD_KIND_REAL] = KD_SCHEMA_NUMBER,
                                     [KD_KIND_INT] = KD_SCHEMA_COUNT,
                                     [KD_KIND_BOOL] = KD_SCHEMA_BOOL,
                                     [KD_KIND_WORD] = KD_SCHEMA_TEXT };

/* Appends a member for each row of a table. */
static size_t add_members(struct kd_openapi_member *to, size_t n, const struct kd_document *document)
{
    for (size_t i = 0; i < document->n; i++)
        to[n++] = (struct kd_openapi_member) { document->rows[i].name, kinds[document->rows[i].kind], false };
    return n;
}

/* Writes the schema of a body's state. Mergers and escapes may lead to values beyond the limits of a request. */
static void add_body_state(struct kd_json *json)
{
    struct kd_openapi_member members[16] = { { "id", "{\"type\":\"integer\",\"minimum\":1}", false },
                                             { "name", KD_SCHEMA_TEXT, false },
                                             { "position", KD_SCHEMA_VECTOR, false },
                                             { "velocity", KD_SCHEMA_VECTOR, false } };
    kd_schema_told(json, "PlaygroundBodyState", UNITS, members, add_members(members, 4, &kd_playground_body_fields));
}

static void add_settings_state(struct kd_json *json)
{
    struct kd_openapi_member members[40];
    kd_openapi_strict(json, "PlaygroundSettings", members, add_members(members, 0, &kd_playground_settings));
}

static void add_state(struct kd_json *json)
{
    static const struct kd_openapi_member totals[] = {
        { "mass", KD_SCHEMA_NUMBER, false },
        { "energy", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "momentum", KD_SCHEMA_VECTOR, false },
        { "angular_momentum", KD_SCHEMA_VECTOR, false },
        { "separation", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "wave_frequency", KD_SCHEMA_NUMBER_OR_NULL, false },
    };
    static const struct kd_openapi_member spent[] = {
        { "captured_mass", KD_SCHEMA_NUMBER, false },
        { "captured_energy", KD_SCHEMA_NUMBER, false },
        { "captured_angular_momentum", KD_SCHEMA_VECTOR, false },
        { "merged_energy", KD_SCHEMA_NUMBER, false },
        { "capped_energy", KD_SCHEMA_NUMBER, false },
        { "capped_momentum", KD_SCHEMA_VECTOR, false },
        { "radiated_energy", KD_SCHEMA_NUMBER, false },
        { "torn_mass", KD_SCHEMA_NUMBER, false },
        { "torn_energy", KD_SCHEMA_NUMBER, false },
    };
    static const struct kd_openapi_member source[] = {
        { "number", KD_SCHEMA_COUNT, false },
        { "name", KD_SCHEMA_TEXT, false },
        { "t", KD_SCHEMA_NUMBER, false },
        { "piece_mass", KD_SCHEMA_NUMBER, false },
        { "energy_spread", KD_SCHEMA_NUMBER, false },
        { "pieces", KD_SCHEMA_COUNT, false },
        { "back", KD_SCHEMA_COUNT, false },
        { "captured", KD_SCHEMA_COUNT, false },
        { "lost", KD_SCHEMA_COUNT, false },
    };
    static const struct kd_openapi_member debris[] = {
        { "t", KD_SCHEMA_NUMBER, false },
        { "pieces", KD_SCHEMA_COUNT, false },
        { "sources", KD_SCHEMA_LIST(KD_SCHEMA_REF("PlaygroundSource")), false },
    };
    static const struct kd_openapi_member state[] = {
        { "id", KD_SCHEMA_TEXT, false },
        { "token", KD_SCHEMA_TEXT, true },
        { "rate", KD_SCHEMA_NUMBER, false },
        { "rate_reached", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "paused", KD_SCHEMA_BOOL, false },
        { "slowed", KD_SCHEMA_BOOL, false },
        { "resting", KD_SCHEMA_BOOL, false },
        { "watchers", KD_SCHEMA_COUNT, false },
        { "generation", KD_SCHEMA_COUNT, false },
        { "asked", KD_SCHEMA_NUMBER, true },
        { "done", KD_SCHEMA_NUMBER, true },
        { "added", KD_SCHEMA_LIST(KD_SCHEMA_COUNT), true },
        { "t", KD_SCHEMA_NUMBER, false },
        { "steps", KD_SCHEMA_COUNT, false },
        { "settings", KD_SCHEMA_REF("PlaygroundSettings"), false },
        { "bodies", BODIES("PlaygroundBodyState"), false },
        { "totals", KD_SCHEMA_REF("PlaygroundTotals"), false },
        { "spent", KD_SCHEMA_REF("PlaygroundSpent"), false },
        { "debris", KD_SCHEMA_REF("PlaygroundDebris"), false },
        { "events", KD_SCHEMA_COUNT, false },
        { "approximations", KD_SCHEMA_LIST(KD_SCHEMA_TEXT), false },
        { "scene", KD_SCHEMA_REF("Scene"), false },
    };
    KD_OPENAPI_TOLD(json, "PlaygroundTotals", UNITS, totals);
    KD_OPENAPI_TOLD(json, "PlaygroundSpent", UNITS, spent);
    KD_OPENAPI_TOLD(json, "PlaygroundSource", UNITS, source);
    KD_OPENAPI_TOLD(json, "PlaygroundDebris", UNITS, debris);
    KD_OPENAPI_TOLD(json, "PlaygroundStatus", UNITS, state);
}

static void add_catalogue(struct kd_json *json)
{
    static const struct kd_openapi_member preset[] = {
        { "name", KD_SCHEMA_TEXT, false },    { "title", KD_SCHEMA_TEXT, false },
        { "rate", KD_SCHEMA_NUMBER, false },  { "centre", KD_SCHEMA_VECTOR, false },
        { "reach", KD_SCHEMA_NUMBER, false },
    };
    static const struct kd_openapi_member row[] = {
        { "name", KD_SCHEMA_TEXT, false },
        { "type", "{\"enum\":[\"number\",\"integer\",\"boolean\",\"string\"]}", false },
        { "default", "{\"type\":[\"number\",\"boolean\",\"string\"]}", false },
        { "least", KD_SCHEMA_NUMBER, true },
        { "most", KD_SCHEMA_NUMBER, true },
        { "words", KD_SCHEMA_LIST(KD_SCHEMA_TEXT), true },
        { "fixed", KD_SCHEMA_BOOL, true },
        { "help", KD_SCHEMA_TEXT, false },
    };
    static const struct kd_openapi_member catalogue[] = {
        { "presets", KD_SCHEMA_LIST(KD_SCHEMA_REF("PlaygroundPresetTold")), false },
        { "settings", KD_SCHEMA_LIST(KD_SCHEMA_REF("PlaygroundRow")), false },
        { "pace", KD_SCHEMA_LIST(KD_SCHEMA_REF("PlaygroundRow")), false },
        { "body", KD_SCHEMA_LIST(KD_SCHEMA_REF("PlaygroundRow")), false },
    };
    KD_OPENAPI_STRICT(json, "PlaygroundPresetTold", preset);
    KD_OPENAPI_STRICT(json, "PlaygroundRow", row);
    KD_OPENAPI_STRICT(json, "PlaygroundCatalogue", catalogue);
}

static void add_series(struct kd_json *json)
{
    static const struct kd_openapi_member series[] = { { "columns", KD_SCHEMA_REF("PlaygroundColumns"), false } };
    struct kd_openapi_member columns[KD_SERIES_N];
    for (int i = 0; i < KD_SERIES_N; i++)
        columns[i] =
            (struct kd_openapi_member) { kd_series_column(i), KD_SCHEMA_LIST(KD_SCHEMA_NUMBER_OR_NULL), false };
    kd_schema_told(json, "PlaygroundColumns", UNITS, columns, KD_SERIES_N);
    KD_OPENAPI_STRICT(json, "PlaygroundSeries", series);
}

/* Writes the schema of the data in the event stream, because OpenAPI cannot attach a schema to the stream itself. */
static void add_happened(struct kd_json *json)
{
    static const struct kd_openapi_member happened[] = {
        { "number", KD_SCHEMA_COUNT, false },
        { "t", KD_SCHEMA_NUMBER, false },
        { "kind", "{\"enum\":[\"merger\",\"shedding\",\"disruption\",\"capture\",\"inspiral\",\"escape\"]}", false },
        { "body", KD_SCHEMA_COUNT, false },
        { "name", KD_SCHEMA_TEXT, false },
        { "mass", KD_SCHEMA_NUMBER, false },
        { "other", KD_SCHEMA_COUNT, true },
        { "other_name", KD_SCHEMA_TEXT, true },
        { "other_mass", KD_SCHEMA_NUMBER, true },
        { "mass_left", KD_SCHEMA_NUMBER, true },
        { "r", KD_SCHEMA_NUMBER, false },
        { "energy", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "tidal_radius", KD_SCHEMA_NUMBER, true },
        { "energy_spread", KD_SCHEMA_NUMBER, true },
    };
    KD_OPENAPI_TOLD(json, "PlaygroundHappened", UNITS, happened);
}

static void add_tick(struct kd_json *json)
{
    struct kd_openapi_member members[12 + KD_SERIES_N] = {
        { "generation", KD_SCHEMA_COUNT, false },
        { "rate", KD_SCHEMA_NUMBER, false },
        { "rate_reached", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "paused", KD_SCHEMA_BOOL, false },
        { "slowed", KD_SCHEMA_BOOL, false },
        { "resting", KD_SCHEMA_BOOL, false },
        { "watchers", KD_SCHEMA_COUNT, false },
        { "debris_lost", KD_SCHEMA_COUNT, false },
        { "fallback_rate", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "event", KD_SCHEMA_COUNT, false },
        { "angular_momentum", KD_SCHEMA_VECTOR, false },
    };
    size_t n = 11;
    for (int i = 0; i < KD_SERIES_N; i++)
        if (i < KD_SERIES_angular_momentum_x || i > KD_SERIES_angular_momentum_z)
            members[n++] = (struct kd_openapi_member) { kd_series_column(i), KD_SCHEMA_NUMBER_OR_NULL, false };
    kd_schema_told(json, "PlaygroundTick", UNITS, members, n);
}

void kd_openapi_playground_schemas(struct kd_json *json)
{
    _Static_assert(KD_PLAYGROUND_BODIES_MAX == 4096 && KD_PLAYGROUND_NAME == 32,
                   "BODIES and the length of a name say so");
    add_body(json, "PlaygroundBody", false);
    add_body(json, "PlaygroundBodyChange", true);
    add_document(json, "Playground", false);
    add_document(json, "PlaygroundChange", true);
    add_settings_state(json);
    add_body_state(json);
    add_state(json);
    add_catalogue(json);
    add_series(json);
    add_happened(json);
    add_tick(json);
}

const char kd_openapi_step_schema[] =
    "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"by\"],\"properties\":{\"by\":{\"type\":"
    "\"number\","
    "\"exclusiveMinimum\":0,\"maximum\":" KD_SCHEMA_DIGITS(KD_PLAYGROUND_TIME) ",\"description\":\"M\"}}}";
