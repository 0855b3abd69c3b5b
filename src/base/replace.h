/* Writes a whole file atomically. Any thread. */
#ifndef KD_BASE_REPLACE_H
#define KD_BASE_REPLACE_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

/* A temporary file is named NAME.kerrd-XXXXXX, with six letters or digits. The pattern must not match files of
 * users, who may well have a NAME.backup. */
#define KD_TEMPORARY_MARK ".kerrd-"
enum { KD_TEMPORARY_TAIL = sizeof KD_TEMPORARY_MARK - 1 + 6 };

/* Writes a temporary file in the same folder, then renames it. So readers see the old file or the new one, even after a
 * power cut. folder: a descriptor of the folder. On failure it returns false with errno, and the old file stays. */
bool kd_replace_file_at(int folder, const char *name, const void *data, size_t size);
/* Like kd_replace_file_at, but the file is written in pieces. After a successful kd_replace_begin the caller must call
 * kd_replace_commit or kd_replace_abandon. Each function returns false with errno on failure. */
struct kd_replacing {
    int folder, fd;
    char temporary[NAME_MAX + 1];
};
/* the caller keeps the folder open, and closes it afterwards */
bool kd_replace_begin(int folder, const char *name, struct kd_replacing *out);
bool kd_replace_append(struct kd_replacing *file, const void *data, size_t size);
bool kd_replace_commit(struct kd_replacing *file, const char *name); /* ends the writing, even on failure */
void kd_replace_abandon(struct kd_replacing *file);
/* Like kd_replace_file_at, by path. Creates missing parent directories with mode 0700. Removes temporary files that
 * killed processes have left behind. */
bool kd_replace_file(const char *path, const void *data, size_t size);
/* True if `other` is a temporary name that kd_replace_file_at could use for `name`. */
bool kd_replace_is_temporary(const char *other, const char *name);

#endif
