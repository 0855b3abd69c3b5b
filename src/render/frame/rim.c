/* Uploads the rim of the shadow for the star search (view/rim.h): directions of its rays, and tables of its layout. */
#include "render/frame/job.h"

#include "render/view/rim_sky.h"

#include <string.h>

void kd_frame_find_rim(struct kd_frame_job *j)
{
    struct kd_lens_map *map = j->lens;
    if (!map->rim_known) {
        kd_rim_of(j->scene, &map->rim);
        kd_rim_grids_of(j->scene, &map->rim, &map->rim_grids);
        if (kd_scene_has_tile(j->scene))
            kd_rim_grids_keep(j->scene, &map->rim, &map->rim_grids);
    }
    map->rim_known = true;
}

enum kd_status kd_frame_trace_rim(struct kd_frame_job *j)
{
    struct kd_lens_map *map = j->lens;
    const uint64_t bytes = 4ull * map->rim_grids.numbers;
    struct kd_vk_buffer *staging = NULL;
    enum kd_status status = KD_OK;
    if (map->rim_traced || !map->rim.there)
        return KD_OK;
    KD_TRY(kd_store_at_least(j->r->vk, &map->rim_lens, bytes, KD_VK_DEVICE, "rim of the shadow", j->error));
    KD_TRY(kd_vk_buffer_create(j->r->vk, bytes, KD_VK_UPLOAD, "rays of the rim", &staging, j->error));
    KD_TRY(kd_rim_sky(j->scene, &map->rim, &map->rim_grids, kd_vk_buffer_map(staging), j->error));
    KD_TRY(kd_vk_copy(j->r->vk, "upload", map->rim_lens, 0, staging, 0, bytes, j->error));
    map->rim_traced = true;
done:
    kd_vk_buffer_destroy(j->r->vk, staging);
    return status;
}
