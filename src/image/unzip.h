/* Reads ZIP files (PKWARE APPNOTE 6.3.10) in memory. Members may be stored or deflated; split archives and
 * encryption are not supported. Any thread. Files may be hostile. The directory is read once, and only if it has at
 * most KD_UNZIP_MEMBERS entries. Unpacking a member allocates as many bytes as the directory states, and only if
 * this number is within the caller's limit. */
#ifndef KD_IMAGE_UNZIP_H
#define KD_IMAGE_UNZIP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

enum { KD_UNZIP_MEMBERS = 1024 };

struct kd_unzip_member {
    const char *name; /* points into the file, and is not NUL-terminated */
    size_t name_size;
    /* size, packed: bytes of the member after and before unpacking; at: offset of its own header */
    uint64_t size, packed, at;
    uint32_t crc;
    uint16_t method, flags;
};

struct kd_unzip {
    const uint8_t *data;
    size_t directory; /* offset of the directory; all members must end before it */
    struct kd_unzip_member *members;
    size_t n;
};

/* Reads the directory. The file's bytes must remain valid until kd_unzip_finish. KD_EINVAL with a message that
 * describes the fault, and calls the file "it"; KD_ENOMEM. */
enum kd_status kd_unzip_open(const void *data, size_t size, struct kd_unzip *out, struct kd_error *error);
void kd_unzip_finish(struct kd_unzip *zip); /* also permitted after kd_unzip_open has failed */
/* Finds the first member with this name. Returns NULL if there is none. */
const struct kd_unzip_member *kd_unzip_find(const struct kd_unzip *zip, const char *name);
/* Unpacks a member of at most `most` bytes into *out. *out must be empty, and stays empty on failure. KD_EINVAL with
 * the end of a sentence that starts with the member's name, such as "is longer than ..."; KD_ENOMEM. */
enum kd_status kd_unzip_take(const struct kd_unzip *zip, const struct kd_unzip_member *member, size_t most,
                             struct kd_buffer *out, struct kd_error *error);

#endif
