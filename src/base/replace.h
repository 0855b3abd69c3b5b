/* Writes a whole file atomically. Any thread. */
#ifndef KD_BASE_REPLACE_H
#define KD_BASE_REPLACE_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

/* While a file is written it is called NAME.kerrd-XXXXXX, with six letters or digits: nobody calls a file of their
 * own so, as they may NAME.backup. */
#define KD_TEMPORARY_MARK ".kerrd-"
enum { KD_TEMPORARY_TAIL = sizeof KD_TEMPORARY_MARK - 1 + 6 };

/* Writes beside the name and renames: readers see the old file or the new one, even after a power cut. folder: a
 * descriptor of the folder. False, with errno, if it cannot be; the old file then stays. */
bool kd_replace_file_at(int folder, const char *name, const void *data, size_t size);
/* The same piece by piece. One that has begun is committed or abandoned; each is false with errno where it fails. */
struct kd_replacing {
    int folder, fd;
    char temporary[NAME_MAX + 1];
};
bool kd_replace_begin(int folder, const char *name, struct kd_replacing *out); /* the folder stays the caller's */
bool kd_replace_append(struct kd_replacing *file, const void *data, size_t size);
bool kd_replace_commit(struct kd_replacing *file, const char *name); /* it has ended, also on failure */
void kd_replace_abandon(struct kd_replacing *file);
/* The same by a path. Makes the directories on the way (private ones), and removes what killed processes have left
 * of earlier attempts. */
bool kd_replace_file(const char *path, const void *data, size_t size);
/* Whether `other` is what kd_replace_file_at calls the file while it writes it. */
bool kd_replace_is_temporary(const char *other, const char *name);

#endif
