#include "server/asset/folder.h"

#include "base/json.h"
#include "base/log.h"
#include "base/read.h"
#include "base/replace.h"
#include "image/png.h"
#include "render/emit/matter_grid.h"
#include "scene/asset.h"
#include "scene/sha256.h"

#include <cjson/cJSON.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define RECORD_MAX ((size_t)4 << 10)
#define FILE_NAME (KD_ASSET_NAME + 8)

static enum kd_status look_at_observation(const void *data, size_t size, struct kd_asset_about *out,
                                          struct kd_error *error)
{
    struct kd_observation observation;
    enum kd_status status = kd_observation_read(data, size, &observation, error);
    if (status)
        return status;
    out->observation = kd_observation_kind_of(data, size);
    out->visibilities = (uint32_t)observation.n, out->stations = observation.stations;
    kd_observation_finish(&observation);
    return KD_OK;
}

enum kd_status kd_asset_look(const void *data, size_t size, struct kd_asset_about *out, struct kd_error *error)
{
    struct kd_png_about png;
    if (size > KD_ASSET_BYTES)
        return kd_error_set(error, KD_EINVAL, "an asset must have at most %zu bytes; this one has %zu", KD_ASSET_BYTES,
                            size);
    if (kd_matter_grid_is(data, size))
        return kd_matter_grid_look(data, size, &out->grid, error);
    if (kd_observation_kind_of(data, size))
        return look_at_observation(data, size, out, error);
    enum kd_status status = kd_png_look(data, size, &png, error);
    if (status)
        return status;
    if ((uint64_t)png.width * png.height > KD_ASSET_PIXELS)
        return kd_error_set(error, KD_EINVAL, "an asset must have at most %llu pixels; this one has %u x %u",
                            (unsigned long long)KD_ASSET_PIXELS, png.width, png.height);
    out->width = png.width;
    out->height = png.height;
    out->bit_depth = png.bit_depth;
    out->channels = png.channels;
    return KD_OK;
}

enum kd_status kd_asset_folder_open(const char *state, int *out, struct kd_error *error)
{
    int parent = open(state, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    *out = -1;
    if (parent >= 0 && (!mkdirat(parent, "assets", 0700) || errno == EEXIST))
        *out = openat(parent, "assets", O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    int cause = errno;
    if (parent >= 0)
        close(parent);
    return *out >= 0 ? KD_OK
                     : kd_error_set(error, KD_EIO, "assets cannot be stored in %.300s: %s", state, strerror(cause));
}

static void name_of(const char *hash, const char *kind, char out[FILE_NAME])
{
    snprintf(out, FILE_NAME, "%.64s.%s", hash, kind);
}

/* Reads the hash at the start of a file's name. Returns false if the name does not belong to an asset. */
static bool hash_of(const char *name, const char *kind, char hash[KD_ASSET_NAME])
{
    snprintf(hash, KD_ASSET_NAME, "%.64s", name);
    return kd_asset_is_hash(hash) && name[64] == '.' && !strcmp(name + 65, kind);
}

static bool read_record(int folder, const char *hash, struct kd_asset_about *out)
{
    char name[FILE_NAME];
    struct kd_buffer text = { 0 };
    name_of(hash, "json", name);
    cJSON *o = kd_read_file(folder, name, O_NOFOLLOW, RECORD_MAX, &text)
                   ? cJSON_ParseWithLength((const char *)text.data, text.size)
                   : NULL;
    const char *token = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(o, "token"));
    const cJSON *format = cJSON_GetObjectItemCaseSensitive(o, "format"),
                *created = cJSON_GetObjectItemCaseSensitive(o, "created");
    bool good = token && strlen(token) == KD_SECRET_TOKEN - 1 && cJSON_IsNumber(format) && format->valuedouble == 1 &&
                cJSON_IsNumber(created);
    if (good) {
        snprintf(out->hash, sizeof out->hash, "%s", hash);
        snprintf(out->token, sizeof out->token, "%s", token);
        out->created = created->valuedouble;
    }
    cJSON_Delete(o);
    kd_buffer_finish(&text);
    return good;
}

/* Extensions of files that hold an asset's bytes. */
static const char *const ends[] = { "png", "npz", "uvfits", "csv" };
enum { ENDS = sizeof ends / sizeof *ends };

static const char *end_of(const struct kd_asset_about *about)
{
    return ends[about->observation == KD_OBSERVATION_CSV      ? 3
                : about->observation == KD_OBSERVATION_UVFITS ? 2
                                                              : about->grid.nodes[0] > 0];
}

/* Reads and checks the bytes of an asset. Returns NULL, or the reason why they are not accepted. */
static const char *read_bytes(int folder, struct kd_asset_about *about, struct kd_buffer *bytes)
{
    char name[FILE_NAME], hash[KD_ASSET_NAME];
    bool read = false;
    for (size_t i = 0; i < ENDS && !read; i++) {
        name_of(about->hash, ends[i], name);
        read = kd_read_file(folder, name, O_NOFOLLOW, KD_ASSET_BYTES, bytes);
    }
    if (!read)
        return "its data cannot be read";
    kd_sha256(bytes->data, bytes->size, hash);
    if (strcmp(hash, about->hash) || kd_asset_look(bytes->data, bytes->size, about, NULL))
        return "its data are damaged";
    about->size = bytes->size;
    return NULL;
}

/* True if an asset has a record. The contents of the record are not checked. */
static bool has_record(int folder, const char *hash)
{
    char name[FILE_NAME];
    struct stat about;
    name_of(hash, "json", name);
    return !fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW);
}

