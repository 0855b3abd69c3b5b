/* Stores values of documents in structs by tables of settings, and writes them. Private to src/playground. */
#ifndef KD_PLAYGROUND_FIELDS_H
#define KD_PLAYGROUND_FIELDS_H

#include "playground/params.h"
#include "base/json.h"
#include "document/value.h"

#include <cjson/cJSON.h>

/* Finds a row by name, NULL if there is none. */
const struct kd_playground_setting *kd_playground_row(const struct kd_playground_setting *table, size_t n,
                                                      const char *name);

/* Stores a value in *to. KD_EINVAL with the pointer, the value and what is allowed. */
enum kd_status kd_playground_put(void *to, const struct kd_playground_setting *row, const struct kd_value *value,
                                 const char *pointer, struct kd_error *error);
/* Writes the value of a row of *from as a member. */
void kd_playground_tell(const void *from, const struct kd_playground_setting *row, struct kd_json *json);

/* Fails with "there is no field X here" and its pointer. */
enum kd_status kd_playground_unknown(const char *pointer, const char *name, struct kd_error *error);
/* Reads an array of n finite numbers of magnitude up to `most`. */
enum kd_status kd_playground_numbers(double *to, int n, double most, const cJSON *item, const char *pointer,
                                     struct kd_error *error);
/* to = "pointer/name" */
void kd_playground_pointer(char to[160], const char *pointer, const char *name);

#endif
