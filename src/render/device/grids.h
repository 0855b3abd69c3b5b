/* Matter on a grid, on the device: reads volume.grid and uploads it when the asset has changed
 * (kd_emitter_buffers_plasma of render/emit/own.h). The renderer keeps the descriptions of recent grids without their
 * nodes. Render thread only. */
#ifndef KD_RENDER_DEVICE_GRIDS_H
#define KD_RENDER_DEVICE_GRIDS_H

#include "render/emit/matter_grid.h"
#include "scene/scene.h"

enum { KD_GRIDS = 8 };
struct kd_grids {
    struct kd_cached_documents_grid {
        char of[KD_ASSET_NAME];     /* the asset's hash; "": the slot is free */
        struct kd_matter_grid grid; /* nodes and places: present until uploaded, up to 80 MiB; otherwise NULL */
    } entries[KD_GRIDS];
    uint32_t n; /* number of grids read so far; the next one replaces the oldest */
};
void kd_grids_finish(struct kd_grids *grids);

#endif
