/* Reads a whole file. Any thread. */
#ifndef KD_BASE_READ_H
#define KD_BASE_READ_H

#include "base/buffer.h"

#include <stdbool.h>

/* Appends the bytes of a regular file to out. folder: a descriptor that `name` is relative to, or AT_FDCWD; flags:
 * of open besides those for reading, such as O_NOFOLLOW. False with errno and out as it was; EINVAL: it is a pipe, a
 * device or a folder; EFBIG: it has more than `most` bytes. Never waits for whoever writes. */
bool kd_read_file(int folder, const char *name, int flags, size_t most, struct kd_buffer *out);

#endif
