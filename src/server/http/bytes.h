/* Memory budget of requests: bytes of bodies that are being received and of answers that the client has not taken yet,
 * in total and for each client. Any thread.
 *
 * No client may hold more than its share, and a reserve is kept for small requests. */
#ifndef KD_SERVER_HTTP_BYTES_H
#define KD_SERVER_HTTP_BYTES_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_bytes;

/* NULL: out of memory. */
struct kd_bytes_params {
    /* How many clients are told apart at once; there are never more than connections. What further ones have counts
     * as that of one. */
    unsigned clients;
    size_t max, share;     /* in all; of one client */
    size_t reserve, small; /* beside max, for what has at most `small` bytes; and as large a share of it */
    bool lone; /* a client that has nothing here may have more than a share, and more than max where nobody has anything
                */
};
struct kd_bytes *kd_bytes_create(const struct kd_bytes_params *params);
void kd_bytes_destroy(struct kd_bytes *bytes); /* accepts NULL */

/* Takes n more bytes of something that has, or will have, `size` in all. KD_EBUSY, and nothing is counted, where
 * they are too many in all, or with *quota too many of this client. n 0 asks whether any may come. */
enum kd_status kd_bytes_take(struct kd_bytes *bytes, const char *client, size_t n, size_t size, bool *quota);
/* Counts bytes that are there already, whether they are too many or not. */
void kd_bytes_add(struct kd_bytes *bytes, const char *client, size_t n);
void kd_bytes_give(struct kd_bytes *bytes, const char *client, size_t n);
size_t kd_bytes_held(const struct kd_bytes *bytes); /* waits for nobody */

#endif
