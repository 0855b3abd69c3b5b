/* Memory budget of requests: bytes of bodies that are being received, and of answers that clients have not read yet.
 * They are counted in total and for each client. Any thread.
 *
 * No client may hold more than its share, and a reserve is kept for small requests. */
#ifndef KD_SERVER_HTTP_BYTES_H
#define KD_SERVER_HTTP_BYTES_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_bytes;

struct kd_bytes_params {
    /* Number of clients counted separately, at most the number of connections. All further clients are counted as
     * one. */
    unsigned clients;
    size_t max, share; /* limits in bytes: of all clients together; of one client */
    /* reserve: bytes beyond max for bodies or answers of at most `small` bytes; a client may use the fraction share
     * / max of the reserve */
    size_t reserve, small;
    bool lone; /* a client that holds nothing may exceed share; if no client holds anything, it may also exceed max */
};
struct kd_bytes *kd_bytes_create(const struct kd_bytes_params *params); /* returns NULL when out of memory */
void kd_bytes_destroy(struct kd_bytes *bytes);                          /* accepts NULL */

/* Reserves n more bytes of a body or answer whose full length is `size`. If that exceeds a limit, returns KD_EBUSY
 * and reserves nothing. *quota then tells whether the exceeded limit is this client's share. n = 0 tests whether a
 * limit is already exceeded. */
enum kd_status kd_bytes_take(struct kd_bytes *bytes, const char *client, size_t n, size_t size, bool *quota);
/* Counts bytes that are already allocated, even beyond the limits. */
void kd_bytes_add(struct kd_bytes *bytes, const char *client, size_t n);
void kd_bytes_give(struct kd_bytes *bytes, const char *client, size_t n);
size_t kd_bytes_held(const struct kd_bytes *bytes); /* bytes reserved now; never blocks */

#endif
