/* Writes and reads NumPy's .npy files, format versions 1.0 and 2.0: little-endian numbers in C order. Any thread.
 *
 * Supported are floats of 8 and 4 bytes, whole numbers of 4, and bytes. An element is one number or a record of named
 * ones, some of which may be short arrays. Other types that NumPy can store are errors, which name the type. */
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
    KD_NPY_HEADER_MAX = 10000, /* limit of NumPy's own reader */
};

/* The last three types can be written, but only kd_npy_read_text reads them. The last two are for plain elements only:
 * a text of `count` characters, padded with NULs, in UTF-32 or as bytes. */
enum kd_npy_type { KD_NPY_F8, KD_NPY_F4, KD_NPY_U1, KD_NPY_U4, KD_NPY_TEXT, KD_NPY_BYTES };

struct kd_npy_field {
    char name[KD_NPY_NAME]; /* letters, digits and _; "" if the elements are plain numbers */
    enum kd_npy_type type;
    uint32_t count; /* 0: one number; n: an array of shape (n,) */
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

/* Writes everything up to the first element; the size of this is a multiple of 64 bytes. */
enum kd_status kd_npy_write_header(const struct kd_npy *array, struct kd_buffer *out);

/* Parses a whole file: its elements are at data + out->header_size, possibly unaligned. KD_EINVAL with a message
 * about the fault. Missing or surplus bytes at the end are faults too. */
enum kd_status kd_npy_read(const void *data, size_t size, struct kd_npy *out, struct kd_error *error);

/* Appends a text to *out as UTF-8: from an array of no dimension that holds a str (as numpy.array(TEXT) makes it) or
 * bytes; or from a list of bytes, |u1. KD_EINVAL with a message about the fault; KD_ENOMEM. */
enum kd_status kd_npy_read_text(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error);

size_t kd_npy_item_size(const struct kd_npy *array);

#endif
