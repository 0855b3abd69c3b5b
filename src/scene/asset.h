/* Assets are files of bytes that a scene refers to but does not contain. A document names one by the SHA-256 of its
 * bytes, or by a name known to the reader of the document. A name is resolved to the hash before the scene is used,
 * so that the identity of a scene, and of its picture, depends on the content only. Names never cause a download.
 * Any thread. */
#ifndef KD_SCENE_ASSET_H
#define KD_SCENE_ASSET_H

#include "scene/scene.h"

#include <stddef.h>

/* A hash is 64 hexadecimal digits, lower case. */
bool kd_asset_is_hash(const char *text);
/* A name is a letter and up to 62 letters, digits, dots, dashes and underscores; "null" is not a name. */
bool kd_asset_is_name(const char *text);

/* What is known of an asset: a picture, or a grid of matter (render/emit/matter_grid.h). */
struct kd_asset_found {
    char hash[KD_ASSET_NAME];
    uint32_t width, height; /* of a picture; 0: it is not a picture */
    uint32_t nodes[3];      /* of a grid, in r, theta and phi; 0: it is not a grid */
    double spin;            /* spin that a grid was made for */
};
/* Bytes of an asset, unchanged until they are given back. */
struct kd_asset_bytes {
    const uint8_t *data;
    size_t size;
    void *held; /* private to the asset provider */
};
/* Asset provider: a server's store, or the files of a command line. It outlives its users. Its functions may be
 * called by any thread. */
struct kd_assets {
    /* Finds an asset by name or hash; false if there is none. */
    bool (*find)(void *user, const char *name, struct kd_asset_found *out);
    bool (*take)(void *user, const char *hash, struct kd_asset_bytes *out); /* false: no longer available */
    void (*give_back)(void *user, struct kd_asset_bytes *bytes);
    const char *allowed; /* what a field may name, for a message: "names of --asset NAME=FILE" */
    void *user;
};

/* Replaces each name by the hash, and checks that each hash exists. KD_EINVAL with the field's pointer, and *scene
 * unchanged, if an asset is missing or of the wrong kind. sky.image is a picture twice as wide as high, of
 * KD_PANORAMA_LEAST to KD_PANORAMA_MOST rows. volume.grid is a grid of matter round a hole of the scene's spin. */
enum { KD_PANORAMA_LEAST = 16, KD_PANORAMA_MOST = 4096 };
static inline bool kd_asset_is_panorama(uint32_t width, uint32_t height)
{
    return width == 2 * (uint64_t)height && height >= KD_PANORAMA_LEAST && height <= KD_PANORAMA_MOST;
}
/* KD_EINVAL at /volume/grid if a grid made for this spin does not fit the scene's. */
enum kd_status kd_asset_check_grid(double spin, const struct kd_scene *scene, struct kd_error *error);
enum kd_status kd_scene_resolve(struct kd_scene *scene, const struct kd_assets *assets, struct kd_error *error);

#endif
