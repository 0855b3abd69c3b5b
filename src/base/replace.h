/* A file written as a whole. Any thread. */
#ifndef KD_BASE_REPLACE_H
#define KD_BASE_REPLACE_H

#include <stdbool.h>
#include <stddef.h>

/* Makes the directories on the way (private ones), writes beside the path and renames: readers see the old file or the new
 * one, even after a power cut. False, with errno, if it cannot be; the old file then stays. */
bool kd_replace_file(const char *path, const void *data, size_t size);

#endif
