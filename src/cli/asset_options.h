/* The options --asset NAME=FILE: each gives the file of an asset that a scene uses by name. Main thread only. */
#ifndef KD_CLI_ASSET_OPTIONS_H
#define KD_CLI_ASSET_OPTIONS_H

#include "scene/asset.h"

struct kd_named_asset {
    char name[KD_ASSET_NAME];
    const char *path;
    struct kd_asset_found found; /* description of the file's contents; its hash is "" until the file is read */
    bool used;                   /* true if a field of the scene uses this asset */
};
struct kd_asset_options { /* initialise to 0 */
    struct kd_named_asset *list;
    size_t n;
    /* true if documents that are read later may use assets; the caller reads them before kd_asset_options_check */
    bool later;
};

/* Adds an option, such as "sky=milky-way.png". Returns KD_EINVAL with a message if it is malformed. */
enum kd_status kd_asset_options_add(struct kd_asset_options *options, const char *text, struct kd_error *error);
/* Reads and checks the files, and replaces the names of assets in the scene by the hashes of the files. Two cases
 * are errors: no field uses an asset, or a field names an asset without a file. */
enum kd_status kd_asset_options_resolve(struct kd_asset_options *options, struct kd_scene *scene,
                                        struct kd_error *error);
/* Returns KD_EINVAL if an asset is not used. */
enum kd_status kd_asset_options_check(const struct kd_asset_options *options, struct kd_error *error);
/* Makes assets for a renderer from the files. The renderer reads a file again when it needs it, so the file must not
 * change. The result points into options. */
struct kd_assets kd_asset_options_assets(struct kd_asset_options *options);
void kd_asset_options_finish(struct kd_asset_options *options);

#endif
