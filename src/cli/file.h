/* Reads and writes whole files; "-" is standard input or output. Main thread only. */
#ifndef KD_CLI_FILE_H
#define KD_CLI_FILE_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>

/* Reads a file. Returns KD_EINVAL if it does not exist or has more than `most` bytes. The caller must finish *out in
 * any case. */
enum kd_status kd_file_read(const char *path, size_t most, struct kd_buffer *out, struct kd_error *error);

/* Call this before a long render: it checks that kd_file_write can write to the path. A terminal is refused. */
enum kd_status kd_file_check(const char *path, struct kd_error *error);

/* Writes a file under a temporary name and then renames it, so that a partial file is never visible. Devices and
 * pipes are written directly. */
enum kd_status kd_file_write(const char *path, const struct kd_buffer *data, struct kd_error *error);

/* Like kd_file_write, for bytes that are generated during the write. `read` provides up to `size` more bytes and
 * returns their number: 0 at the end, or KD_FILE_STOP on failure. After KD_FILE_STOP no file is left, and the caller
 * must report the reason. */
#define KD_FILE_STOP ((size_t)-1)
enum kd_status kd_file_stream(const char *path, size_t (*read)(void *user, void *to, size_t size), void *user,
                              struct kd_error *error);

#endif
