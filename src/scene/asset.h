/* Assets are bytes that a scene names and does not hold. A document names one by the SHA-256 of its bytes or by a
 * name that whoever reads the document knows it by; a name is resolved into the hash before the scene is used, so
 * that the identity of a scene, and of its picture, is the content. Nothing is ever fetched for a name. Any thread. */
#ifndef KD_SCENE_ASSET_H
#define KD_SCENE_ASSET_H

#include "scene/scene.h"

#include <stddef.h>

/* A hash is 64 hexadecimal digits, lower case. */
bool kd_asset_is_hash(const char *text);
/* A name is a letter, and up to 62 letters, digits, dots, dashes and underscores; not "null", which names none. */
bool kd_asset_is_name(const char *text);

/* What is known of an asset, a picture or a grid of matter (render/emit/matter_grid.h). */
struct kd_asset_found {
    char hash[KD_ASSET_NAME];
    uint32_t width, height; /* of a picture; 0: it is none */
    uint32_t nodes[3];      /* of a grid, in r, theta and phi; 0: it is none */
    double spin;            /* that a grid is made for */
};
/* Bytes that are held, and stay as they are, until they are given back. */
struct kd_asset_bytes {
    const uint8_t *data;
    size_t size;
    void *held; /* the keeper's */
};
/* Whoever keeps assets: a server's store, the files of a command line. It outlives those who ask. Its functions may
 * be called by any thread. */
struct kd_assets {
    bool (*find)(void *user, const char *name,
                 struct kd_asset_found *out); /* by a name or a hash; false: it is not here */
    bool (*take)(void *user, const char *hash, struct kd_asset_bytes *out); /* false: no longer */
    void (*give_back)(void *user, struct kd_asset_bytes *bytes);
    const char *allowed; /* what a field may name, for a sentence: "names of --asset NAME=FILE" */
    void *user;
};

/* Puts the hash in the place of each name; hashes are looked up too. KD_EINVAL with the field's pointer, and *scene
 * unchanged, where an asset is not here, or is not what the field takes: sky.image is a picture twice as wide as
 * high, of KD_PANORAMA_LEAST to KD_PANORAMA_MOST rows, volume.grid a grid of matter round a hole of the scene's
 * spin. */
enum { KD_PANORAMA_LEAST = 16, KD_PANORAMA_MOST = 4096 };
static inline bool kd_asset_is_panorama(uint32_t width, uint32_t height)
{
    return width == 2 * (uint64_t)height && height >= KD_PANORAMA_LEAST && height <= KD_PANORAMA_MOST;
}
/* KD_EINVAL at /volume/grid: a grid that is made for this spin is none for the scene's. */
enum kd_status kd_asset_check_grid(double spin, const struct kd_scene *scene, struct kd_error *error);
enum kd_status kd_scene_resolve(struct kd_scene *scene, const struct kd_assets *assets, struct kd_error *error);

#endif
