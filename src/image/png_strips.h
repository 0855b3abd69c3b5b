/* Makes the IDAT chunks of a PNG of its pixels: filtered, and one zlib stream (PNG specification, third edition,
 * W3C 2025, sections 9 to 11). Strips of some 512 KiB are filtered and deflated apart, on as many cores as are idle,
 * and each is an IDAT chunk; a picture below 4 MiB (1 MiB by ISA-L) is one strip. For png.c and png_live.c. */
#ifndef KD_IMAGE_PNG_STRIPS_H
#define KD_IMAGE_PNG_STRIPS_H

#include "image/deflate.h"
#include "image/png.h"

/* Appends one chunk. KD_ENOMEM, and part of it may then be there. */
enum kd_status kd_png_chunk(struct kd_buffer *out, const char type[5], const void *data, size_t size);

/* Working memory, 1 to 2 MiB for each thread that has been at work at once; it stays from one picture to the next. One
 * thread at a time uses it. */
struct kd_png_strips;
enum kd_status kd_png_strips_create(enum kd_deflate_engine engine, struct kd_png_strips **out, struct kd_error *error);
void kd_png_strips_destroy(struct kd_png_strips *strips); /* NULL is fine */

/* Appends all IDAT chunks; params->compression is the same in all calls, and text does not matter. KD_ENOMEM, and
 * out->size is then as it was. */
enum kd_status kd_png_strips_append(struct kd_png_strips *strips, const struct kd_png_params *params,
                                    struct kd_buffer *out, struct kd_error *error);

#endif
