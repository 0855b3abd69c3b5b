#include "server/openapi/physics.h"

#include "quantity/quantity.h"
#include "server/openapi/headers.h"
#include "server/openapi/media.h"
#include "server/openapi/problems.h"
#include "server/openapi/strict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NUMBERS "[{\"type\":[\"number\",\"null\"]},{\"type\":\"array\",\"items\":{\"type\":[\"number\",\"null\"]}}]"

#define DIGITS "{\"type\":\"integer\",\"minimum\":1,\"maximum\":17}" /* the maximum is KD_DECIMAL_DIGITS */
#define RANGE "^" KD_OPENAPI_DECIMAL ":" KD_OPENAPI_DECIMAL ":([2-9]|[1-9][0-9]{1,4}|100000)$"

static void add_words(struct kd_json *json, const char *text)
{
    char word[KD_WORD_TEXT];
    kd_json_array(json, "enum");
    while (*text) {
        text = kd_parameter_word(text, word);
        kd_json_string(json, NULL, word);
    }
    kd_json_end(json);
}

static void add_number(struct kd_json *json, const struct kd_parameter *p)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "type", p->whole ? "integer" : "number");
    kd_json_number(json, p->open ? "exclusiveMinimum" : "minimum", p->minimum);
    kd_json_number(json, p->open ? "exclusiveMaximum" : "maximum", p->maximum);
    kd_json_end(json);
}

/* Writes the schema of a parameter: a number, a range as text, or a word. */
static void add_schema(struct kd_json *json, const struct kd_parameter *p)
{
    kd_json_object(json, "schema");
    if (p->words) {
        add_words(json, p->words);
    } else {
        kd_json_array(json, "anyOf");
        /* The word comes first, because generators of clients take the first type that fits the default, and "infinity"
         * parses as a number. */
        if (p->word)
            kd_schema_word(json, NULL, p->word);
        add_number(json, p);
        kd_json_object(json, NULL);
        kd_json_string(json, "type", "string");
        kd_json_string(json, "pattern", RANGE);
        kd_json_end(json);
        kd_json_end(json);
    }
    char *end;
    double number = strtod(p->initial, &end);
    if (*end || p->words || !isfinite(number)) /* "infinity" is a word of this schema */
        kd_json_string(json, "default", p->initial);
    else
        kd_json_number(json, "default", number);
    kd_json_end(json);
}

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
        const struct kd_parameter *p = &quantity->parameters[i];
        begin_parameter(json, p->name, p->help, p->words ? "" : p->unit);
        add_schema(json, p);
        kd_json_end(json);
    }
    begin_parameter(json, "digits", "significant digits of numbers in lists, and of all numbers in CSV; 17: all", "");
    kd_json_raw(json, "schema", DIGITS, strlen(DIGITS));
    kd_json_end(json);
    begin_parameter(json, "format", "format of the answer, instead of Accept", "");
    kd_json_object(json, "schema");
    add_words(json, quantity->sound ? "json|csv|wav" : "json|csv");
    kd_json_end(json);
    kd_json_end(json);
    kd_json_end(json);
}

/* Writes the parameters in an answer: a word, or a number, or for a range a list of numbers. */
static void add_asked(struct kd_json *json, const struct kd_quantity *quantity)
{
    const char *names[KD_QUANTITY_PARAMETERS];
    kd_schema_begin_strict(json, "parameters");
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        const struct kd_parameter *p = &quantity->parameters[i];
        kd_json_object(json, names[i] = p->name);
        if (p->words) {
            add_words(json, p->words);
        } else {
            kd_json_array(json, "anyOf");
            if (p->word)
                kd_schema_word(json, NULL, p->word);
            kd_schema_text(json, NULL, KD_SCHEMA_NUMBER);
            kd_schema_text(json, NULL, KD_SCHEMA_LIST(KD_SCHEMA_NUMBER));
            kd_json_end(json);
        }
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

/* Writes the units of all numbers. A parameter and an output may have the same name. */
static void add_units(struct kd_json *json, const struct kd_quantity *quantity)
{
    const char *names[KD_QUANTITY_PARAMETERS + KD_QUANTITY_OUTPUTS];
    size_t n = 0, own;
    kd_schema_begin_strict(json, "units");
    for (size_t i = 0; i < quantity->n_parameters; i++)
        if (!quantity->parameters[i].words)
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
    kd_schema_text(json, "ranges", KD_SCHEMA_LIST(KD_SCHEMA_TEXT)); /* the order in which several ranges are nested */
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
    kd_json_object(json, "application/json");
    add_answer(json, quantity);
    kd_json_end(json);
    kd_openapi_media(json, "text/csv", "", 0);
    if (quantity->sound)
        kd_openapi_media(json, "audio/wav", "", 0);
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
