/* Where the last block of a deflate stream begins, and where it ends (RFC 1951). libdeflate makes whole streams alone:
 * this tells what to change so that another stream may follow. Pure, any thread. */
#ifndef KD_IMAGE_DEFLATE_WALK_H
#define KD_IMAGE_DEFLATE_WALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bits are counted from the stream's first; a byte's lowest comes first (RFC 1951, 3.1.1). */
struct kd_deflate_walk {
    size_t last; /* the bit BFINAL of the last block */
    size_t end;  /* the first bit after it */
};

/* false: the bytes are no deflate stream. It goes through the symbols without what they stand for, several times as
 * fast as level 1 makes them. */
bool kd_deflate_walk(const uint8_t *stream, size_t size, struct kd_deflate_walk *out);

#endif
