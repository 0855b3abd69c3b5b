/* Writes NumPy's .npy files, format versions 1.0 and 2.0: little-endian numbers in C order. Any thread.
 *
 * Numbers are floats of 8 and 4 bytes, whole numbers of 4, and bytes; an element is one number or a record of named
 * ones, some of them short arrays themselves. Whatever else NumPy can store is refused by name. */
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
    KD_NPY_HEADER_MAX = 10000, /* as NumPy itself reads */
};

/* The last three are written, and not read but for kd_npy_read_text; the last two are of plain elements alone: text
 * of `count` characters, NULs behind it; in UTF-32, or as bytes. */
enum kd_npy_type { KD_NPY_F8, KD_NPY_F4, KD_NPY_U1, KD_NPY_U4, KD_NPY_TEXT, KD_NPY_BYTES };

struct kd_npy_field {
    char name[KD_NPY_NAME]; /* letters, digits and _; "" when the elements are plain numbers */
    enum kd_npy_type type;
    uint32_t count; /* 0: one number; n: an array of shape (n,) */
};

struct kd_npy {
    struct kd_npy_field fields[KD_NPY_FIELDS]; /* one after the other, without padding */
    size_t n_fields;
    uint64_t shape[KD_NPY_DIMENSIONS];
    size_t n_dimensions;
    /* filled in by kd_npy_read */
    size_t header_size, item_size;
    uint64_t items;
};

/* Everything up to the first element, a multiple of 64 bytes. */
enum kd_status kd_npy_write_header(const struct kd_npy *array, struct kd_buffer *out);

/* Look at a whole file: its elements are at data + out->header_size, possibly unaligned. KD_EINVAL says what is wrong
 * with it; that includes bytes missing at the end or left over there. */
enum kd_status kd_npy_read(const void *data, size_t size, struct kd_npy *out, struct kd_error *error);

/* Append a text to *out as UTF-8: an array of no dimension that holds a str, as numpy.array(TEXT) makes it, or
 * bytes; or a list of bytes, |u1. KD_EINVAL says what is wrong with it; KD_ENOMEM. */
enum kd_status kd_npy_read_text(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error);

size_t kd_npy_item_size(const struct kd_npy *array);

#endif
