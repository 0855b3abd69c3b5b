/* Readers for parts of documents that no table of rows describes. Private to src/playground. */
#ifndef KD_PLAYGROUND_FIELDS_H
#define KD_PLAYGROUND_FIELDS_H

#include "base/error.h"

#include <cjson/cJSON.h>

/* Sets the error "there is no field X here", with the pointer of the field. */
enum kd_status kd_playground_unknown(const char *pointer, const char *name, struct kd_error *error);
/* Reads an array of n finite numbers whose magnitudes are at most `most`. */
enum kd_status kd_playground_numbers(double *to, int n, double most, const cJSON *item, const char *pointer,
                                     struct kd_error *error);
/* sets `to` to "pointer/name" */
void kd_playground_pointer(char to[160], const char *pointer, const char *name);

#endif
