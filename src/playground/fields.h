/* Reads parts of documents that no table of rows describes. Private to src/playground. */
#ifndef KD_PLAYGROUND_FIELDS_H
#define KD_PLAYGROUND_FIELDS_H

#include "base/error.h"

#include <cjson/cJSON.h>

/* Fails with the message "there is no field X here", and with the field's pointer. */
enum kd_status kd_playground_unknown(const char *pointer, const char *name, struct kd_error *error);
/* Reads an array of n finite numbers of magnitude up to `most`. */
enum kd_status kd_playground_numbers(double *to, int n, double most, const cJSON *item, const char *pointer,
                                     struct kd_error *error);
/* to = "pointer/name" */
void kd_playground_pointer(char to[160], const char *pointer, const char *name);

#endif
