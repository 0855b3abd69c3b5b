/* Parses a Range header (RFC 9110 14.1.2). Pure; any thread. */
#ifndef KD_SERVER_HTTP_RANGE_H
#define KD_SERVER_HTTP_RANGE_H

#include <stdint.h>

enum kd_byte_range {
    KD_RANGE_WHOLE,  /* send all bytes, because there is no Range header or it is ignored */
    KD_RANGE_PART,   /* send `count` bytes from position `first` */
    KD_RANGE_BEYOND, /* the range is outside the file; the status is 416 */
};

/* Decides which of `size` bytes a Range header selects. All bytes are selected if it is NULL or malformed, has a
 * unit other than bytes, or lists several ranges, as RFC 9110 14.2 permits. */
enum kd_byte_range kd_range_read(const char *value, uint64_t size, uint64_t *first, uint64_t *count);

#endif
