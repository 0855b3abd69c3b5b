#include "image/unzip.h"

#include <libdeflate.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { END = 22, END64 = 56, LOCATOR = 20, ENTRY = 46, HEADER = 30, COMMENT_MOST = 65535 };
enum { STORED = 0, DEFLATED = 8, ENCRYPTED = 1 };
#define SATURATED 0xffffffffu
#define DENSEST 1032 /* maximum expansion factor of deflate: 258 bytes from two bits (RFC 1951) */

static uint16_t u16(const uint8_t *p) { return (uint16_t)(p[0] | p[1] << 8); }
static uint32_t u32(const uint8_t *p) { return u16(p) | (uint32_t)u16(p + 2) << 16; }
static uint64_t u64(const uint8_t *p) { return u32(p) | (uint64_t)u32(p + 4) << 32; }

static enum kd_status damaged(struct kd_error *error, const char *what)
{
    return kd_error_set(error, KD_EINVAL, "%s", what);
}

/* Finds the end record. Nothing but the record's own comment may follow it. */
static bool find_end(const uint8_t *data, size_t size, size_t *at)
{
    for (size_t n = END; n <= size && n <= END + COMMENT_MOST; n++)
        if (!memcmp(data + size - n, "PK\5\6", 4) && u16(data + size - n + 20) == n - END) {
            *at = size - n;
            return true;
        }
    return false;
}

struct directory {
    uint64_t n, size, at;
    size_t end; /* limit of the end of the directory, as an offset */
};

/* Reads the counts of a ZIP64 file, which are in a separate end record (APPNOTE 4.3.14). A locator before the usual
 * end record points to it. */
static bool read_end64(const uint8_t *data, size_t end, struct directory *out)
{
    if (end < LOCATOR + END64 || memcmp(data + end - LOCATOR, "PK\6\7", 4))
        return false;
    const uint64_t at = u64(data + end - LOCATOR + 8);
    if (at > end - LOCATOR - END64 || memcmp(data + at, "PK\6\6", 4))
        return false;
    const uint8_t *p = data + at;
    *out = (struct directory) { .n = u64(p + 32), .size = u64(p + 40), .at = u64(p + 48), .end = (size_t)at };
    return u64(p + 24) == out->n && !u32(p + 16) && !u32(p + 20);
}

static enum kd_status read_end(const uint8_t *data, size_t size, struct directory *out, struct kd_error *error)
{
    size_t end;
    if (!find_end(data, size, &end))
        return damaged(error, "the file ends before the end of its directory, or has bytes after it");
    const uint8_t *p = data + end;
    *out = (struct directory) { .n = u16(p + 10), .size = u32(p + 12), .at = u32(p + 16), .end = end };
    if (out->n == 0xffff || out->size == SATURATED || out->at == SATURATED) {
        if (!read_end64(data, end, out))
            return damaged(error, "its end record for long files (ZIP64) is missing or incomplete");
    } else if (u16(p + 4) || u16(p + 6) || u16(p + 8) != out->n)
        return damaged(error, "it is split over several disks");
    if (out->n > KD_UNZIP_MEMBERS)
        return kd_error_set(error, KD_EINVAL, "it must have at most %d members; it has %llu", KD_UNZIP_MEMBERS,
                            (unsigned long long)out->n);
    return out->at > out->end || out->size > out->end - out->at ? damaged(error, "its directory is outside the file")
                                                                : KD_OK;
}

/* Reads values that exceed 32 bits from the ZIP64 extra field, which contains them in this order (APPNOTE 4.5.3). */
static bool read_long(const uint8_t *extra, size_t size, struct kd_unzip_member *m)
{
    uint64_t *const wanted[] = { &m->size, &m->packed, &m->at };
    while (size >= 4 && u16(extra) != 1) {
        const size_t n = 4 + (size_t)u16(extra + 2);
        if (n > size)
            return false;
        extra += n;
        size -= n;
    }
    size_t left = size >= 4 && u16(extra + 2) <= size - 4 ? u16(extra + 2) : 0;
    const uint8_t *p = extra + 4;
    for (size_t i = 0; i < 3; i++)
        if (*wanted[i] == SATURATED) {
            if (left < 8)
                return false;
            *wanted[i] = u64(p);
            p += 8;
            left -= 8;
        }
    return true;
}

