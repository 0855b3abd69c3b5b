#include "server/openapi_physics.h"

#include "quantity/quantity.h"

#include <stdio.h>
#include <string.h>

#define NUMBERS "{\"anyOf\":[{\"type\":[\"number\",\"null\"]},{\"type\":\"array\",\"items\":{\"type\":[\"number\",\"null\"]}}]}"

static cJSON *words(const char *text)
{
    cJSON *list = cJSON_CreateArray();
    char word[KD_WORD_TEXT];
    while (*text) {
        text = kd_parameter_word(text, word);
        cJSON_AddItemToArray(list, cJSON_CreateString(word));
    }
    return list;
}

/* A number, a range of them as text, or a word. */
static cJSON *schema_of(const struct kd_parameter *p)
{
    cJSON *o = cJSON_CreateObject();
    if (p->words) {
        cJSON_AddItemToObject(o, "enum", words(p->words));
    } else {
        cJSON *any = cJSON_AddArrayToObject(o, "anyOf"), *number = cJSON_CreateObject(), *range = cJSON_CreateObject();
        cJSON_AddStringToObject(number, "type", p->whole ? "integer" : "number");
        cJSON_AddNumberToObject(number, p->open ? "exclusiveMinimum" : "minimum", p->minimum);
        cJSON_AddNumberToObject(number, p->open ? "exclusiveMaximum" : "maximum", p->maximum);
        cJSON_AddItemToArray(any, number);
        cJSON_AddStringToObject(range, "type", "string");
        cJSON_AddStringToObject(range, "pattern", "^[^:]+:[^:]+:[0-9]+$");
        cJSON_AddItemToArray(any, range);
        if (p->word) {
            cJSON *word = cJSON_CreateObject();
            cJSON_AddStringToObject(word, "const", p->word);
            cJSON_AddItemToArray(any, word);
        }
    }
    cJSON_AddStringToObject(o, "default", p->initial);
    return o;
}

static void add_parameter(cJSON *list, const char *name, const char *help, const char *unit, cJSON *schema)
{
    char description[300];
    bool bare = !*unit || !strcmp(unit, "1");
    snprintf(description, sizeof description, "%s%s%s%s", help, bare ? "" : " [", bare ? "" : unit, bare ? "" : "]");
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "name", name);
    cJSON_AddStringToObject(o, "in", "query");
    cJSON_AddStringToObject(o, "description", description);
    cJSON_AddItemToObject(o, "schema", schema);
    cJSON_AddItemToArray(list, o);
}

static cJSON *answer_of(const struct kd_quantity *quantity)
{
    cJSON *o = cJSON_CreateObject(), *properties;
    cJSON_AddStringToObject(o, "type", "object");
    properties = cJSON_AddObjectToObject(o, "properties");
    cJSON_AddItemToObject(properties, "quantity", cJSON_Parse("{\"type\":\"string\"}"));
    cJSON_AddItemToObject(properties, "parameters", cJSON_Parse("{\"type\":\"object\"}"));
    cJSON *values = cJSON_AddObjectToObject(cJSON_AddObjectToObject(properties, "values"), "properties");
    for (size_t i = 0; i < quantity->n_outputs; i++) {
        cJSON *one = cJSON_Parse(NUMBERS);
        cJSON_AddStringToObject(one, "description", quantity->outputs[i].help);
        cJSON_AddItemToObject(values, quantity->outputs[i].name, one);
    }
    cJSON_AddItemToObject(properties, "units", cJSON_Parse("{\"type\":\"object\"}"));
    for (int i = 0; i < 2; i++)
        cJSON_AddItemToObject(properties, i ? "approximations" : "sources",
                              cJSON_Parse("{\"type\":\"array\",\"items\":{\"type\":\"string\"}}"));
    return o;
}

static cJSON *operation_of(const struct kd_quantity *quantity)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "summary", quantity->summary);
    cJSON *list = cJSON_AddArrayToObject(o, "parameters");
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        const struct kd_parameter *p = &quantity->parameters[i];
        add_parameter(list, p->name, p->help, p->words ? "" : p->unit, schema_of(p));
    }
    add_parameter(list, "format", "instead of Accept", "",
                  cJSON_Parse(quantity->sound ? "{\"enum\":[\"json\",\"csv\",\"wav\"]}" : "{\"enum\":[\"json\",\"csv\"]}"));
    cJSON *responses = cJSON_AddObjectToObject(o, "responses"), *ok = cJSON_AddObjectToObject(responses, "200");
    cJSON_AddStringToObject(ok, "description", quantity->summary);
    cJSON *content = cJSON_AddObjectToObject(ok, "content");
    cJSON_AddItemToObject(cJSON_AddObjectToObject(content, "application/json"), "schema", answer_of(quantity));
    cJSON_AddObjectToObject(content, "text/csv");
    if (quantity->sound)
        cJSON_AddObjectToObject(content, "audio/wav");
    cJSON_AddStringToObject(cJSON_AddObjectToObject(responses, "default"), "$ref", "#/components/responses/Problem");
    return o;
}

void kd_openapi_physics_paths(cJSON *paths)
{
    for (size_t i = 0; i < kd_quantity_count; i++) {
        char path[80];
        snprintf(path, sizeof path, "/v1/physics/%s", kd_quantities[i]->name);
        cJSON_AddItemToObject(cJSON_AddObjectToObject(paths, path), "get", operation_of(kd_quantities[i]));
    }
}
