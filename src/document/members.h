/* Reads single values of a request that no table of rows describes. An error message contains the member, its value
 * and the accepted values. The error's pointer leads to the member within the request. Any thread. */
#ifndef KD_DOCUMENT_MEMBERS_H
#define KD_DOCUMENT_MEMBERS_H

#include "base/error.h"

#include <cjson/cJSON.h>
#include <stddef.h>

/* Returns KD_EINVAL with a message that says what the item must be; `allowed` is the end of that sentence. */
enum kd_status kd_member_refuse(const cJSON *item, const char *pointer, const char *allowed, struct kd_error *error);

/* Reads a whole number in the range `least` to `most`. */
enum kd_status kd_member_whole(const cJSON *item, const char *pointer, unsigned least, unsigned most, unsigned *out,
                               struct kd_error *error);

/* Reads one of n words and stores the word's index. If item is NULL, *out stays unchanged. */
enum kd_status kd_member_word(const cJSON *item, const char *pointer, const char *const *words, size_t n, unsigned *out,
                              struct kd_error *error);

/* Prepends the pointer of a part of the document to the pointer of the error. Returns the status. */
enum kd_status kd_member_inside(enum kd_status status, const char *pointer, struct kd_error *error);

#endif