/* True if a server that was killed has left this file, either bytes without a record or an unfinished file. */
static bool is_left_over(int folder, const char *name)
{
    static const char *const kinds[] = { "png", "npz", "uvfits", "csv", "json" };
    char hash[KD_ASSET_NAME], whole[FILE_NAME];
    for (size_t i = 0; i < ENDS; i++)
        if (hash_of(name, ends[i], hash) && !has_record(folder, hash))
            return true;
    snprintf(hash, sizeof hash, "%.64s", name);
    for (size_t i = 0; kd_asset_is_hash(hash) && i < sizeof kinds / sizeof *kinds; i++) {
        name_of(hash, kinds[i], whole);
        if (kd_replace_is_temporary(name, whole))
            return true;
    }
    return false;
}

enum kd_status kd_asset_folder_load(int folder,
                                    void (*found)(void *user, const struct kd_asset_about *about,
                                                  struct kd_buffer *bytes),
                                    void *user, struct kd_error *error)
{
    int fd = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *d = fd < 0 ? NULL : fdopendir(fd);
    if (!d) {
        int cause = errno;
        if (fd >= 0)
            close(fd);
        return kd_error_set(error, KD_EIO, "the folder of assets cannot be read: %s", strerror(cause));
    }
    for (struct dirent *entry; (entry = readdir(d));) {
        struct kd_asset_about about = { 0 };
        struct kd_buffer bytes = { 0 };
        char hash[KD_ASSET_NAME];
        if (is_left_over(folder, entry->d_name))
            unlinkat(folder, entry->d_name, 0);
        if (!hash_of(entry->d_name, "json", hash))
            continue;
        const char *why =
            read_record(folder, hash, &about) ? read_bytes(folder, &about, &bytes) : "its record cannot be read";
        if (why)
            kd_log(KD_LOG_WARN, "asset %.4s... is skipped: %s", hash, why);
        else
            found(user, &about, &bytes);
        kd_buffer_finish(&bytes);
    }
    closedir(d);
    return KD_OK;
}

static enum kd_status write_record(const struct kd_asset_about *about, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "format", 1);
    kd_json_string(&json, "token", about->token);
    kd_json_number(&json, "created", about->created);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

enum kd_status kd_asset_folder_write(int folder, const struct kd_asset_about *about, struct kd_error *error)
{
    char bytes[FILE_NAME], record[FILE_NAME];
    struct kd_buffer text = { 0 };
    name_of(about->hash, end_of(about), bytes);
    name_of(about->hash, "json", record);
    enum kd_status status = write_record(about, &text);
    if (status)
        kd_error_set(error, status, "out of memory for the record of an asset");
    if (!status && (!kd_replace_file_at(folder, bytes, about->data, about->size) ||
                    !kd_replace_file_at(folder, record, text.data, text.size))) {
        int cause = errno;
        status = kd_error_set(error,
                              cause == ENOSPC || cause == EDQUOT || cause == EFBIG    ? KD_EFULL
                              : cause == EMFILE || cause == ENFILE || cause == ENOMEM ? KD_ENOMEM
                                                                                      : KD_EIO,
                              "the asset cannot be stored: %s", strerror(cause));
        kd_asset_folder_remove(folder, about->hash);
    }
    kd_buffer_finish(&text);
    return status;
}

void kd_asset_folder_remove(int folder, const char *hash)
{
    char name[FILE_NAME];
    name_of(hash, "json", name);
    unlinkat(folder, name, 0);
    for (size_t i = 0; i < ENDS; i++) {
        name_of(hash, ends[i], name);
        unlinkat(folder, name, 0);
    }
    fsync(folder);
}
