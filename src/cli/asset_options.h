/* --asset NAME=FILE gives the files that a scene's names of assets stand for. Main thread only. */
#ifndef KD_CLI_ASSET_OPTIONS_H
#define KD_CLI_ASSET_OPTIONS_H

#include "scene/scene.h"

struct kd_named_asset {
    char name[KD_ASSET_NAME];
    const char *path;
};
struct kd_asset_options { /* starts zeroed */
    struct kd_named_asset *list;
    size_t n;
};

/* "sky=milky-way.png"; KD_EINVAL says what is wrong with it. */
enum kd_status kd_asset_options_add(struct kd_asset_options *options, const char *text, struct kd_error *error);
/* Reads and checks the files, and puts their hashes in the place of their names. An asset that no field names is an error, as is a field
 * that names none of these. */
enum kd_status kd_asset_options_resolve(const struct kd_asset_options *options, struct kd_scene *scene, struct kd_error *error);
void kd_asset_options_finish(struct kd_asset_options *options);

#endif
