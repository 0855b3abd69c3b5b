/* Writes ZIP files (PKWARE APPNOTE 6.3.10) in memory. Members are stored or deflated. They have no times, so that
 * the same members always give the same bytes. unzip.h reads such files. One thread at a time for a file. */
#ifndef KD_IMAGE_ZIP_H
#define KD_IMAGE_ZIP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_zip;

/* Starts a file that is written to *out, which must remain valid. deflated: if true, kd_zip_add compresses members
 * that become smaller. KD_ENOMEM. */
enum kd_status kd_zip_create(struct kd_buffer *out, bool deflated, struct kd_zip **zip);
/* Begins a stored member, which the caller then writes in pieces of `size` bytes altogether. Between any two calls
 * the caller may remove bytes from *out. KD_ENOMEM. */
enum kd_status kd_zip_begin(struct kd_zip *zip, const char *name, uint64_t size);
enum kd_status kd_zip_append(struct kd_zip *zip, const void *data, size_t size);
/* Counts the missing bytes of the open member as if they were written. This is used to compute the size of a file in
 * advance. KD_ENOMEM. */
enum kd_status kd_zip_pass_over(struct kd_zip *zip);
/* Adds a whole member. KD_ENOMEM. */
enum kd_status kd_zip_add(struct kd_zip *zip, const char *name, const void *data, size_t size);
enum kd_status kd_zip_close(struct kd_zip *zip); /* writes the directory; KD_ENOMEM */
void kd_zip_destroy(struct kd_zip *zip);         /* Accepts NULL. */

#endif
