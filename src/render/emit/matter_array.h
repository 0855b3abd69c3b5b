/* Reads arrays in a grid's file without copying them: numbers of type <f8 or <f4 in C order. Pure, any thread. */
#ifndef KD_RENDER_EMIT_MATTER_ARRAY_H
#define KD_RENDER_EMIT_MATTER_ARRAY_H

#include "base/buffer.h"
#include "base/error.h"
#include "image/unzip.h"

#include <stdbool.h>

/* An array; all zero: no array. */
struct kd_matter_array {
    struct kd_buffer file;
    const uint8_t *numbers; /* points into the file, not aligned */
    bool single;            /* true if the numbers are <f4; false: <f8 */
    size_t n, dimensions;
    uint64_t shape[4];
};

/* kd_matter_refuse returns KD_EINVAL with a sentence that names the array. kd_matter_no_memory returns KD_ENOMEM. */
enum kd_status kd_matter_refuse(const char *name, const char *what, struct kd_error *error);
enum kd_status kd_matter_no_memory(struct kd_error *error);
bool kd_matter_has(const struct kd_unzip *zip, const char *name);
/* Unpacks the member NAME.npy, of at most `most` bytes, into *out, which must be empty. */
enum kd_status kd_matter_member(const struct kd_unzip *zip, const char *name, size_t most, struct kd_buffer *out,
                                struct kd_error *error);
/* Takes an array of at most `most` numbers. *out must be empty before, and is still empty after a failure. */
enum kd_status kd_matter_array_take(const struct kd_unzip *zip, const char *name, size_t most,
                                    struct kd_matter_array *out, struct kd_error *error);
double kd_matter_array_at(const struct kd_matter_array *array, size_t i);
void kd_matter_array_finish(struct kd_matter_array *array);

#endif
