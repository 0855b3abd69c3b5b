/* Reads a whole file. Any thread. */
#ifndef KD_BASE_READ_H
#define KD_BASE_READ_H

#include "base/buffer.h"

#include <stdbool.h>

/* Appends the bytes of a regular file to out. folder: the descriptor to which `name` is relative, or AT_FDCWD.
 * flags: additional flags for openat, such as O_NOFOLLOW. On failure it returns false with errno and leaves out
 * unchanged. EINVAL: not a regular file; EFBIG: more than `most` bytes. It never waits for the writer of a pipe. */
bool kd_read_file(int folder, const char *name, int flags, size_t most, struct kd_buffer *out);

#endif
