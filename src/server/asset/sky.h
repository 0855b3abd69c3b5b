/* The operator's photograph of the sky (--sky), which the page offers by one click. */
#ifndef KD_SERVER_ASSET_SKY_H
#define KD_SERVER_ASSET_SKY_H

#include "server/asset/store.h"

/* Stores the PNG file of a panorama as an asset. The caller keeps the reference, so that the asset is never evicted,
 * and releases it before the store is closed. It waits for the disk, so it is for the start. KD_EINVAL: the file cannot
 * be read or is not a panorama; the error names it. */
enum kd_status kd_asset_sky_open(struct kd_asset_store *store, const char *path, struct kd_asset **out,
                                 struct kd_error *error);

#endif
