#include "image/zip.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

enum { LEVEL = 6 };
#define SATURATED 0xffffffffu /* value of a 32-bit field that means: see the ZIP64 extra field (APPNOTE 4.4.8) */
#define FIRST_DAY 0x21        /* 1 January 1980, the earliest date that the format can store */
#define FILE_MODE (0100644u << 16)

struct entry {
    char *name;
    uint64_t size, packed, at; /* size, packed: bytes before and after compression; at: offset of the member's header */
    uint32_t crc;
    bool deflated, streamed; /* streamed: true if the checksum follows the data instead of preceding them */
};

struct kd_zip {
    struct kd_buffer *out;
    bool deflated;
    uint64_t at, left; /* at: bytes written so far; left: bytes that the open member still lacks */
    struct entry *entries;
    size_t n, room;
};

/* Builds one record from little-endian fields. */
struct record {
    uint8_t bytes[80];
    size_t size;
};

static void put(struct record *r, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        r->bytes[r->size++] = (uint8_t)(value >> 8 * i);
}

static uint32_t saturate(uint64_t value) { return value < SATURATED ? (uint32_t)value : SATURATED; }

static enum kd_status emit(struct kd_zip *zip, const void *data, size_t size)
{
    enum kd_status status = kd_buffer_append(zip->out, data, size);
    if (!status)
        zip->at += size;
    return status;
}

static bool is_long(const struct entry *e) { return e->size >= SATURATED || e->packed >= SATURATED; }

/* The fields that both headers of a member contain, from the version needed for reading to the length of the name
 * (APPNOTE 4.3.7 and 4.3.12). */
static void put_common(struct record *r, const struct entry *e, bool directory)
{
    put(r, is_long(e) || e->at >= SATURATED ? 45 : 20, 2);
    put(r, e->streamed ? 8 : 0, 2);
    put(r, e->deflated ? 8 : 0, 2);
    put(r, 0, 2);
    put(r, FIRST_DAY, 2);
    put(r, directory || !e->streamed ? e->crc : 0, 4);
    put(r, saturate(e->packed), 4);
    put(r, saturate(e->size), 4);
    put(r, strlen(e->name), 2);
}

static enum kd_status put_header(struct kd_zip *zip, const struct entry *e)
{
    struct record r = { 0 }, extra = { 0 };
    enum kd_status status;
    if (is_long(e)) { /* a member's own header must contain both sizes (APPNOTE 4.5.3) */
        put(&extra, 1, 2);
        put(&extra, 16, 2);
        put(&extra, e->size, 8);
        put(&extra, e->packed, 8);
    }
    put(&r, 0x04034b50, 4);
    put_common(&r, e, false);
    put(&r, extra.size, 2);
    KD_TRY(emit(zip, r.bytes, r.size));
    KD_TRY(emit(zip, e->name, strlen(e->name)));
    KD_TRY(emit(zip, extra.bytes, extra.size));
done:
    return status;
}

static enum kd_status put_descriptor(struct kd_zip *zip, const struct entry *e)
{
    struct record r = { 0 };
    put(&r, 0x08074b50, 4);
    put(&r, e->crc, 4);
    put(&r, e->packed, is_long(e) ? 8 : 4);
    put(&r, e->size, is_long(e) ? 8 : 4);
    return emit(zip, r.bytes, r.size);
}

static enum kd_status put_directory_entry(struct kd_zip *zip, const struct entry *e)
{
    struct record r = { 0 }, extra = { 0 };
    enum kd_status status;
    put(&extra, 1, 2);
    put(&extra, 0, 2);
    if (e->size >= SATURATED)
        put(&extra, e->size, 8);
    if (e->packed >= SATURATED)
        put(&extra, e->packed, 8);
    if (e->at >= SATURATED)
        put(&extra, e->at, 8);
    extra.bytes[2] = (uint8_t)(extra.size - 4);
    if (extra.size == 4)
        extra.size = 0;
    put(&r, 0x02014b50, 4);
    put(&r, 3 << 8 | 45, 2); /* made on Unix */
    put_common(&r, e, true);
    put(&r, extra.size, 2);
    /* three fields that are 0: the length of the comment, the disk number and the internal attributes */
    put(&r, 0, 2 + 2 + 2);
    put(&r, FILE_MODE, 4);
    put(&r, saturate(e->at), 4);
    KD_TRY(emit(zip, r.bytes, r.size));
    KD_TRY(emit(zip, e->name, strlen(e->name)));
    KD_TRY(emit(zip, extra.bytes, extra.size));
done:
    return status;
}

