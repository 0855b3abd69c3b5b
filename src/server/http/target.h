/* Parses the target of a request: the path, and the pairs of the query, percent-decoded. */
#ifndef KD_SERVER_HTTP_TARGET_H
#define KD_SERVER_HTTP_TARGET_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* maximum number of pairs in a query; a scene with full lists has fewer fields */
#define KD_TARGET_PAIRS 384

struct kd_target {
    char *text; /* buffer to which the pointers below point; owned */
    char *path; /* the decoded path, from which the base path is removed when the route is found */
    struct kd_target_pair { const char *name, *value; } pairs[KD_TARGET_PAIRS];
    size_t n_pairs;
};

/* raw: the target as received, "/v1/render?preset=NAME&camera.r=30". In the query, "+" is a space, as in submitted
 * forms. Returns KD_EINVAL for a malformed escape, invalid UTF-8, a control character, or more than KD_TARGET_PAIRS
 * pairs. The caller must call kd_target_finish in every case. */
enum kd_status kd_target_parse(struct kd_target *target, const char *raw, struct kd_error *error);
void kd_target_finish(struct kd_target *target);

/* Shortens a target in absolute form (RFC 9112 3.2.2). "http://HOST:PORT/v1/presets" becomes "/v1/presets", and
 * *authority becomes HOST:PORT (malloc'd). Targets in other forms are not changed. The only error is KD_ENOMEM. */
enum kd_status kd_target_origin(char *raw, char **authority);

/* Returns KD_EINVAL if a parameter occurs twice. */
enum kd_status kd_target_distinct(const struct kd_target *target, struct kd_error *error);
/* Returns KD_EINVAL if a parameter occurs twice or is unknown. The known parameters are "token" and those in the
 * arrays `known` and `former`, which end with NULL. The message lists the names in `known`. */
enum kd_status kd_target_only(const struct kd_target *target, const char *const *known, const char *const *former,
                              struct kd_error *error);
/* Returns the value of a query parameter; NULL if it is absent. */
const char *kd_target_value(const struct kd_target *target, const char *name);
/* Parses decimal digits. Returns false if the text contains anything else or the number exceeds `most`. */
bool kd_target_number(const char *text, uint64_t most, uint64_t *out);
/* Parses a parameter by kd_target_number. If it is absent, the result is `otherwise`. Returns false if it is
 * malformed or exceeds `most`. */
bool kd_target_whole(const struct kd_target *target, const char *name, uint64_t otherwise, uint64_t most,
                     uint64_t *out);

#endif
