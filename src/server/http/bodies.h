/* Bytes of the bodies that are being received and have not been read yet, in all and by client. Any thread.
 *
 * No client has more than its share, which leaves room for the largest body of another one; and some room is kept for small ones. */
#ifndef KD_SERVER_HTTP_BODIES_H
#define KD_SERVER_HTTP_BODIES_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_bodies;

/* max: in all; share: of one client; reserve: beside max, for bodies of at most `small` bytes. NULL: out of memory. */
struct kd_bodies_params {
    size_t max, share, reserve, small;
};
struct kd_bodies *kd_bodies_create(const struct kd_bodies_params *params);
void kd_bodies_destroy(struct kd_bodies *bodies); /* accepts NULL */

/* So many more bytes of a body that has `size` or will: KD_EBUSY, and nothing is counted, where they are too many in all, or with
 * *quota of this client. bytes 0: whether any may come. */
enum kd_status kd_bodies_take(struct kd_bodies *bodies, const char *client, size_t bytes, size_t size, bool *quota);
void kd_bodies_give(struct kd_bodies *bodies, const char *client, size_t bytes);
size_t kd_bodies_bytes(const struct kd_bodies *bodies); /* waits for nobody */

#endif
