#include "server/asset/sky.h"

#include "base/read.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>

/* Runs all steps of storing a file. No step waits, because no other thread uses the store yet. *created: true if the
 * store did not have the file before. */
static enum kd_status put(struct kd_asset_store *store, const struct kd_buffer *file, struct kd_asset **out,
                          bool *created, struct kd_error *error)
{
    struct kd_asset_put put;
    enum kd_asset_progress how = KD_ASSET_MORE;
    enum kd_status status =
        kd_asset_put_begin(&put, store, file->data ? file->data : (const uint8_t *)"", file->size, "--sky", error);
    /* Permits eviction of recently used assets, because after a restart all assets count as just used. */
    put.any_age = true;
    while (!status && how != KD_ASSET_OVER)
        status = kd_asset_put_go_on(&put, INFINITY, &how, error);
    kd_asset_put_finish(&put);
    *out = put.asset;
    *created = put.created;
    return status;
}

enum kd_status kd_asset_sky_open(struct kd_asset_store *store, const char *path, struct kd_asset **out,
                                 struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    struct kd_error why = { 0 };
    struct kd_asset *asset = NULL;
    bool created = false;
    if (!kd_read_file(AT_FDCWD, path, 0, KD_ASSET_BYTES, &file))
        return kd_error_set(error, KD_EINVAL, "--sky is %.300s, which cannot be read: %s", path, strerror(errno));
    const enum kd_status status = put(store, &file, &asset, &created, &why);
    kd_buffer_finish(&file);
    if (status)
        return kd_error_set(error, status, "--sky is %.300s: %.500s", path, why.message);
    const struct kd_asset_about *about = kd_asset_about(asset);
    if (kd_asset_is_panorama(about->width, about->height)) {
        *out = asset;
        return KD_OK;
    }
    if (created)
        kd_asset_store_remove(store, asset);
    kd_asset_release(store, asset);
    return kd_error_set(error, KD_EINVAL,
                        "--sky is %.300s; it must be a PNG picture of the whole sky, twice as wide as high, with %d to "
                        "%d rows",
                        path, KD_PANORAMA_LEAST, KD_PANORAMA_MOST);
}
