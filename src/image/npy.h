/* Writes and reads NumPy's .npy files, format versions 1.0 and 2.0: little-endian numbers in C order. Any thread.
 *
 * The supported types are floats of 8 and 4 bytes, whole numbers of 4 bytes, and bytes. An element is one number, or
 * a record of named numbers, some of which may be short arrays. Any other type of NumPy is an error whose message
 * names the type. */
#ifndef KD_IMAGE_NPY_H
#define KD_IMAGE_NPY_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

enum {
    KD_NPY_FIELDS = 20,
    KD_NPY_DIMENSIONS = 16,
    KD_NPY_DIMENSIONS_READ = 4,
    KD_NPY_NAME = 32,
    KD_NPY_HEADER_MAX = 10000, /* maximum header size that NumPy's own reader accepts */
};

/* The last three types can be written, but only kd_npy_read_text reads them. The last two are for plain elements
 * only: an element is a text of `count` characters, padded with NULs, in UTF-32 or as bytes. */
enum kd_npy_type { KD_NPY_F8, KD_NPY_F4, KD_NPY_U1, KD_NPY_U4, KD_NPY_TEXT, KD_NPY_BYTES };

struct kd_npy_field {
    char name[KD_NPY_NAME]; /* name of letters, digits and _; "" if the elements are plain numbers */
    enum kd_npy_type type;
    uint32_t count; /* 0: one number; n: an array of n numbers, of shape (n,) */
};

struct kd_npy {
    struct kd_npy_field fields[KD_NPY_FIELDS]; /* adjacent, without padding */
    size_t n_fields;
    uint64_t shape[KD_NPY_DIMENSIONS];
    size_t n_dimensions;
    /* set by kd_npy_read */
    size_t header_size, item_size;
    uint64_t items;
};

/* Writes everything before the first element; its size is a multiple of 64 bytes. */
enum kd_status kd_npy_write_header(const struct kd_npy *array, struct kd_buffer *out);

/* Parses a whole file. Its elements are at data + out->header_size, which may be unaligned. Returns KD_EINVAL with a
 * message that describes the fault; missing or surplus bytes at the end are faults too. */
enum kd_status kd_npy_read(const void *data, size_t size, struct kd_npy *out, struct kd_error *error);

/* Appends a text to *out as UTF-8. The text is the str or bytes in an array without dimensions (as numpy.array(TEXT)
 * makes it), or a list of bytes, |u1. Returns KD_EINVAL with a message that describes the fault; KD_ENOMEM. */
enum kd_status kd_npy_read_text(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error);

size_t kd_npy_item_size(const struct kd_npy *array);

#endif
