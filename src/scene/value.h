/* Values from a document or a command line. They are checked against the row of their field, and stored. Any thread. */
#ifndef KD_SCENE_VALUE_H
#define KD_SCENE_VALUE_H

#include "scene/table.h"

enum kd_value_kind { KD_VALUE_NUMBER, KD_VALUE_STRING, KD_VALUE_BOOL, KD_VALUE_NULL, KD_VALUE_ARRAY, KD_VALUE_OBJECT };

struct kd_value {
    enum kd_value_kind kind;
    double number;    /* value of a NUMBER; 0 or 1 for a BOOL */
    const char *text; /* value of a STRING */
};

/* Stores the value; words of a WORDS field are read from the text of a STRING. On failure returns KD_EINVAL with the
 * field's pointer, the value and what is allowed; *scene is then unchanged. */
enum kd_status kd_value_store(struct kd_scene *scene, const struct kd_field *field, size_t index,
                              const struct kd_value *value, struct kd_error *error);

/* Checks the member "version", which must be 1. */
enum kd_status kd_value_version(const struct kd_value *value, struct kd_error *error);

/* Interprets typed text like a value of a document: as a number, as true or false, otherwise as a string. */
struct kd_value kd_value_typed(const char *text);

/* What a message adds after a value if a number is required and the value is none: ", a string where a number is
 * wanted". Otherwise "". */
const char *kd_value_unwanted(const struct kd_value *value);

/* Describe a value, and what its field allows, for messages. Ranges are written as "-1 to 1 M", words as "\"a\" and
 * \"b\"", and a BOOL as "true or false". */
enum { KD_VALUE_SIZE = 80, KD_ALLOWED_SIZE = 400 };
void kd_value_describe(const struct kd_value *value, char out[KD_VALUE_SIZE]);
void kd_value_allowed(const struct kd_field *field, char out[KD_ALLOWED_SIZE]);

#endif
