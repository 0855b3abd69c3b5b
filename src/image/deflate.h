/* This makes zlib streams (RFC 1950) in a hurry: of whole buffers, by libraries that are several times faster than
 * zlib. image/png.h, which writes files, does not use this.
 *
 * One thread at a time uses a struct kd_deflate; it keeps its working memory from one call to the next. */
#ifndef KD_IMAGE_DEFLATE_H
#define KD_IMAGE_DEFLATE_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum kd_deflate_engine {
    KD_DEFLATE_LIBDEFLATE, /* level 1; everywhere */
    KD_DEFLATE_ISAL, /* ISA-L's igzip, level 1; where it was built in, on x86-64: four times as fast, files a tenth
                        larger */
    KD_DEFLATE_COUNT
};
const char *kd_deflate_name(enum kd_deflate_engine engine); /* "libdeflate", "isa-l" */
bool kd_deflate_has(enum kd_deflate_engine engine);         /* built in */
enum kd_deflate_engine kd_deflate_fastest(void);            /* of those built in */

struct kd_deflate;
/* KD_EINVAL for an engine that is not built in. */
enum kd_status kd_deflate_create(enum kd_deflate_engine engine, struct kd_deflate **out, struct kd_error *error);
void kd_deflate_destroy(struct kd_deflate *deflate); /* NULL is fine */

/* Append one zlib stream of the data, at most KD_DEFLATE_MAX bytes. Fails with KD_ENOMEM alone, and out->size is
 * then as it was. The same data give the same bytes on the same kind of processor. */
#define KD_DEFLATE_MAX ((size_t)1 << 30)
enum kd_status kd_deflate_append(struct kd_deflate *deflate, const void *data, size_t size, struct kd_buffer *out);

#endif
