#include "image/zip.h"

#include <archive.h>
#include <archive_entry.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct kd_zip {
    struct archive *archive;
    struct archive_entry *entry;
    struct kd_buffer *out;
};

static la_ssize_t keep(struct archive *archive, void *user, const void *data, size_t size)
{
    if (!kd_buffer_append(user, data, size))
        return (la_ssize_t)size;
    archive_set_error(archive, ENOMEM, "out of memory");
    return -1;
}

enum kd_status kd_zip_create(struct kd_buffer *out, bool deflated, struct kd_zip **zip)
{
    struct kd_zip *z = calloc(1, sizeof *z);
    *zip = NULL;
    if (!z)
        return KD_ENOMEM;
    z->out = out;
    z->archive = archive_write_new();
    z->entry = archive_entry_new();
    if (!z->archive || !z->entry || archive_write_set_format_zip(z->archive) != ARCHIVE_OK ||
        (deflated ? archive_write_zip_set_compression_deflate : archive_write_zip_set_compression_store)(z->archive) !=
            ARCHIVE_OK ||
        archive_write_set_bytes_per_block(z->archive, 0) != ARCHIVE_OK ||
        archive_write_open(z->archive, out, NULL, keep, NULL) != ARCHIVE_OK) {
        kd_zip_destroy(z);
        return KD_ENOMEM;
    }
    *zip = z;
    return KD_OK;
}

enum kd_status kd_zip_begin(struct kd_zip *zip, const char *name, uint64_t size)
{
    archive_entry_clear(zip->entry);
    archive_entry_set_pathname(zip->entry, name);
    archive_entry_set_size(zip->entry, (la_int64_t)size);
    archive_entry_set_filetype(zip->entry, AE_IFREG);
    archive_entry_set_perm(zip->entry, 0644);
    return archive_write_header(zip->archive, zip->entry) == ARCHIVE_OK ? KD_OK : KD_ENOMEM;
}

enum kd_status kd_zip_append(struct kd_zip *zip, const void *data, size_t size)
{
    for (size_t done = 0; done < size;) {
        la_ssize_t n = archive_write_data(zip->archive, (const char *)data + done, size - done);
        if (n <= 0)
            return KD_ENOMEM;
        done += (size_t)n;
    }
    return KD_OK;
}

enum kd_status kd_zip_add(struct kd_zip *zip, const char *name, const void *data, size_t size)
{
    enum kd_status status = kd_zip_begin(zip, name, size);
    return status ? status : kd_zip_append(zip, data, size);
}

enum kd_status kd_zip_close(struct kd_zip *zip)
{
    return archive_write_close(zip->archive) == ARCHIVE_OK ? KD_OK : KD_ENOMEM;
}

void kd_zip_destroy(struct kd_zip *zip)
{
    if (!zip)
        return;
    archive_write_free(zip->archive);
    archive_entry_free(zip->entry);
    free(zip);
}

static enum kd_status take(struct archive *archive, size_t most, struct kd_buffer *out)
{
    char part[4096];
    la_ssize_t n;
    size_t all = 0;
    while ((n = archive_read_data(archive, part, sizeof part)) > 0) {
        all += (size_t)n;
        if (all > most)
            return KD_EINVAL;
        if (kd_buffer_append(out, part, (size_t)n))
            return KD_ENOMEM;
    }
    return n < 0 ? KD_EINVAL : KD_OK;
}

/* Members are found by the directory at the end alone: libarchive's reader of streams inflates whatever it passes
 * over, which may be a thousand times as long as the file. NULL: no memory. */
static struct archive *open_directory(const void *data, size_t size)
{
    struct archive *archive = archive_read_new();
    if (archive && archive_read_support_format_zip_seekable(archive) == ARCHIVE_OK)
        archive_read_open_memory(archive, data, size); /* what is no ZIP file has no members */
    return archive;
}

/* Goes to the member of this name, if it is among the first MEMBERS. */
static bool go_to(struct archive *archive, const char *name)
{
    enum { MEMBERS = 1024 };
    struct archive_entry *entry;
    for (int n = 0; n < MEMBERS && archive_read_next_header(archive, &entry) == ARCHIVE_OK; n++) {
        const char *path = archive_entry_pathname(entry);
        if (path && !strcmp(path, name))
            return true;
    }
    return false;
}

enum kd_status kd_zip_find(const void *data, size_t size, const char *name, size_t most, struct kd_buffer *out)
{
    struct archive *archive = open_directory(data, size);
    enum kd_status status = !archive ? KD_ENOMEM : go_to(archive, name) ? take(archive, most, out) : KD_EINVAL;
    archive_read_free(archive);
    return status;
}

bool kd_zip_has(const void *data, size_t size, const char *name)
{
    struct archive *archive = open_directory(data, size);
    const bool there = archive && go_to(archive, name);
    archive_read_free(archive);
    return there;
}