/* Writes the end records (APPNOTE 4.3.14 to 4.3.16). */
static enum kd_status put_end(struct kd_zip *zip, uint64_t directory)
{
    struct record r = { 0 };
    const uint64_t size = zip->at - directory, end = zip->at;
    enum kd_status status;
    if (zip->n >= 0xffff || size >= SATURATED || directory >= SATURATED) {
        put(&r, 0x06064b50, 4);
        put(&r, 44, 8);
        put(&r, 3 << 8 | 45, 2);
        put(&r, 45, 2);
        put(&r, 0, 8);
        put(&r, zip->n, 8);
        put(&r, zip->n, 8);
        put(&r, size, 8);
        put(&r, directory, 8);
        put(&r, 0x07064b50, 4);
        put(&r, 0, 4);
        put(&r, end, 8);
        put(&r, 1, 4);
        KD_TRY(emit(zip, r.bytes, r.size));
        r.size = 0;
    }
    put(&r, 0x06054b50, 4);
    put(&r, 0, 4);
    put(&r, zip->n < 0xffff ? zip->n : 0xffff, 2);
    put(&r, zip->n < 0xffff ? zip->n : 0xffff, 2);
    put(&r, saturate(size), 4);
    put(&r, saturate(directory), 4);
    put(&r, 0, 2);
    KD_TRY(emit(zip, r.bytes, r.size));
done:
    return status;
}

enum kd_status kd_zip_create(struct kd_buffer *out, bool deflated, struct kd_zip **zip)
{
    *zip = calloc(1, sizeof **zip);
    if (!*zip)
        return KD_ENOMEM;
    (*zip)->out = out;
    (*zip)->deflated = deflated;
    return KD_OK;
}

/* Appends an entry to the directory. Returns NULL when out of memory. */
static struct entry *enter(struct kd_zip *zip, const char *name)
{
    if (zip->n == zip->room) {
        const size_t room = zip->room ? 2 * zip->room : 16;
        struct entry *more = realloc(zip->entries, room * sizeof *more);
        if (!more)
            return NULL;
        zip->entries = more;
        zip->room = room;
    }
    struct entry *e = &zip->entries[zip->n];
    *e = (struct entry) { .name = strdup(name), .at = zip->at };
    if (!e->name)
        return NULL;
    zip->n++;
    return e;
}

enum kd_status kd_zip_begin(struct kd_zip *zip, const char *name, uint64_t size)
{
    struct entry *e = enter(zip, name);
    if (!e)
        return KD_ENOMEM;
    e->size = e->packed = zip->left = size;
    e->streamed = true;
    enum kd_status status = put_header(zip, e);
    return status || size ? status : put_descriptor(zip, e);
}

enum kd_status kd_zip_append(struct kd_zip *zip, const void *data, size_t size)
{
    struct entry *e = &zip->entries[zip->n - 1];
    enum kd_status status = emit(zip, data, size);
    if (status || !size)
        return status;
    e->crc = libdeflate_crc32(e->crc, data, size);
    zip->left -= size;
    return zip->left ? KD_OK : put_descriptor(zip, e);
}

enum kd_status kd_zip_pass_over(struct kd_zip *zip)
{
    if (!zip->left)
        return KD_OK;
    zip->at += zip->left;
    zip->left = 0;
    return put_descriptor(zip, &zip->entries[zip->n - 1]);
}

/* Compresses the data by deflate. Returns false if the result is not smaller, or when out of memory. The caller
 * frees *out. */
static bool deflate(const void *data, size_t size, void **out, size_t *packed)
{
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    *out = compressor && size ? malloc(size) : NULL;
    *packed = *out ? libdeflate_deflate_compress(compressor, data, size, *out, size) : 0;
    libdeflate_free_compressor(compressor);
    return *packed;
}

enum kd_status kd_zip_add(struct kd_zip *zip, const char *name, const void *data, size_t size)
{
    struct entry *e = enter(zip, name);
    void *packed = NULL;
    size_t n = size;
    enum kd_status status;
    if (!e)
        return KD_ENOMEM;
    e->deflated = zip->deflated && deflate(data, size, &packed, &n);
    e->size = size;
    e->packed = e->deflated ? n : size;
    e->crc = libdeflate_crc32(0, data, size);
    KD_TRY(put_header(zip, e));
    KD_TRY(emit(zip, e->deflated ? packed : data, (size_t)e->packed));
done:
    free(packed);
    return status;
}

enum kd_status kd_zip_close(struct kd_zip *zip)
{
    const uint64_t directory = zip->at;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < zip->n; i++)
        KD_TRY(put_directory_entry(zip, &zip->entries[i]));
    KD_TRY(put_end(zip, directory));
done:
    return status;
}

void kd_zip_destroy(struct kd_zip *zip)
{
    if (!zip)
        return;
    for (size_t i = 0; i < zip->n; i++)
        free(zip->entries[i].name);
    free(zip->entries);
    free(zip);
}
