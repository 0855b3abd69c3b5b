#include "cli/asset_options.h"

#include "cli/cli.h"
#include "cli/file.h"
#include "image/png.h"
#include "render/emit/matter_grid.h"
#include "scene/asset.h"
#include "scene/sha256.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* limit of a file's size, enough for the largest grid; a server accepts only smaller files */
#define ASSET_MAX ((size_t)1200 << 20)

enum kd_status kd_asset_options_add(struct kd_asset_options *options, const char *text, struct kd_error *error)
{
    size_t length = strcspn(text, "=");
    struct kd_named_asset asset = { .path = text[length] ? text + length + 1 : "" };
    snprintf(asset.name, sizeof asset.name, "%.*s", (int)(length < sizeof asset.name ? length : sizeof asset.name - 1),
             text);
    if (!*asset.path || length >= sizeof asset.name || !kd_asset_is_name(asset.name))
        return kd_error_set(error, KD_EINVAL,
                            "--asset is %.100s; it must be NAME=FILE, as in sky=milky-way.png, where NAME is a letter "
                            "and up to 62 letters, digits, dots, dashes and underscores",
                            text);
    for (size_t i = 0; i < options->n; i++)
        if (!strcmp(options->list[i].name, asset.name))
            return kd_error_set(error, KD_EINVAL, "--asset %s is given twice; each name must be given once",
                                asset.name);
    struct kd_named_asset *list = realloc(options->list, (options->n + 1) * sizeof *list);
    if (!list)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    options->list = list;
    options->list[options->n++] = asset;
    return KD_OK;
}

/* First bytes of other kinds of files that users may mistake for a grid or a picture. */
static const struct {
    const char *begin;
    size_t size;
    const char *kind;
} others[] = {
    { "\x93NUMPY", 6, "an NPY file, which has one array; numpy.savez writes NPZ" },
    { "\x89HDF\r\n\x1a\n", 8, "an HDF5 file" },
    { "SIMPLE  =", 9, "a FITS file" },
    { "\xff\xd8\xff", 3, "a JPEG" },
    { "CDF", 3, "a NetCDF file" },
    { "\x76\x2f\x31\x01", 4, "an OpenEXR file" },
    { "II*\0", 4, "a TIFF" },
    { "MM\0*", 4, "a TIFF" },
    { "#?RADIANCE", 10, "a Radiance file" },
    { "RIFF", 4, "a WebP or another RIFF file" },
    { "GIF8", 4, "a GIF" },
};

/* Detects whether the file is a grid of matter or a picture, and gets its description. */
static enum kd_status look(const void *data, size_t size, struct kd_asset_found *out, struct kd_error *error)
{
    struct kd_png_about about;
    if (kd_matter_grid_is(data, size))
        return kd_matter_grid_look(data, size, &out->grid, error);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (size >= others[i].size && !memcmp(data, others[i].begin, others[i].size))
            return kd_error_set(error, KD_EINVAL,
                                "the file is %s; an asset must be a PNG picture, or a grid of matter as NPZ",
                                others[i].kind);
    enum kd_status status = kd_png_look(data, size, &about, error);
    if (!status) {
        out->width = about.width;
        out->height = about.height;
    }
    return status;
}

static enum kd_status read_asset(struct kd_named_asset *asset, struct kd_error *error)
{
    struct kd_buffer bytes = { 0 };
    enum kd_status status = kd_file_read(asset->path, ASSET_MAX, &bytes, error);
    if (!status && (status = look(bytes.data ? bytes.data : (const uint8_t *)"", bytes.size, &asset->found, error)))
        kd_cli_prefix(error, asset->path);
    if (!status)
        kd_sha256(bytes.data, bytes.size, asset->found.hash);
    kd_buffer_finish(&bytes);
    return status;
}

/* Finds an asset by its name, or by the hash of its bytes. */
static bool find(void *user, const char *name, struct kd_asset_found *out)
{
    struct kd_asset_options *options = user;
    bool is = false;
    for (size_t i = 0; i < options->n; i++) {
        struct kd_named_asset *asset = &options->list[i];
        if (strcmp(asset->name, name) && strcmp(asset->found.hash, name))
            continue;
        *out = asset->found;
        is = asset->used = true;
    }
    return is;
}

static bool take(void *user, const char *hash, struct kd_asset_bytes *out)
{
    const struct kd_asset_options *options = user;
    for (size_t i = 0; i < options->n; i++) {
        struct kd_buffer *bytes = strcmp(options->list[i].found.hash, hash) ? NULL : calloc(1, sizeof *bytes);
        char now[KD_ASSET_NAME] = "";
        if (!bytes)
            continue;
        if (!kd_file_read(options->list[i].path, ASSET_MAX, bytes, NULL))
            kd_sha256(bytes->data, bytes->size, now);
        *out = (struct kd_asset_bytes) { bytes->data, bytes->size, bytes };
        if (!strcmp(now, hash))
            return true;
        kd_buffer_finish(bytes);
        free(bytes);
    }
    return false;
}

static void give_back(void *user, struct kd_asset_bytes *bytes)
{
    (void)user;
    kd_buffer_finish(bytes->held);
    free(bytes->held);
}

struct kd_assets kd_asset_options_assets(struct kd_asset_options *options)
{
    return (struct kd_assets) { find, take, give_back, "null, or the NAME of an --asset NAME=FILE", options };
}

enum kd_status kd_asset_options_resolve(struct kd_asset_options *options, struct kd_scene *scene,
                                        struct kd_error *error)
{
    const struct kd_assets assets = kd_asset_options_assets(options);
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < options->n; i++) {
        options->list[i].used = false;
        KD_TRY(read_asset(&options->list[i], error));
    }
    KD_TRY(kd_scene_resolve(scene, &assets, error));
    if (!options->later)
        KD_TRY(kd_asset_options_check(options, error));
done:
    return status;
}

enum kd_status kd_asset_options_check(const struct kd_asset_options *options, struct kd_error *error)
{
    for (size_t i = 0; i < options->n; i++)
        if (!options->list[i].used)
            return kd_error_set(error, KD_EINVAL,
                                "--asset %s cannot be used, because no field of the scene refers to this name",
                                options->list[i].name);
    return KD_OK;
}

void kd_asset_options_finish(struct kd_asset_options *options)
{
    free(options->list);
    *options = (struct kd_asset_options) { 0 };
}
