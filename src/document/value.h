/* Values from a document or a command line whose fields are not known yet. Any thread. */
#ifndef KD_DOCUMENT_VALUE_H
#define KD_DOCUMENT_VALUE_H

enum kd_value_kind { KD_VALUE_NUMBER, KD_VALUE_STRING, KD_VALUE_BOOL, KD_VALUE_NULL, KD_VALUE_ARRAY, KD_VALUE_OBJECT };

struct kd_value {
    enum kd_value_kind kind;
    double number;    /* value of a NUMBER; for a BOOL: 0 or 1 */
    const char *text; /* value of a STRING */
};

/* Interprets typed text as a value of a document: as a number, as true or false, or otherwise as a string. */
struct kd_value kd_value_typed(const char *text);

/* Text that a message appends to a value, such as ", a string where a number is needed". It is "" if the value is a
 * number or no number is required. */
const char *kd_value_unwanted(const struct kd_value *value);

/* Writes a description of a value, for messages. */
enum { KD_VALUE_SIZE = 80, KD_ALLOWED_SIZE = 400 };
void kd_value_describe(const struct kd_value *value, char out[KD_VALUE_SIZE]);

#endif
