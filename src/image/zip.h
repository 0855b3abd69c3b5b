/* This makes ZIP files in memory, by libarchive: stored or deflated, without times, so that the same members are the
 * same bytes. One thread a file. */
#ifndef KD_IMAGE_ZIP_H
#define KD_IMAGE_ZIP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_zip;

/* Its bytes are appended to *out, which must stay. KD_ENOMEM. */
enum kd_status kd_zip_create(struct kd_buffer *out, bool deflated, struct kd_zip **zip);
/* KD_ENOMEM. A member by pieces: their sizes add up to `size`. Between any two of these calls the caller may take
 * bytes off *out. */
enum kd_status kd_zip_begin(struct kd_zip *zip, const char *name, uint64_t size);
enum kd_status kd_zip_append(struct kd_zip *zip, const void *data, size_t size);
/* KD_ENOMEM. A whole one. */
enum kd_status kd_zip_add(struct kd_zip *zip, const char *name, const void *data, size_t size);
enum kd_status kd_zip_close(struct kd_zip *zip); /* the last bytes; KD_ENOMEM */
void kd_zip_destroy(struct kd_zip *zip);

/* Appends a member of a ZIP file to *out, of at most `most` bytes; it must be among the first 1024. KD_EINVAL: no
 * such member, too long, damaged, or not a whole ZIP file. */
enum kd_status kd_zip_find(const void *data, size_t size, const char *name, size_t most, struct kd_buffer *out);
/* Says whether there is one of this name, whole or damaged. */
bool kd_zip_has(const void *data, size_t size, const char *name);

#endif
