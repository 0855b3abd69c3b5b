/* Reads ZIP files (PKWARE APPNOTE 6.3.10) in memory: stored or deflated members, one file, without encryption. Any
 * thread.
 *
 * Files may be hostile. The directory is read once, and only if it has at most KD_UNZIP_MEMBERS entries. Unpacking a
 * member allocates only as many bytes as the directory gives for it, if that is within the caller's limit. */
#ifndef KD_IMAGE_UNZIP_H
#define KD_IMAGE_UNZIP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

enum { KD_UNZIP_MEMBERS = 1024 };

struct kd_unzip_member {
    const char *name; /* points into the file; not NUL-terminated */
    size_t name_size;
    uint64_t size, packed, at; /* at: offset of the member's own header */
    uint32_t crc;
    uint16_t method, flags;
};

struct kd_unzip {
    const uint8_t *data;
    size_t directory; /* offset of the directory: members must end before it */
    struct kd_unzip_member *members;
    size_t n;
};

/* Reads the directory; the file's bytes must remain valid until kd_unzip_finish. KD_EINVAL with a sentence about the
 * fault, in which "it" means the file; KD_ENOMEM. */
enum kd_status kd_unzip_open(const void *data, size_t size, struct kd_unzip *out, struct kd_error *error);
void kd_unzip_finish(struct kd_unzip *zip); /* accepts a struct whose kd_unzip_open has failed */
/* Finds a member, the first one of this name; NULL if there is none. */
const struct kd_unzip_member *kd_unzip_find(const struct kd_unzip *zip, const char *name);
/* Unpacks a member of at most `most` bytes into *out. *out must be empty, and stays so on failure. KD_EINVAL with a
 * message that completes a sentence about the member: "is longer than ..."; KD_ENOMEM. */
enum kd_status kd_unzip_take(const struct kd_unzip *zip, const struct kd_unzip_member *member, size_t most,
                             struct kd_buffer *out, struct kd_error *error);

#endif
