/* Makes the IDAT chunks of a PNG from its pixels: the filtered rows as one zlib stream (PNG specification, third
 * edition, W3C 2025, sections 9 to 11). Strips of about 512 KiB are filtered and deflated separately, on as many
 * cores as are idle, and each strip becomes an IDAT chunk. A picture below 4 MiB (1 MiB with ISA-L) is a single
 * strip. Used by png.c and png_live.c. */
#ifndef KD_IMAGE_PNG_STRIPS_H
#define KD_IMAGE_PNG_STRIPS_H

#include "image/deflate.h"
#include "image/png.h"

/* Appends one chunk. KD_ENOMEM: out of memory; part of the chunk may then have been appended. */
enum kd_status kd_png_chunk(struct kd_buffer *out, const char type[5], const void *data, size_t size);

/* Working memory that is kept between pictures: 1 to 2 MiB for each thread that has encoded strips at the same time
 * as others. Only one thread at a time may use the struct. */
struct kd_png_strips;
enum kd_status kd_png_strips_create(enum kd_deflate_engine engine, struct kd_png_strips **out, struct kd_error *error);
void kd_png_strips_destroy(struct kd_png_strips *strips); /* accepts NULL */

/* Appends all IDAT chunks. params->compression must be the same in all calls; texts are ignored. KD_ENOMEM;
 * out->size is then unchanged. */
enum kd_status kd_png_strips_append(struct kd_png_strips *strips, const struct kd_png_params *params,
                                    struct kd_buffer *out, struct kd_error *error);

#endif
