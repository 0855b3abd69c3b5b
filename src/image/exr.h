/* Writes OpenEXR files with named channels of 32-bit numbers, by OpenEXR's C core. A file has one part, scan lines
 * and ZIP compression. Any thread. */
#ifndef KD_IMAGE_EXR_H
#define KD_IMAGE_EXR_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

struct kd_exr_channel {
    char name[40];     /* name such as "R" or "kerrd.g"; must be unique */
    const float *data; /* rows from the top */
    size_t step;       /* distance between two pixels, counted in numbers */
};
struct kd_exr_text { const char *name, *value; }; /* a string attribute; its name has at most 31 bytes */

struct kd_exr {
    uint32_t width, height;
    const struct kd_exr_channel *channels;
    size_t n_channels;
    const struct kd_exr_text *texts;
    size_t n_texts;
};

/* Appends a file. KD_ENOMEM; KD_EINVAL if the format cannot hold the content. */
enum kd_status kd_exr_encode(const struct kd_exr *image, struct kd_buffer *out, struct kd_error *error);

/* Appends the value of a string attribute of the file to *out. Returns KD_EINVAL if the attribute is missing, or if
 * the file is not a complete EXR file. */
enum kd_status kd_exr_find_text(const void *data, size_t size, const char *name, struct kd_buffer *out,
                                struct kd_error *error);

#endif
