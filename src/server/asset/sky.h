/* The operator's photograph of the sky (--sky), which the page offers with a button. */
#ifndef KD_SERVER_ASSET_SKY_H
#define KD_SERVER_ASSET_SKY_H

#include "server/asset/store.h"

/* Stores a PNG file with a panorama as an asset. The caller keeps the reference, which prevents eviction, and
 * releases it before the store is closed. Call this only at the start, because it waits for the disk. Returns
 * KD_EINVAL if the file cannot be read or is not a panorama; the message names the file. */
enum kd_status kd_asset_sky_open(struct kd_asset_store *store, const char *path, struct kd_asset **out,
                                 struct kd_error *error);

#endif