/* Reads an entry of the directory. Returns its length, or 0 if it is damaged. */
static size_t read_entry(const uint8_t *p, size_t left, struct kd_unzip_member *m)
{
    if (left < ENTRY || memcmp(p, "PK\1\2", 4))
        return 0;
    const size_t name = u16(p + 28), extra = u16(p + 30), comment = u16(p + 32);
    if (left - ENTRY < name + extra + comment)
        return 0;
    *m = (struct kd_unzip_member) { .name = (const char *)p + ENTRY,
                                    .name_size = name,
                                    .flags = u16(p + 8),
                                    .method = u16(p + 10),
                                    .crc = u32(p + 16),
                                    .packed = u32(p + 20),
                                    .size = u32(p + 24),
                                    .at = u32(p + 42) };
    const bool is_long = m->packed == SATURATED || m->size == SATURATED || m->at == SATURATED;
    return !is_long || read_long(p + ENTRY + name, extra, m) ? ENTRY + name + extra + comment : 0;
}

enum kd_status kd_unzip_open(const void *data, size_t size, struct kd_unzip *out, struct kd_error *error)
{
    struct directory directory = { 0 };
    *out = (struct kd_unzip) { .data = data };
    enum kd_status status = read_end(data, size, &directory, error);
    if (status)
        return status;
    out->directory = (size_t)directory.at;
    out->members = calloc((size_t)directory.n + 1, sizeof *out->members);
    if (!out->members)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the directory of a ZIP file");
    size_t done = 0;
    for (; out->n < directory.n; out->n++) {
        const size_t n =
            read_entry(out->data + out->directory + done, (size_t)directory.size - done, &out->members[out->n]);
        if (!n)
            break;
        done += n;
    }
    if (out->n == directory.n && done == directory.size)
        return KD_OK;
    kd_unzip_finish(out);
    return damaged(error, "its directory is damaged, or has another number of entries than it states");
}

void kd_unzip_finish(struct kd_unzip *zip)
{
    free(zip->members);
    *zip = (struct kd_unzip) { 0 };
}

const struct kd_unzip_member *kd_unzip_find(const struct kd_unzip *zip, const char *name)
{
    const size_t size = strlen(name);
    for (size_t i = 0; i < zip->n; i++)
        if (zip->members[i].name_size == size && !memcmp(zip->members[i].name, name, size))
            return &zip->members[i];
    return NULL;
}

/* Returns the data of a member, which follow the member's own header. Returns NULL unless all of the data lie before
 * the directory. */
static const uint8_t *bytes_of(const struct kd_unzip *zip, const struct kd_unzip_member *m)
{
    if (zip->directory < HEADER || m->at > zip->directory - HEADER || memcmp(zip->data + m->at, "PK\3\4", 4))
        return NULL;
    const uint8_t *header = zip->data + m->at;
    const size_t skip = HEADER + (size_t)u16(header + 26) + u16(header + 28), room = zip->directory - (size_t)m->at;
    return skip <= room && m->packed <= room - skip ? header + skip : NULL;
}

static enum kd_status unpack(const struct kd_unzip_member *m, const uint8_t *from, uint8_t *to, struct kd_error *error)
{
    size_t taken = 0;
    if (m->method == STORED) {
        memcpy(to, from, (size_t)m->size);
        return KD_OK;
    }
    struct libdeflate_decompressor *decompressor = libdeflate_alloc_decompressor();
    if (!decompressor)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a member of a ZIP file");
    enum libdeflate_result result =
        libdeflate_deflate_decompress_ex(decompressor, from, (size_t)m->packed, to, (size_t)m->size, &taken, NULL);
    libdeflate_free_decompressor(decompressor);
    return result == LIBDEFLATE_SUCCESS && taken == m->packed ? KD_OK : kd_error_set(error, KD_EINVAL, "is damaged");
}

enum kd_status kd_unzip_take(const struct kd_unzip *zip, const struct kd_unzip_member *m, size_t most,
                             struct kd_buffer *out, struct kd_error *error)
{
    if (m->flags & ENCRYPTED)
        return kd_error_set(error, KD_EINVAL, "is encrypted");
    if (m->method != STORED && m->method != DEFLATED)
        return kd_error_set(error, KD_EINVAL, "is packed with method %u; it must be stored or deflated", m->method);
    if (m->size > most)
        return kd_error_set(error, KD_EINVAL, "has %llu bytes; it must have at most %zu", (unsigned long long)m->size,
                            most);
    const uint8_t *from = bytes_of(zip, m);
    if (!from || (m->method == STORED ? m->packed != m->size : m->size / DENSEST > m->packed))
        return kd_error_set(error, KD_EINVAL, "is damaged: its length differs from that in the directory");
    uint8_t *to = malloc((size_t)m->size + 1);
    if (!to)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a member of a ZIP file");
    enum kd_status status = unpack(m, from, to, error);
    if (!status && libdeflate_crc32(0, to, (size_t)m->size) != m->crc)
        status = kd_error_set(error, KD_EINVAL, "is damaged: its checksum is wrong");
    if (status)
        free(to);
    else
        *out = (struct kd_buffer) { .data = to, .size = (size_t)m->size, .capacity = (size_t)m->size + 1 };
    return status;
}
