/* The members of a JSON object in a request: those that are known, each once. Errors name the member, what was given
 * and what is allowed, with the pointer into the request. Any thread. */
#ifndef KD_SCENE_MEMBERS_H
#define KD_SCENE_MEMBERS_H

#include "base/error.h"

#include <cjson/cJSON.h>
#include <stddef.h>

struct kd_member {
    const char *name;
    const cJSON **to; /* NULL before; stays so if it is not there */
};
/* pointer: that of the object. KD_EINVAL for one that is unknown or there twice. */
enum kd_status kd_members_read(const cJSON *object, const char *pointer, const struct kd_member *members, size_t n,
                               struct kd_error *error);

/* Fails: what stands there is not what is allowed, in words. */
enum kd_status kd_member_refuse(const cJSON *item, const char *pointer, const char *allowed, struct kd_error *error);

/* A whole number. */
enum kd_status kd_member_whole(const cJSON *item, const char *pointer, unsigned least, unsigned most, unsigned *out,
                               struct kd_error *error);

/* One of some words, by its number; where it is not there *out stays as it is. */
enum kd_status kd_member_word(const cJSON *item, const char *pointer, const char *const *words, size_t n, unsigned *out,
                              struct kd_error *error);

/* Puts the pointer of a part before that of an error in it; gives the status back. */
enum kd_status kd_member_inside(enum kd_status status, const char *pointer, struct kd_error *error);

#endif
