/* Writes OpenEXR files of named channels of 32-bit numbers, with OpenEXR's C core: one part, scan lines, ZIP. Any
 * thread. */
#ifndef KD_IMAGE_EXR_H
#define KD_IMAGE_EXR_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

struct kd_exr_channel {
    char name[40];     /* "R", "kerrd.g": must be unique */
    const float *data; /* rows from the top */
    size_t step;       /* distance between pixels, in numbers */
};
struct kd_exr_text { const char *name, *value; }; /* a string attribute; name: at most 31 bytes */

struct kd_exr {
    uint32_t width, height;
    const struct kd_exr_channel *channels;
    size_t n_channels;
    const struct kd_exr_text *texts;
    size_t n_texts;
};

/* Appends a file. KD_ENOMEM; KD_EINVAL for content that the format cannot hold. */
enum kd_status kd_exr_encode(const struct kd_exr *image, struct kd_buffer *out, struct kd_error *error);

/* Appends the value of a file's string attribute to *out. KD_EINVAL if the attribute is missing, or the file is not a
 * complete EXR file. */
enum kd_status kd_exr_find_text(const void *data, size_t size, const char *name, struct kd_buffer *out,
                                struct kd_error *error);

#endif
