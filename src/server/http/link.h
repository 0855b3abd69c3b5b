/* Signed links are addresses that work without an access token until they expire. `kerrd sign` makes them with a key
 * of the token file, and the server makes them for shared scenes (--share-key).
 *
 * The query of a link ends with signer=NAME&expires=SECONDS&budget_ms=MS&signature=HEX; budget_ms may be missing.
 * The signature is HMAC-SHA256 (RFC 2104) of the link's text: the path below the base path, then a line NAME=VALUE
 * for each parameter except the signature, in the query's order. Paths, names and values are percent-encoded in the
 * text by base/percent.h, independent of the request's own encoding. */
#ifndef KD_SERVER_HTTP_LINK_H
#define KD_SERVER_HTTP_LINK_H

#include "server/http/access.h"
#include "server/http/target.h"

#include <stdint.h>

/* number of seconds for which a link still works after its end, because clocks differ */
#define KD_LINK_LEEWAY_S 60u
#define KD_LINK_LATEST_S 253402300799 /* the last second of the year 9999, in Unix time */
#define KD_LINK_BUDGET_MS 86400000u   /* largest budget */
#define KD_SHARED_DAYS 30             /* number of days for which the link to a shared scene works */

/* The terms of a link: when it expires, and how much device time its pictures may use. */
struct kd_link_terms {
    uint64_t expires_s; /* Unix time */
    uint64_t budget_ms; /* limit in ms of the device time that all pictures of the link may use together; 0: no limit */
};

/* The signed link by which a request came. */
struct kd_link {
    bool on; /* true if the request came by a valid link */
    char signer[KD_ACCESS_NAME_MAX + 1];
    struct kd_link_terms terms;
    uint64_t id; /* the first bytes of the link's signature */
};

/* Appends the parameters "signer=...&signature=...", which turn an address into a signed link. path: decoded path
 * below the base path. target: its pairs are the parameters of the address; may be NULL. Returns KD_EINVAL if the
 * token file has no key of this name. Any thread. */
enum kd_status kd_link_sign(const struct kd_access *access, const char *name, const char *path,
                            const struct kd_target *target, const struct kd_link_terms *terms, struct kd_buffer *out,
                            struct kd_error *error);

/* True if the query has a signature. */
bool kd_link_is(const struct kd_target *target);
/* Checks the signature of the request's link. path and target are as for kd_link_sign. On success, removes the
 * link's parameters from the target, and returns the owner of the key. Otherwise returns NULL with *error. Any
 * thread. */
const struct kd_visitor *kd_link_check(const struct kd_access *access, const char *path, struct kd_target *target,
                                       uint64_t now_s, struct kd_link *out, struct kd_error *error);

#endif
