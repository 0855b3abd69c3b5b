/* A value comes from a document or a command line, is checked against its field's row and stored. Any thread. */
#ifndef KD_SCENE_VALUE_H
#define KD_SCENE_VALUE_H

#include "scene/table.h"

enum kd_value_kind { KD_VALUE_NUMBER, KD_VALUE_STRING, KD_VALUE_BOOL, KD_VALUE_NULL, KD_VALUE_ARRAY, KD_VALUE_OBJECT };

struct kd_value {
    enum kd_value_kind kind;
    double number;    /* NUMBER; 0 or 1 for BOOL */
    const char *text; /* STRING */
};

/* Stores the value, that of WORDS from their text, or fails with KD_EINVAL, the field's pointer, the value and what
 * is allowed; *scene is then unchanged. */
enum kd_status kd_value_store(struct kd_scene *scene, const struct kd_field *field, size_t index,
                              const struct kd_value *value, struct kd_error *error);

/* Checks the member "version": 1 and nothing else. */
enum kd_status kd_value_version(const struct kd_value *value, struct kd_error *error);

/* Takes typed text as the value that a document would hold in its place: what is not a number or a truth value is a
 * word. */
struct kd_value kd_value_typed(const char *text);

/* Says what a message adds after a value that is no number where only a number will do: ", a string where a number
 * is wanted", or "". */
const char *kd_value_unwanted(const struct kd_value *value);

/* Write how a message calls the value, and what its field allows: "-1 to 1 M", "\"a\" and \"b\"", "true or false". */
enum { KD_VALUE_SIZE = 80, KD_ALLOWED_SIZE = 400 };
void kd_value_describe(const struct kd_value *value, char out[KD_VALUE_SIZE]);
void kd_value_allowed(const struct kd_field *field, char out[KD_ALLOWED_SIZE]);

#endif
