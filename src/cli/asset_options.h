/* --asset NAME=FILE gives the files that a scene's names of assets stand for. Main thread only. */
#ifndef KD_CLI_ASSET_OPTIONS_H
#define KD_CLI_ASSET_OPTIONS_H

#include "scene/asset.h"

struct kd_named_asset {
    char name[KD_ASSET_NAME];
    const char *path;
    struct kd_asset_found found; /* of the file as it was read; its hash is "" before */
    bool used;                   /* a field of the scene names it */
};
struct kd_asset_options { /* starts zeroed */
    struct kd_named_asset *list;
    size_t n;
    bool later; /* others than the scene may name them too: kd_asset_options_check is called once they have */
};

/* "sky=milky-way.png"; KD_EINVAL says what is wrong with it. */
enum kd_status kd_asset_options_add(struct kd_asset_options *options, const char *text, struct kd_error *error);
/* Reads and checks the files, and puts their hashes in the place of their names. An asset that no field names is an
 * error, as is a field that names none of these. */
enum kd_status kd_asset_options_resolve(struct kd_asset_options *options, struct kd_scene *scene,
                                        struct kd_error *error);
/* KD_EINVAL: nothing names one of them. */
enum kd_status kd_asset_options_check(const struct kd_asset_options *options, struct kd_error *error);
/* The files as a renderer is given them: they are read again when it needs them, and must not have changed. They
 * keep the options' address. */
struct kd_assets kd_asset_options_assets(struct kd_asset_options *options);
void kd_asset_options_finish(struct kd_asset_options *options);

#endif
