/* Matter on a grid, on the host and on the device. Reads volume.grid, and uploads it when the asset has changed
 * (kd_emitter_buffers_plasma of render/emit/own.h). A thread reads the grids (asset_reader.h). The descriptions of
 * recent grids stay cached, without their nodes. Any thread, unless stated otherwise. */
#ifndef KD_RENDER_DEVICE_GRIDS_H
#define KD_RENDER_DEVICE_GRIDS_H

#include "base/error.h"
#include "render/device/asset_reader.h"
#include "render/emit/matter_grid.h"
#include "scene/asset.h"

struct kd_cached_grid {
    char of[KD_ASSET_NAME];     /* the asset's hash; "": the slot is free */
    struct kd_matter_grid grid; /* nodes: up to 512 MiB, places: up to 16 MiB; NULL after they are uploaded */
    uint64_t used;              /* value of a counter at the last use, to find the least recently used grid */
};
/* KD_GRIDS: number of cached descriptions. KD_GRIDS_READ: maximum number of grids whose nodes wait to be uploaded. */
enum { KD_GRIDS = 8, KD_GRIDS_READ = 2 };

struct kd_grids {
    struct kd_asset_reader reader; /* its lock protects all members below */
    struct kd_cached_grid entries[KD_GRIDS];
    struct kd_matter_grid made; /* grid made by the reader's thread, which then caches it */
    uint64_t used;
    char uploaded[KD_ASSET_NAME];   /* hash of the grid that was last found on the device; "": no grid */
    const struct kd_assets *assets; /* NULL: there are no assets */
    bool blank; /* true on a device that only compiles: no file is read, and every grid has a few empty nodes */
};
void kd_grids_init(struct kd_grids *grids, const struct kd_assets *assets, void (*made)(void *user), void *user);

/* Starts reading the grid of a scene, if the scene has a grid that is neither cached nor on the device. Returns whether
 * the reading is in progress. A waiting client calls this function repeatedly; if the grid was evicted meanwhile, it is
 * read once more. */
bool kd_grid_begin(struct kd_grids *grids, const struct kd_scene *scene);
/* Waits for the grid in progress and drops all other requests. `made` is not called again before a new request. */
void kd_grids_stop(struct kd_grids *grids);
/* Frees the nodes that wait to be uploaded, unless a grid is being read. */
void kd_grids_rest(struct kd_grids *grids);
void kd_grids_finish(struct kd_grids *grids);

#endif
