/* Writes a whole file atomically. Any thread. */
#ifndef KD_BASE_REPLACE_H
#define KD_BASE_REPLACE_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

/* A temporary file is named NAME.kerrd-XXXXXX, with six letters or digits. This pattern does not match users' files
 * such as NAME.backup, which must not be removed. */
#define KD_TEMPORARY_MARK ".kerrd-"
enum { KD_TEMPORARY_TAIL = sizeof KD_TEMPORARY_MARK - 1 + 6 };

/* Writes a temporary file in the same folder and then renames it. Readers therefore see either the old file or the
 * new one, even after a power cut. folder: descriptor of the folder. On failure it returns false with errno, and the
 * old file stays. */
bool kd_replace_file_at(int folder, const char *name, const void *data, size_t size);
/* Like kd_replace_file_at, but the file is written in pieces. A successful kd_replace_begin must be followed by
 * kd_replace_commit or kd_replace_abandon. Each function returns false with errno on failure. */
struct kd_replacing {
    int folder, fd;
    char temporary[NAME_MAX + 1];
};
/* folder: a descriptor that the caller closes, after the file was committed or abandoned */
bool kd_replace_begin(int folder, const char *name, struct kd_replacing *out);
bool kd_replace_append(struct kd_replacing *file, const void *data, size_t size);
bool kd_replace_commit(struct kd_replacing *file, const char *name); /* releases *file even on failure */
void kd_replace_abandon(struct kd_replacing *file);
/* Like kd_replace_file_at, by path. Creates missing parent directories with mode 0700. Removes temporary files that
 * killed processes have left behind. */
bool kd_replace_file(const char *path, const void *data, size_t size);
/* True if kd_replace_file_at could use `other` as a temporary name for the file `name`. */
bool kd_replace_is_temporary(const char *other, const char *name);

#endif
