/* Writes JSON Schemas of answers. The schema of an object permits only the members in its list, so that tests that
 * validate real answers find both additional and missing members. One thread at a time for a document. */
#ifndef KD_BASE_SCHEMA_H
#define KD_BASE_SCHEMA_H

#include "base/json.h"

#include <stdbool.h>
#include <string.h>

#define KD_SCHEMA_NUMBER "{\"type\":\"number\"}"
#define KD_SCHEMA_NUMBER_OR_NULL "{\"type\":[\"number\",\"null\"]}"
#define KD_SCHEMA_COUNT "{\"type\":\"integer\",\"minimum\":0}"
#define KD_SCHEMA_BOOL "{\"type\":\"boolean\"}"
#define KD_SCHEMA_TEXT "{\"type\":\"string\"}"
#define KD_SCHEMA_LIST(items) "{\"type\":\"array\",\"items\":" items "}"
#define KD_SCHEMA_MAP(values) "{\"type\":\"object\",\"additionalProperties\":" values "}"
#define KD_SCHEMA_VECTOR "{\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{\"type\":\"number\"}}"
/* Pattern of a decimal number (document/number.h). */
#define KD_SCHEMA_DECIMAL "-?((0|[1-9][0-9]*)([.][0-9]*)?|[.][0-9]+)([eE][-+]?[0-9]+)?"
#define KD_SCHEMA_REF(name) "{\"$ref\":\"#/components/schemas/" name "\"}"

/* Returns word `index` of an enumeration; NULL beyond the last one. */
typedef const char *kd_schema_words(size_t index);

struct kd_schema_member {
    const char *name, *schema; /* schema: JSON text; NULL: the schema is an enumeration of `words` */
    bool may_lack;
    kd_schema_words *words;
};

static inline void kd_schema_text(struct kd_json *json, const char *name, const char *schema)
{
    kd_json_raw(json, name, schema, strlen(schema));
}

/* Writes the member "enum" of a schema. */
static inline void kd_schema_words_of(struct kd_json *json, kd_schema_words *words)
{
    kd_json_array(json, "enum");
    for (size_t i = 0; words(i); i++)
        kd_json_string(json, NULL, words(i));
    kd_json_end(json);
}

/* Writes {"enum": [...]}. */
static inline void kd_schema_enum(struct kd_json *json, const char *name, kd_schema_words *words)
{
    kd_json_object(json, name);
    kd_schema_words_of(json, words);
    kd_json_end(json);
}

/* Writes the schema of a single word, both as a constant and as an enumeration with one entry. With "const" alone,
 * client generators take the word of one branch of a union for the only possible word. */
static inline void kd_schema_word(struct kd_json *json, const char *name, const char *word)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "string");
    kd_json_string(json, "const", word);
    kd_json_array(json, "enum");
    kd_json_string(json, NULL, word);
    kd_json_end(json);
    kd_json_end(json);
}

/* The first function begins the schema of an object `name` that permits no further members, and the second ends it.
 * Between the two calls the caller writes the schemas of the members. */
static inline void kd_schema_begin_strict(struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
}

static inline void kd_schema_end_strict(struct kd_json *json, const char *const *names, size_t n)
{
    kd_json_end(json);
    kd_json_array(json, "required");
    for (size_t i = 0; i < n; i++)
        kd_json_string(json, NULL, names[i]);
    kd_json_end(json);
    kd_json_end(json);
}

/* Writes the schema of the object `name`. about: NULL, or a description of its members, for example of their units. */
static inline void kd_schema_told(struct kd_json *json, const char *name, const char *about,
                                  const struct kd_schema_member *members, size_t n)
{
    kd_schema_begin_strict(json, name);
    for (size_t i = 0; i < n; i++)
        if (members[i].schema)
            kd_schema_text(json, members[i].name, members[i].schema);
        else
            kd_schema_enum(json, members[i].name, members[i].words);
    kd_json_end(json);
    kd_json_array(json, "required");
    for (size_t i = 0; i < n; i++)
        if (!members[i].may_lack)
            kd_json_string(json, NULL, members[i].name);
    kd_json_end(json);
    if (about)
        kd_json_string(json, "description", about);
    kd_json_end(json);
}
static inline void kd_schema_strict(struct kd_json *json, const char *name, const struct kd_schema_member *members,
                                    size_t n)
{
    kd_schema_told(json, name, NULL, members, n);
}

/* Like kd_schema_strict, for a table that is an array: the macro computes its length. */
#define KD_SCHEMA_STRICT(json, name, table) kd_schema_strict(json, name, table, sizeof(table) / sizeof *(table))
/* A numeric constant as a string literal, with the digits that it has in the source. */
#define KD_SCHEMA_DIGITS_OF(x) #x
#define KD_SCHEMA_DIGITS(x) KD_SCHEMA_DIGITS_OF(x)
#define KD_SCHEMA_TOLD(json, name, about, table) \
    kd_schema_told(json, name, about, table, sizeof(table) / sizeof *(table))

#endif
