/* Parses a request target: the path, and the query's pairs, percent-decoded. */
#ifndef KD_SERVER_HTTP_TARGET_H
#define KD_SERVER_HTTP_TARGET_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_TARGET_PAIRS 384 /* more than the fields of a scene, those of all elements of its lists included */

struct kd_target {
    char *text; /* owns what the pointers below point into */
    char *path; /* behind the base path, once the route is found */
    struct kd_target_pair { const char *name, *value; } pairs[KD_TARGET_PAIRS];
    size_t n_pairs;
};

/* raw: "/v1/render?preset=NAME&camera.r=30" as received. KD_EINVAL for a bad escape, for what is not UTF-8,
 * control characters or more than KD_TARGET_PAIRS pairs. "+" is a space in the query, as forms send it.
 * Whatever the result, finish it. */
enum kd_status kd_target_parse(struct kd_target *target, const char *raw, struct kd_error *error);
void kd_target_finish(struct kd_target *target);

/* Takes a target in absolute form apart (RFC 9112 3.2.2): "http://HOST:PORT/v1/presets" becomes "/v1/presets", and
 * its host *authority, for the caller to free. Targets in other forms stay as they are. KD_ENOMEM alone. */
enum kd_status kd_target_origin(char *raw, char **authority);

/* Checks that the query gives no parameter twice; else KD_EINVAL. */
enum kd_status kd_target_distinct(const struct kd_target *target, struct kd_error *error);
/* Checks that as well, and that each parameter is among the known, which end with a NULL, or is the token; else
 * KD_EINVAL. */
enum kd_status kd_target_only(const struct kd_target *target, const char *const *known, struct kd_error *error);
/* A parameter of the query, NULL: it is not given. */
const char *kd_target_value(const struct kd_target *target, const char *name);
/* Reads a number of decimal digits alone; false: it is not so, or above most. */
bool kd_target_number(const char *text, uint64_t most, uint64_t *out);
/* A parameter as such a number, or what holds without it; false: it is not one, or above most. */
bool kd_target_whole(const struct kd_target *target, const char *name, uint64_t otherwise, uint64_t most,
                     uint64_t *out);

#endif
