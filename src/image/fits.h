/* Writes FITS files (FITS Standard 4.0, Pence et al. 2010, A&A 524, A42): arrays of 32-bit numbers with header
 * cards, texts longer than a card by CONTINUE, and the checksums of the standard's appendix J. Any thread.
 *
 *     struct kd_buffer cards = { 0 };
 *     kd_fits_text(&cards, "OBJECT", "Kerr black hole", NULL);
 *     kd_fits_image(&file, true, &image, &cards);      the first unit of the file; others with false
 * / */
#ifndef KD_IMAGE_FITS_H
#define KD_IMAGE_FITS_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KD_FITS_BLOCK = 2880, KD_FITS_CARD = 80 };

/* Each appends a card, of a text as many as it needs. key: at most 8 of A-Z, 0-9, - and _. comment: behind the value
 * as far as there is room; NULL: none. What is no printable ASCII becomes "?". KD_ENOMEM. */
enum kd_status kd_fits_text(struct kd_buffer *cards, const char *key, const char *value, const char *comment);
enum kd_status kd_fits_real(struct kd_buffer *cards, const char *key, double value, const char *comment); /* finite */
enum kd_status kd_fits_integer(struct kd_buffer *cards, const char *key, long long value, const char *comment);
enum kd_status kd_fits_comment(struct kd_buffer *cards, const char *text);

struct kd_fits_array {
    uint32_t width, height, channels; /* one channel: two axes; more: the third */
    const float *data;                /* rows from the top, a pixel's channels together; NaN: no value */
};

/* Appends a unit: the primary one, or an IMAGE extension. Its first row is the lowest one of the picture, as
 * astronomers have it. KD_ENOMEM. */
enum kd_status kd_fits_image(struct kd_buffer *out, bool primary, const struct kd_fits_array *array,
                             const struct kd_buffer *cards);

/* A unit may be written by pieces too: its head, with the sum of data that come later, then these, then zeros up to
 * a whole block. */
struct kd_fits_shape {
    bool primary;
    bool table; /* a BINTABLE of rows of axes[0] bytes, axes[1] of them, of `columns`, whose cards are the caller's;
                   else numbers of 32 bits */
    unsigned columns, n_axes;
    uint64_t axes[16];
};
/* Appends it. data_sum: kd_fits_sum of all of the data. KD_ENOMEM. */
enum kd_status kd_fits_head(struct kd_buffer *out, const struct kd_fits_shape *shape, const struct kd_buffer *cards,
                            uint32_t data_sum);
/* The sum of data (ones' complement, of big-endian words): a whole number of words at a time, from 0 on; two sums
 * add to that of both. */
uint32_t kd_fits_sum(uint32_t sum, const void *data, size_t size);
uint32_t kd_fits_add_sums(uint32_t a, uint32_t b);
/* Zeros behind so many bytes of data. */
static inline size_t kd_fits_padding(uint64_t size)
{
    return (size_t)((KD_FITS_BLOCK - size % KD_FITS_BLOCK) % KD_FITS_BLOCK);
}

/* The bytes of a header at the beginning of these, a whole number of blocks; 0: its end is not among them. */
size_t kd_fits_head_size(const void *data, size_t size);
/* A card of a header that is a whole number; false: there is none. */
bool kd_fits_number(const void *head, size_t size, const char *key, long long *out);
/* A card of a header that is a number; NAN: there is none. */
double kd_fits_find_real(const void *head, size_t size, const char *key);

/* Appends the text of a card of the primary header, its continuations joined, to *out. KD_EINVAL: it is not there,
 * or no FITS file. */
enum kd_status kd_fits_find(const void *data, size_t size, const char *key, struct kd_buffer *out);

#endif
