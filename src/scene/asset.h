/* Assets are files of bytes that a scene refers to but does not contain. A document names an asset either by the
 * SHA-256 of its bytes, or by a name that is known only where the document is read. Before a scene is used, each
 * name is replaced by the hash. A scene, and its picture, is therefore identified by content only. A name never
 * causes a download. Any thread. */
#ifndef KD_SCENE_ASSET_H
#define KD_SCENE_ASSET_H

#include "physics/spacetime/parameters.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>

/* Properties of a grid of matter (render/emit/matter_grid.h). */
struct kd_asset_grid {
    uint32_t nodes[3]; /* number of nodes in r, theta and phi; 0 if the asset is not a grid */
    uint32_t frames;   /* number of frames in time; 1 if the grid shows one moment */
    bool late;         /* true if `time` is the time of ingoing Kerr-Schild coordinates */
    double time[2];    /* times of the first and the last frame, in M */
    double outer;      /* r of the last row of nodes, in M */
    KD_HOLE_MEMBERS    /* parameters of the hole for which the grid was made */
};
/* Properties of an asset. An asset is a picture or a grid of matter. */
struct kd_asset_found {
    char hash[KD_ASSET_NAME];
    uint32_t width, height; /* size of a picture in pixels; 0 if the asset is not a picture */
    struct kd_asset_grid grid;
};
/* The bytes of an asset. They do not change until they are released. */
struct kd_asset_bytes {
    const uint8_t *data;
    size_t size;
    void *held; /* for use by the asset provider only */
};
/* An asset provider: the store of a server, or the files named on a command line. It must outlive its users. Any
 * thread may call its functions. */
struct kd_assets {
    /* Finds an asset by its name or hash. Returns false if there is none. */
    bool (*find)(void *user, const char *name, struct kd_asset_found *out);
    /* Gets the bytes of an asset. Returns false if the asset is no longer available. */
    bool (*take)(void *user, const char *hash, struct kd_asset_bytes *out);
    void (*give_back)(void *user, struct kd_asset_bytes *bytes);
    /* description of the names that a field accepts, for messages, such as "names of --asset NAME=FILE" */
    const char *allowed;
    void *user;
};

/* kd_scene_resolve replaces each name of an asset by its hash, checks that an asset exists for each hash, and sets
 * the scene's `matter`. If an asset is missing or of the wrong kind, the function returns KD_EINVAL with the field's
 * pointer, and *scene stays unchanged. sky.image must be a picture that is twice as wide as high and has
 * KD_PANORAMA_LEAST to KD_PANORAMA_MOST rows. volume.grid must be a grid of matter around a hole of the scene's
 * parameters. */
enum { KD_PANORAMA_LEAST = 16, KD_PANORAMA_MOST = 4096 };
static inline bool kd_asset_is_panorama(uint32_t width, uint32_t height)
{
    return width == 2 * (uint64_t)height && height >= KD_PANORAMA_LEAST && height <= KD_PANORAMA_MOST;
}
/* Returns KD_EINVAL with the pointer /volume/grid if the grid was made for a hole other than the scene's. */
enum kd_status kd_asset_check_grid(const struct kd_asset_grid *grid, const struct kd_scene *scene,
                                   struct kd_error *error);
enum kd_status kd_scene_resolve(struct kd_scene *scene, const struct kd_assets *assets, struct kd_error *error);

#endif
