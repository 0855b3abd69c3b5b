/* Writes FITS files (FITS Standard 4.0, Pence et al. 2010, A&A 524, A42): arrays of 32-bit numbers with header cards,
 * texts longer than a card by CONTINUE, and the checksums of the standard's appendix J. Any thread.
 *
 *     struct kd_buffer cards = { 0 };
 *     kd_fits_text(&cards, "OBJECT", "Kerr black hole", NULL);
 *     kd_fits_image(&file, true, &image, &cards);      the first HDU of the file; false for later ones */
#ifndef KD_IMAGE_FITS_H
#define KD_IMAGE_FITS_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KD_FITS_BLOCK = 2880, KD_FITS_CARD = 80 };

/* Each appends a card; a text takes as many cards as it needs. key: at most 8 of A-Z, 0-9, - and _. comment: follows
 * the value as far as there is room; NULL: none. Characters other than printable ASCII become "?". KD_ENOMEM. */
enum kd_status kd_fits_text(struct kd_buffer *cards, const char *key, const char *value, const char *comment);
/* value: must be finite */
enum kd_status kd_fits_real(struct kd_buffer *cards, const char *key, double value, const char *comment);
enum kd_status kd_fits_integer(struct kd_buffer *cards, const char *key, long long value, const char *comment);
enum kd_status kd_fits_logical(struct kd_buffer *cards, const char *key, bool value, const char *comment);
enum kd_status kd_fits_comment(struct kd_buffer *cards, const char *text);

struct kd_fits_array {
    /* one channel: the array has two axes; more channels: the channel is a third axis */
    uint32_t width, height, channels;
    const float *data; /* rows from the top, channels of a pixel adjacent; NaN: no value */
};

/* Appends an HDU: the primary one, or an IMAGE extension. The first row in the file is the picture's lowest one, as in
 * astronomy. KD_ENOMEM. */
enum kd_status kd_fits_image(struct kd_buffer *out, bool primary, const struct kd_fits_array *array,
                             const struct kd_buffer *cards);

/* An HDU may also be written in pieces, in this order: its header, which includes the sum of the data; the data;
 * zeros up to a whole block. */
struct kd_fits_shape {
    bool primary;
    /* a BINTABLE of axes[1] rows of axes[0] bytes, with `columns` columns, whose cards the caller provides;
     * otherwise an array of 32-bit numbers */
    bool table;
    unsigned columns, n_axes;
    uint64_t axes[16];
};
/* Appends the header. data_sum: kd_fits_sum of all data. KD_ENOMEM. */
enum kd_status kd_fits_head(struct kd_buffer *out, const struct kd_fits_shape *shape, const struct kd_buffer *cards,
                            uint32_t data_sum);
/* kd_fits_sum: sum of data (ones' complement, of big-endian words). Data may be summed in pieces of whole words; the
 * first sum is 0. kd_fits_add_sums: the sum of two sums. */
uint32_t kd_fits_sum(uint32_t sum, const void *data, size_t size);
uint32_t kd_fits_add_sums(uint32_t a, uint32_t b);
/* Number of zeros that must follow `size` bytes of data. */
static inline size_t kd_fits_padding(uint64_t size)
{
    return (size_t)((KD_FITS_BLOCK - size % KD_FITS_BLOCK) % KD_FITS_BLOCK);
}

/* Size of the header at the start of the data, a whole number of blocks; 0 if the data do not include the header's
 * end. */
size_t kd_fits_head_size(const void *data, size_t size);
/* Value of a whole-number card of a header; false if there is none. */
bool kd_fits_number(const void *head, size_t size, const char *key, long long *out);
/* Value of a numeric card of a header; NAN if there is none. */
double kd_fits_find_real(const void *head, size_t size, const char *key);

/* Appends the text of a card of the primary header to *out, with its continuations joined. KD_EINVAL if the card is
 * missing, or the data are not a FITS file. */
enum kd_status kd_fits_find(const void *data, size_t size, const char *key, struct kd_buffer *out);

#endif
