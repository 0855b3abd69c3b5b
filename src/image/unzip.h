/* Reads ZIP files (PKWARE APPNOTE 6.3.10) that are in memory: members that are stored or deflated, of one file,
 * without encryption. Any thread.
 *
 * Files may be hostile. The directory is gone through once, and only if it has at most KD_UNZIP_MEMBERS entries. A
 * member is unpacked into as many bytes as the directory says, if these are no more than the caller takes: nothing
 * else is allocated for it. */
#ifndef KD_IMAGE_UNZIP_H
#define KD_IMAGE_UNZIP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

enum { KD_UNZIP_MEMBERS = 1024 };

struct kd_unzip_member {
    const char *name; /* in the file; not terminated */
    size_t name_size;
    uint64_t size, packed, at; /* at: where its own header begins */
    uint32_t crc;
    uint16_t method, flags;
};

struct kd_unzip {
    const uint8_t *data;
    size_t directory; /* where it begins: members end before */
    struct kd_unzip_member *members;
    size_t n;
};

/* Reads the directory; the file's bytes must stay until kd_unzip_finish. KD_EINVAL says what is wrong, of the file
 * as "it"; KD_ENOMEM. */
enum kd_status kd_unzip_open(const void *data, size_t size, struct kd_unzip *out, struct kd_error *error);
void kd_unzip_finish(struct kd_unzip *zip); /* accepts one that could not be opened */
/* NULL: there is none of this name; of several the first. */
const struct kd_unzip_member *kd_unzip_find(const struct kd_unzip *zip, const char *name);
/* Unpacks a member of at most `most` bytes into *out, which is empty before, and stays so where this fails.
 * KD_EINVAL says what is wrong with it, as the end of a sentence: "is longer than ..."; KD_ENOMEM. */
enum kd_status kd_unzip_take(const struct kd_unzip *zip, const struct kd_unzip_member *member, size_t most,
                             struct kd_buffer *out, struct kd_error *error);

#endif
