/* Single values of a request that are in no table of rows. Errors name the member, its value and the allowed values.
 * Their pointer leads to the member within the request. Any thread. */
#ifndef KD_DOCUMENT_MEMBERS_H
#define KD_DOCUMENT_MEMBERS_H

#include "base/error.h"

#include <cjson/cJSON.h>
#include <stddef.h>

/* Returns KD_EINVAL with a message that says that the item must be what `allowed` describes. */
enum kd_status kd_member_refuse(const cJSON *item, const char *pointer, const char *allowed, struct kd_error *error);

/* Reads an integer from `least` to `most`. */
enum kd_status kd_member_whole(const cJSON *item, const char *pointer, unsigned least, unsigned most, unsigned *out,
                               struct kd_error *error);

/* Reads one of n words and stores its index. If item is NULL, *out stays unchanged. */
enum kd_status kd_member_word(const cJSON *item, const char *pointer, const char *const *words, size_t n, unsigned *out,
                              struct kd_error *error);

/* Prepends the pointer of a part of the document to the pointer of the error. Returns the status. */
enum kd_status kd_member_inside(enum kd_status status, const char *pointer, struct kd_error *error);

#endif
