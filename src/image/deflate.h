/* Makes deflate streams (RFC 1951) in pieces, by libraries that are several times faster than zlib. Pieces can be
 * made independently, each with its own struct kd_deflate. Concatenated they form one stream, as in pigz: each piece
 * except the last ends with an empty stored block, which ends on a byte boundary. A piece does not refer to earlier
 * ones; for pieces of 512 KiB this makes the stream less than 1 % larger (docs/decisions/0004-live-png.md).
 *
 * One thread at a time uses a struct kd_deflate; it keeps its working memory between calls. */
#ifndef KD_IMAGE_DEFLATE_H
#define KD_IMAGE_DEFLATE_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum kd_deflate_engine {
    KD_DEFLATE_LIBDEFLATE, /* always built in */
    /* ISA-L's igzip at level 1, optional, only on x86-64: four times as fast, with output a tenth larger */
    KD_DEFLATE_ISAL,
    KD_DEFLATE_COUNT
};
const char *kd_deflate_name(enum kd_deflate_engine engine); /* "libdeflate", "isa-l" */
bool kd_deflate_has(enum kd_deflate_engine engine);         /* true if the engine is built in */
enum kd_deflate_engine kd_deflate_fastest(void);            /* the fastest engine among those built in */

struct kd_deflate;
/* level: 0 to 12, as in libdeflate; ISA-L has level 1 only. Returns KD_EINVAL for an engine that is not built in. */
enum kd_status kd_deflate_create(enum kd_deflate_engine engine, int level, struct kd_deflate **out,
                                 struct kd_error *error);
void kd_deflate_destroy(struct kd_deflate *deflate); /* accepts NULL */

/* Appends one piece, made of at most KD_DEFLATE_MAX bytes of data. KD_ENOMEM; KD_EINTERNAL if libdeflate has
 * produced an invalid stream. On failure out->size is unchanged. With libdeflate the same data give the same bytes
 * everywhere; with ISA-L only on the same kind of processor. */
#define KD_DEFLATE_MAX ((size_t)1 << 30)
enum kd_status kd_deflate_piece(struct kd_deflate *deflate, const void *data, size_t size, bool last,
                                struct kd_buffer *out);

/* A zlib stream (RFC 1950) consists of the two bytes from kd_zlib_head, the pieces, and the big-endian checksum of
 * all data. */
void kd_zlib_head(int level, uint8_t to[2]);
uint32_t kd_zlib_sum(const void *data, size_t size);
/* Computes the checksum of two consecutive blocks of data from their own checksums. size: bytes in the second block. */
uint32_t kd_zlib_sum_join(uint32_t sum, uint32_t other, size_t size);

#endif
