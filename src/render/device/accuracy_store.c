#include "render/device/accuracy_store.h"

#include "base/log.h"
#include "base/read.h"
#include "base/replace.h"
#include "render/device/device_internal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAKE "`kerrd bench accuracy` makes one"
#define FILE_MAX (1u << 20) /* largest size of the file; a table has about 100 000 bytes */

char *kd_accuracy_path(const struct kd_renderer *renderer)
{
    return kd_renderer_cache_file(renderer, ".accuracy.json");
}

enum kd_status kd_accuracy_save(const struct kd_accuracy_table *table, const char *path, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = KD_OK;
    if (kd_accuracy_to_json(table, &text))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the accuracy table");
    else if (!kd_replace_file(path, text.data, text.size))
        status = kd_error_set(error, KD_EIO, "cannot write %s: %s", path, strerror(errno));
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status read_file(const char *path, struct kd_buffer *out, struct kd_error *error)
{
    if (kd_read_file(AT_FDCWD, path, 0, FILE_MAX, out))
        return KD_OK;
    if (errno == ENOENT)
        return kd_error_set(error, KD_EIO, "there is no accuracy table of this device yet: " MAKE);
    if (errno == ENOMEM)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the accuracy table");
    kd_log(KD_LOG_WARN, "cannot read %s: %s", path, strerror(errno));
    return kd_error_set(error, KD_EIO, "the accuracy table of this device cannot be read (%s); " MAKE, strerror(errno));
}

/* Reads the file, and checks that its content is a valid table. */
static enum kd_status load(const char *path, struct kd_buffer *text, struct kd_accuracy_table *table,
                           struct kd_error *error)
{
    if (!path)
        return kd_error_set(error, KD_EIO,
                            "there is no folder for an accuracy table: neither XDG_CACHE_HOME nor HOME is set");
    enum kd_status status = read_file(path, text, error);
    if (!status && kd_accuracy_from_json((const char *)text->data, text->size, table, NULL))
        status =
            kd_error_set(error, KD_EINVAL, "the accuracy table of this device is damaged or of another version: " MAKE);
    return status;
}

enum kd_status kd_accuracy_load(const char *path, struct kd_accuracy_table *out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = load(path, &text, out, error);
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_renderer_accuracy_json(const struct kd_renderer *renderer, struct kd_buffer *out,
                                         struct kd_error *error)
{
    struct kd_accuracy_table *table = malloc(sizeof *table);
    struct kd_buffer text = { 0 };
    char *path = kd_accuracy_path(renderer);
    enum kd_status status = table ? load(path, &text, table, error)
                                  : kd_error_set(error, KD_ENOMEM, "out of memory for the accuracy table");
    if (!status && kd_buffer_append(out, text.data, text.size))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the accuracy table");
    kd_buffer_finish(&text);
    free(path);
    free(table);
    return status;
}
