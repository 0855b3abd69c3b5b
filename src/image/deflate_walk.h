/* Finds where the last block of a deflate stream begins and ends (RFC 1951). libdeflate makes complete streams only.
 * The result tells which bits of a stream to change, so that another stream can follow. Pure, any thread. */
#ifndef KD_IMAGE_DEFLATE_WALK_H
#define KD_IMAGE_DEFLATE_WALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bits count from the start of the stream; the lowest bit of a byte comes first (RFC 1951, 3.1.1). */
struct kd_deflate_walk {
    size_t last; /* position of the bit BFINAL of the last block */
    size_t end;  /* position of the first bit after that block */
};

/* Returns false if the bytes are not a deflate stream. Skips symbols without decoding their data, several times as fast
 * as level 1 compresses. */
bool kd_deflate_walk(const uint8_t *stream, size_t size, struct kd_deflate_walk *out);

#endif
