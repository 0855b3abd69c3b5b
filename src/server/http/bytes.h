/* Memory budget of requests. It covers the bytes of bodies that are being received, and of answers that clients have
 * not read yet, in total and per client. No client may hold more than its share, and a reserve is kept for small
 * requests. Any thread. */
#ifndef KD_SERVER_HTTP_BYTES_H
#define KD_SERVER_HTTP_BYTES_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_bytes;

struct kd_bytes_params {
    /* number of clients that are counted separately, at most the number of connections; all others are counted as
     * one client */
    unsigned clients;
    size_t max, share; /* limits in bytes: max for all clients together, share for one client */
    /* reserve: bytes beyond max, only for bodies or answers of at most `small` bytes. One client may use the
     * fraction share / max of the reserve. */
    size_t reserve, small;
    /* true if a client that holds nothing may exceed share, and may also exceed max if no client holds anything */
    bool lone;
};
struct kd_bytes *kd_bytes_create(const struct kd_bytes_params *params); /* returns NULL when out of memory */
void kd_bytes_destroy(struct kd_bytes *bytes);                          /* accepts NULL */

/* Reserves n more bytes of a body or answer whose full length is `size`. If a limit would be exceeded, returns
 * KD_EBUSY and reserves nothing; *quota is then true if this limit is the client's share. n = 0 tests whether a
 * limit is already exceeded. */
enum kd_status kd_bytes_take(struct kd_bytes *bytes, const char *client, size_t n, size_t size, bool *quota);
/* Counts bytes that are already allocated, even if they exceed the limits. */
void kd_bytes_add(struct kd_bytes *bytes, const char *client, size_t n);
void kd_bytes_give(struct kd_bytes *bytes, const char *client, size_t n);
size_t kd_bytes_held(const struct kd_bytes *bytes); /* number of bytes that are reserved now; never blocks */

#endif
