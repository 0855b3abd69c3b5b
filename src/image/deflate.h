/* Makes deflate streams (RFC 1951) in pieces, by libraries that are several times faster than zlib. Pieces that
 * were made apart, each by a struct kd_deflate of its own if need be, are a stream when they stand one after another,
 * as pigz makes them: each but the last ends with an empty stored block, which ends with a byte. A piece refers to none
 * before it: of 512 KiB that costs less than 1 % (docs/decisions/0004-live-png.md).
 *
 * One thread at a time uses a struct kd_deflate; it keeps its working memory from one call to the next. */
#ifndef KD_IMAGE_DEFLATE_H
#define KD_IMAGE_DEFLATE_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum kd_deflate_engine {
    KD_DEFLATE_LIBDEFLATE, /* everywhere */
    KD_DEFLATE_ISAL, /* ISA-L's igzip, level 1; where it was built in, on x86-64: four times as fast, files a tenth
                        larger */
    KD_DEFLATE_COUNT
};
const char *kd_deflate_name(enum kd_deflate_engine engine); /* "libdeflate", "isa-l" */
bool kd_deflate_has(enum kd_deflate_engine engine);         /* built in */
enum kd_deflate_engine kd_deflate_fastest(void);            /* of those built in */

struct kd_deflate;
/* level: 0 to 12, as libdeflate has it; ISA-L has 1 alone. KD_EINVAL for an engine that is not built in. */
enum kd_status kd_deflate_create(enum kd_deflate_engine engine, int level, struct kd_deflate **out,
                                 struct kd_error *error);
void kd_deflate_destroy(struct kd_deflate *deflate); /* NULL is fine */

/* Append one piece, of at most KD_DEFLATE_MAX bytes. KD_ENOMEM; KD_EINTERNAL if libdeflate has made what is no deflate
 * stream; out->size is then as it was. The same data give the same bytes: by libdeflate everywhere, by ISA-L on the
 * same kind of processor. */
#define KD_DEFLATE_MAX ((size_t)1 << 30)
enum kd_status kd_deflate_piece(struct kd_deflate *deflate, const void *data, size_t size, bool last,
                                struct kd_buffer *out);

/* A zlib stream (RFC 1950) is these two bytes, pieces, and the checksum of all data, its largest byte first. */
void kd_zlib_head(int level, uint8_t to[2]);
uint32_t kd_zlib_sum(const void *data, size_t size);
/* The checksum of data, and of other data behind it, `size` bytes: that of both together. */
uint32_t kd_zlib_sum_join(uint32_t sum, uint32_t other, size_t size);

#endif
