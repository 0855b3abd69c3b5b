/* Parses a Range header (RFC 9110 14.1.2). Pure; any thread. */
#ifndef KD_SERVER_HTTP_RANGE_H
#define KD_SERVER_HTTP_RANGE_H

#include <stdint.h>

enum kd_range {
    KD_RANGE_WHOLE,  /* there is none, or none that is taken: the answer is the whole */
    KD_RANGE_PART,   /* `count` bytes from `first` on */
    KD_RANGE_BEYOND, /* none of its bytes is there: 416 */
};

/* Which bytes of `size` a Range value asks for; NULL: all. What is malformed, what is of another unit than bytes and
 * a list of several ranges ask for the whole, as RFC 9110 14.2 lets a server have it. */
enum kd_range kd_range_read(const char *value, uint64_t size, uint64_t *first, uint64_t *count);

#endif
