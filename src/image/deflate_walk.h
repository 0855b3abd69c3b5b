/* Finds where the last block of a deflate stream (RFC 1951) begins and ends. This is needed because libdeflate makes
 * complete streams only: the result shows which bits must be changed so that another stream can follow. Pure, any
 * thread. */
#ifndef KD_IMAGE_DEFLATE_WALK_H
#define KD_IMAGE_DEFLATE_WALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Positions are in bits from the start of the stream. The lowest bit of a byte comes first (RFC 1951, 3.1.1). */
struct kd_deflate_walk {
    size_t last; /* position of the bit BFINAL of the last block */
    size_t end;  /* position of the first bit after that block */
};

/* Returns false if the bytes are not a deflate stream. The function skips symbols without decoding their data, which
 * is several times faster than compression at level 1. */
bool kd_deflate_walk(const uint8_t *stream, size_t size, struct kd_deflate_walk *out);

#endif
