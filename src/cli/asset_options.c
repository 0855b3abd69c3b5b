#include "cli/asset_options.h"

#include "cli/cli.h"
#include "cli/file.h"
#include "image/png.h"
#include "scene/asset.h"
#include "scene/sha256.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ASSET_MAX ((size_t)256 << 20) /* bytes of one: one's own files, larger than a server takes */

enum kd_status kd_asset_options_add(struct kd_asset_options *options, const char *text, struct kd_error *error)
{
    size_t length = strcspn(text, "=");
    struct kd_named_asset asset = { .path = text[length] ? text + length + 1 : "" };
    snprintf(asset.name, sizeof asset.name, "%.*s", (int)(length < sizeof asset.name ? length : sizeof asset.name - 1), text);
    if (!*asset.path || length >= sizeof asset.name || !kd_asset_is_name(asset.name))
        return kd_error_set(error, KD_EINVAL, "--asset %.100s: it takes NAME=FILE, as in sky=milky-way.png; a name is a letter and up to 62 letters, "
                            "digits, dots, dashes and underscores", text);
    for (size_t i = 0; i < options->n; i++)
        if (!strcmp(options->list[i].name, asset.name))
            return kd_error_set(error, KD_EINVAL, "--asset %s: this name is given twice", asset.name);
    struct kd_named_asset *list = realloc(options->list, (options->n + 1) * sizeof *list);
    if (!list)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    options->list = list;
    options->list[options->n++] = asset;
    return KD_OK;
}

static enum kd_status read_asset(const char *path, char hash[KD_ASSET_NAME], struct kd_error *error)
{
    struct kd_buffer bytes = { 0 };
    struct kd_png_about about;
    enum kd_status status = kd_file_read(path, ASSET_MAX, &bytes, error);
    if (!status && (status = kd_png_look(bytes.data ? bytes.data : (const uint8_t *)"", bytes.size, &about, error)))
        kd_cli_prefix(error, path);
    if (!status)
        kd_sha256(bytes.data, bytes.size, hash);
    kd_buffer_finish(&bytes);
    return status;
}

struct known {
    const struct kd_asset_options *options;
    struct {
        char hash[KD_ASSET_NAME];
        bool used; /* a field of the scene names it */
    } *of;
};

/* By its name, or by the hash of its bytes. */
static bool find(void *user, const char *name, char hash[KD_ASSET_NAME])
{
    struct known *known = user;
    bool found = false;
    for (size_t i = 0; i < known->options->n; i++) {
        if (strcmp(known->options->list[i].name, name) && strcmp(known->of[i].hash, name))
            continue;
        snprintf(hash, KD_ASSET_NAME, "%s", known->of[i].hash);
        found = known->of[i].used = true;
    }
    return found;
}

enum kd_status kd_asset_options_resolve(const struct kd_asset_options *options, struct kd_scene *scene, struct kd_error *error)
{
    struct known known = { options, calloc(options->n + 1, sizeof *known.of) };
    enum kd_status status;
    if (!known.of)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    for (size_t i = 0; i < options->n; i++)
        KD_TRY(read_asset(options->list[i].path, known.of[i].hash, error));
    KD_TRY(kd_scene_resolve(scene, find, &known, error));
    for (size_t i = 0; i < options->n; i++)
        if (!known.of[i].used)
            KD_TRY(kd_error_set(error, KD_EINVAL, "--asset %s: no field of the scene names it", options->list[i].name));
done:
    free(known.of);
    return status;
}

void kd_asset_options_finish(struct kd_asset_options *options)
{
    free(options->list);
    *options = (struct kd_asset_options) { 0 };
}
