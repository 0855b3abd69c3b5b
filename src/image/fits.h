/* Writes FITS files (FITS Standard 4.0, Pence et al. 2010, A&A 524, A42): arrays of 32-bit numbers with header
 * cards, CONTINUE cards for long texts, and the checksums of the standard's appendix J. Any thread.
 *
 *     struct kd_buffer cards = { 0 };
 *     kd_fits_text(&cards, "OBJECT", "Kerr black hole", NULL);
 *     kd_fits_image(&file, true, &image, &cards);      true for the first HDU of the file */
#ifndef KD_IMAGE_FITS_H
#define KD_IMAGE_FITS_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KD_FITS_BLOCK = 2880, KD_FITS_CARD = 80 };

/* Each function appends a card; a long text takes several cards. key: at most 8 characters of A-Z, 0-9, - and _.
 * comment: written after the value as far as there is room; NULL: none. Characters other than printable ASCII become
 * "?". KD_ENOMEM. */
enum kd_status kd_fits_text(struct kd_buffer *cards, const char *key, const char *value, const char *comment);
/* value must be finite */
enum kd_status kd_fits_real(struct kd_buffer *cards, const char *key, double value, const char *comment);
enum kd_status kd_fits_integer(struct kd_buffer *cards, const char *key, long long value, const char *comment);
enum kd_status kd_fits_logical(struct kd_buffer *cards, const char *key, bool value, const char *comment);
enum kd_status kd_fits_comment(struct kd_buffer *cards, const char *text);

struct kd_fits_array {
    /* with one channel the array has two axes; with more, the channel is a third axis */
    uint32_t width, height, channels;
    const float *data; /* rows from the top; the channels of a pixel are adjacent; NaN means no value */
};

/* Appends an HDU: the primary one, or an IMAGE extension. The first row in the file is the lowest row of the
 * picture, as is usual in astronomy. KD_ENOMEM. */
enum kd_status kd_fits_image(struct kd_buffer *out, bool primary, const struct kd_fits_array *array,
                             const struct kd_buffer *cards);

/* An HDU can also be written in pieces, in this order: its header, which contains the checksum of the data; the
 * data; zeros up to a whole block. */
struct kd_fits_shape {
    bool primary;
    /* true: the HDU is a BINTABLE with axes[1] rows of axes[0] bytes and `columns` columns, whose cards the caller
     * provides; false: it is an array of 32-bit numbers */
    bool table;
    unsigned columns, n_axes;
    uint64_t axes[16];
};
/* Appends the header. data_sum: result of kd_fits_sum for all data. KD_ENOMEM. */
enum kd_status kd_fits_head(struct kd_buffer *out, const struct kd_fits_shape *shape, const struct kd_buffer *cards,
                            uint32_t data_sum);
/* kd_fits_sum computes the checksum of data (ones' complement, of big-endian words). The data may be summed in
 * pieces of whole words; start with the sum 0. kd_fits_add_sums adds two checksums. */
uint32_t kd_fits_sum(uint32_t sum, const void *data, size_t size);
uint32_t kd_fits_add_sums(uint32_t a, uint32_t b);
/* Number of zeros that must follow data of `size` bytes. */
static inline size_t kd_fits_padding(uint64_t size)
{
    return (size_t)((KD_FITS_BLOCK - size % KD_FITS_BLOCK) % KD_FITS_BLOCK);
}

/* Size of the header at the start of the data, a multiple of the block size; 0 if the data do not contain the end of
 * the header. */
size_t kd_fits_head_size(const void *data, size_t size);
/* Reads the whole number of a header card. Returns false if there is no such card. */
bool kd_fits_number(const void *head, size_t size, const char *key, long long *out);
/* Reads the number of a header card. Returns NAN if there is no such card. */
double kd_fits_find_real(const void *head, size_t size, const char *key);

/* Appends the text of a card in the primary header to *out, joined from all continuation cards. Returns KD_EINVAL if
 * the card is missing, or if the data are not a FITS file. */
enum kd_status kd_fits_find(const void *data, size_t size, const char *key, struct kd_buffer *out);

#endif
