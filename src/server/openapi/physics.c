#include "server/openapi/physics.h"

#include "quantity/quantity.h"
#include "server/openapi/headers.h"
#include "server/openapi/media.h"
#include "server/openapi/problems.h"
#include "server/openapi/strict.h"

#include <stdio.h>
#include <string.h>

#define NUMBERS "[{\"type\":[\"number\",\"null\"]},{\"type\":\"array\",\"items\":{\"type\":[\"number\",\"null\"]}}]"

static void begin_parameter(struct kd_json *json, const char *name, const char *help, const char *unit)
{
    char description[300];
    bool bare = !*unit || !strcmp(unit, "1");
    snprintf(description, sizeof description, "%s%s%s%s", help, bare ? "" : " [", bare ? "" : unit, bare ? "" : "]");
    kd_json_object(json, NULL);
    kd_json_string(json, "name", name);
    kd_json_string(json, "in", "query");
    kd_json_string(json, "description", description);
}

static void add_parameters(struct kd_json *json, const struct kd_quantity *quantity)
{
    kd_json_array(json, "parameters");
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        const struct kd_row *p = &quantity->parameters[i];
        begin_parameter(json, p->name, p->help, p->kind == KD_KIND_WORD ? "" : p->unit);
        kd_row_range_schema(json, "schema", p);
        kd_json_end(json);
    }
    begin_parameter(json, "digits", kd_quantity_digits.help, "");
    kd_row_type(json, "schema", &kd_quantity_digits);
    kd_json_end(json);
    begin_parameter(json, "format", "format of the answer, instead of Accept", "");
    kd_row_type(
        json, "schema",
        &(const struct kd_row) { .kind = KD_KIND_WORD, .words = quantity->sound ? "json|csv|wav" : "json|csv" });
    kd_json_end(json);
    kd_json_end(json);
}

/* Writes the schema of the parameters in an answer. Each is a word or a number; a range is a list of numbers. */
static void add_asked(struct kd_json *json, const struct kd_quantity *quantity)
{
    const char *names[KD_QUANTITY_PARAMETERS];
    kd_schema_begin_strict(json, "parameters");
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        const struct kd_row *p = &quantity->parameters[i];
        names[i] = p->name;
        if (p->kind == KD_KIND_WORD) {
            kd_row_type(json, p->name, p);
            continue;
        }
        kd_json_object(json, p->name);
        kd_json_array(json, "anyOf");
        if (p->words)
            kd_schema_word(json, NULL, p->words);
        kd_schema_text(json, NULL, KD_SCHEMA_NUMBER);
        kd_schema_text(json, NULL, KD_SCHEMA_LIST(KD_SCHEMA_NUMBER));
        kd_json_end(json);
        kd_json_end(json);
    }
    kd_schema_end_strict(json, names, quantity->n_parameters);
}

static void add_values(struct kd_json *json, const struct kd_quantity *quantity)
{
    const char *names[KD_QUANTITY_OUTPUTS];
    kd_schema_begin_strict(json, "values");
    for (size_t i = 0; i < quantity->n_outputs; i++) {
        kd_json_object(json, names[i] = quantity->outputs[i].name);
        kd_schema_text(json, "anyOf", NUMBERS);
        kd_json_string(json, "description", quantity->outputs[i].help);
        kd_json_end(json);
    }
    kd_schema_end_strict(json, names, quantity->n_outputs);
}

/* Writes the units of all numbers, parameters as well as outputs. A parameter and an output may have the same name. */
static void add_units(struct kd_json *json, const struct kd_quantity *quantity)
{
    const char *names[KD_QUANTITY_PARAMETERS + KD_QUANTITY_OUTPUTS];
    size_t n = 0, own;
    kd_schema_begin_strict(json, "units");
    for (size_t i = 0; i < quantity->n_parameters; i++)
        if (quantity->parameters[i].kind != KD_KIND_WORD)
            kd_schema_text(json, names[n++] = quantity->parameters[i].name, KD_SCHEMA_TEXT);
    own = n;
    for (size_t i = 0; i < quantity->n_outputs; i++) {
        bool twice = false;
        for (size_t k = 0; k < own; k++)
            twice |= !strcmp(names[k], quantity->outputs[i].name);
        if (!twice)
            kd_schema_text(json, names[n++] = quantity->outputs[i].name, KD_SCHEMA_TEXT);
    }
    kd_schema_end_strict(json, names, n);
}

static void add_answer(struct kd_json *json, const struct kd_quantity *quantity)
{
    static const char *const needed[] = { "quantity", "parameters", "values", "units", "sources", "approximations" };
    kd_schema_begin_strict(json, "schema");
    kd_json_object(json, "quantity");
    kd_json_string(json, "const", quantity->name);
    kd_json_end(json);
    add_asked(json, quantity);
    /* the order of nesting, if there are several ranges */
    kd_schema_text(json, "ranges", KD_SCHEMA_LIST(KD_SCHEMA_TEXT));
    kd_schema_text(json, "shape", KD_SCHEMA_LIST(KD_SCHEMA_COUNT));
    add_values(json, quantity);
    add_units(json, quantity);
    kd_schema_text(json, "sources", KD_SCHEMA_LIST(KD_SCHEMA_TEXT));
    kd_schema_text(json, "approximations", KD_SCHEMA_LIST(KD_SCHEMA_TEXT));
    kd_schema_end_strict(json, needed, sizeof needed / sizeof *needed);
}

static void add_responses(struct kd_json *json, const struct kd_route *route, const struct kd_quantity *quantity)
{
    kd_json_object(json, "responses");
    kd_json_object(json, "200");
    kd_json_string(json, "description", quantity->summary);
    kd_openapi_headers(json, route, KD_GET, 200);
    kd_json_object(json, "content");
    kd_json_object(json, KD_JSON_TYPE);
    add_answer(json, quantity);
    kd_json_end(json);
    kd_openapi_media(json, KD_CSV_TYPE, "", 0);
    if (quantity->sound)
        kd_openapi_media(json, KD_WAV_TYPE, "", 0);
    kd_json_end(json);
    kd_json_end(json);
    kd_openapi_problems(json, route, KD_GET);
    kd_json_end(json);
}

void kd_openapi_physics_paths(struct kd_json *json, const struct kd_route *route)
{
    for (size_t i = 0; i < kd_quantity_count; i++) {
        char path[80];
        snprintf(path, sizeof path, "/v1/physics/%s", kd_quantities[i]->name);
        kd_json_object(json, path);
        char id[80];
        kd_openapi_operation_id(id, sizeof id, "get", path);
        kd_json_object(json, "get");
        kd_json_string(json, "operationId", id);
        kd_json_string(json, "summary", kd_quantities[i]->summary);
        add_parameters(json, kd_quantities[i]);
        add_responses(json, route, kd_quantities[i]);
        kd_json_end(json);
        kd_json_end(json);
    }
}
