/* Options --asset NAME=FILE: files for the assets that a scene uses by name. Main thread only. */
#ifndef KD_CLI_ASSET_OPTIONS_H
#define KD_CLI_ASSET_OPTIONS_H

#include "scene/asset.h"

struct kd_named_asset {
    char name[KD_ASSET_NAME];
    const char *path;
    struct kd_asset_found found; /* of the file as read; its hash is "" before that */
    bool used;                   /* a field of the scene uses it */
};
struct kd_asset_options { /* initialise to 0 */
    struct kd_named_asset *list;
    size_t n;
    bool later; /* documents besides the scene may use assets; kd_asset_options_check is then called after them */
};

/* Adds an option, such as "sky=milky-way.png". Returns KD_EINVAL with a message if it is malformed. */
enum kd_status kd_asset_options_add(struct kd_asset_options *options, const char *text, struct kd_error *error);
/* Reads and checks the files, and replaces their names in the scene by their hashes. An asset that no field uses is an
 * error, and so is a field that names an asset without a file. */
enum kd_status kd_asset_options_resolve(struct kd_asset_options *options, struct kd_scene *scene,
                                        struct kd_error *error);
/* Returns KD_EINVAL if an asset is unused. */
enum kd_status kd_asset_options_check(const struct kd_asset_options *options, struct kd_error *error);
/* The files as a renderer's assets. It reads them again when it needs them; they must not have changed. The result
 * refers to options. */
struct kd_assets kd_asset_options_assets(struct kd_asset_options *options);
void kd_asset_options_finish(struct kd_asset_options *options);

#endif
