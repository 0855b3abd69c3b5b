/* Writes a whole file atomically. Any thread. */
#ifndef KD_BASE_REPLACE_H
#define KD_BASE_REPLACE_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

/* A file is called NAME.kerrd-XXXXXX, with six letters or digits, while it is written. Users do not give their own
 * files such names, whereas they may well have a NAME.backup. */
#define KD_TEMPORARY_MARK ".kerrd-"
enum { KD_TEMPORARY_TAIL = sizeof KD_TEMPORARY_MARK - 1 + 6 };

/* Writes a temporary file in the same folder and renames it: readers see the old file or the new one, even after a
 * power cut. folder: a descriptor of the folder. False, with errno, on failure; the old file then stays. */
bool kd_replace_file_at(int folder, const char *name, const void *data, size_t size);
/* The same, piece by piece. After a successful begin the caller must commit or abandon. Each returns false with
 * errno on failure. */
struct kd_replacing {
    int folder, fd;
    char temporary[NAME_MAX + 1];
};
/* the caller keeps the folder open and closes it */
bool kd_replace_begin(int folder, const char *name, struct kd_replacing *out);
bool kd_replace_append(struct kd_replacing *file, const void *data, size_t size);
bool kd_replace_commit(struct kd_replacing *file, const char *name); /* ends it, also on failure */
void kd_replace_abandon(struct kd_replacing *file);
/* The same by path. Creates missing parent directories with mode 0700, and removes temporary files that killed
 * processes left behind. */
bool kd_replace_file(const char *path, const void *data, size_t size);
/* True if `other` is a temporary name that kd_replace_file_at could use for `name`. */
bool kd_replace_is_temporary(const char *other, const char *name);

#endif
