/* These read and write whole files; "-" is standard input or output. Main thread only. */
#ifndef KD_CLI_FILE_H
#define KD_CLI_FILE_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>

/* KD_EINVAL when there is no such file to read or it has more than `most` bytes. Finish *out in any case. */
enum kd_status kd_file_read(const char *path, size_t most, struct kd_buffer *out, struct kd_error *error);

/* Checks, before a long render rather than after it, that kd_file_write will be able to write. A terminal is
 * refused. */
enum kd_status kd_file_check(const char *path, struct kd_error *error);

/* Writes under a temporary name and renames, so that nobody ever sees half a file. A device or a pipe is written to
 * directly. */
enum kd_status kd_file_write(const char *path, const struct kd_buffer *data, struct kd_error *error);

/* Does the same for bytes that are made while they are written: `read` gives up to `size` more, 0 at the end,
 * KD_FILE_STOP where it has failed: no file is left then, and its reason is the caller's to report. */
#define KD_FILE_STOP ((size_t)-1)
enum kd_status kd_file_stream(const char *path, size_t (*read)(void *user, void *to, size_t size), void *user,
                              struct kd_error *error);

#endif
