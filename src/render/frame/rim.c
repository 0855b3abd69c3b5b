/* This file follows the rays of the rim, next to the critical curve, on which stars are sought too (view/rim.h). Its rays are listed: numbers in
 * steps of a camera of its own. Their buffer holds a lens map, the list, and tables that say where the rim is. */
#include "render/frame/job.h"

#include "render/view/camera.h"

#include <math.h>
#include <string.h>

void kd_frame_find_rim(struct kd_frame_job *j)
{
    struct kd_lens_map *map = j->lens;
    if (!map->rim_known)
        kd_rim_of(j->scene, &map->rim);
    map->rim_known = true;
}

static uint32_t list_of(const struct kd_rim *rim) { return kd_rim_rays(rim) * kd_lens_planes(KD_RIM_QUANTITIES, 1); }

/* The list, and behind it the curve and how far it is from the middle. */
static void write(const struct kd_rim *rim, float *to)
{
    for (uint32_t i = 0; i < rim->rows; i++) {
        const double off = kd_rim_off(rim, i);
        for (uint32_t k = 0; k < KD_RIM_ANGLES; k++) {
            const struct kd_rim_pixel place = kd_rim_ray(rim, k, off);
            *to++ = (float)place.x;
            *to++ = (float)place.y;
        }
    }
    for (int k = 0; k < KD_RIM_ANGLES; k++) {
        *to++ = (float)rim->x[k];
        *to++ = (float)rim->y[k];
    }
    memcpy(to, rim->edge, sizeof rim->edge);
}

static enum kd_status upload(struct kd_frame_job *j)
{
    struct kd_lens_map *map = j->lens;
    const uint64_t first = 4ull * list_of(&map->rim), bytes = kd_rim_bytes(kd_rim_rays(&map->rim)) - first;
    struct kd_vk_buffer *staging = NULL;
    enum kd_status status;
    KD_TRY(kd_vk_buffer_create(j->r->vk, bytes, KD_VK_UPLOAD, "rays of the rim", &staging, j->error));
    write(&map->rim, kd_vk_buffer_map(staging));
    KD_TRY(kd_vk_copy(j->r->vk, "upload", map->rim_lens, first, staging, 0, bytes, j->error));
done:
    kd_vk_buffer_destroy(j->r->vk, staging);
    return status;
}

enum kd_status kd_frame_rim_kernel(struct kd_frame_job *j, const struct kd_vk_pipeline **out)
{
    const struct kd_spec_lens_closed spec = {
        .QUANTITIES = KD_RIM_QUANTITIES, .ORDERS = 1, .SIGHT = isinf(j->scene->camera.r) ? KD_SIGHT_PLANE : KD_SIGHT_PINHOLE, .CRITICAL = 1, .SHIFT = 1,
    };
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_CLOSED, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* In closed form: there is a rim where that is right. Rays that it gives up are not counted: here they are none of the picture's. */
static enum kd_status trace(struct kd_frame_job *j)
{
    const struct kd_rim *rim = &j->lens->rim;
    const struct kd_slice push = { .rows = kd_rim_rays(rim), .stride = kd_rim_rays(rim), .list = list_of(rim) };
    struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_TRACE].name, NULL,
        { { j->lens->rim_lens, 0, 0, true }, { j->store->star_pairs, 0, 0, true }, { j->store->cameras, (uint64_t)KD_CAMERA_RIM * KD_CAMERA_BYTES, KD_CAMERA_BYTES, false } },
        &push, { kd_frame_groups(kd_rim_rays(rim)) },
    };
    enum kd_status status;
    KD_TRY(kd_frame_rim_kernel(j, &d.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
done:
    return status;
}

enum kd_status kd_frame_trace_rim(struct kd_frame_job *j)
{
    struct kd_lens_map *map = j->lens;
    enum kd_status status = KD_OK;
    if (map->rim_traced || !map->rim.rows)
        return KD_OK;
    KD_TRY(kd_store_at_least(j->r->vk, &map->rim_lens, kd_rim_bytes(kd_rim_rays(&map->rim)), KD_VK_DEVICE, "lens map of the rim", j->error));
    KD_TRY(upload(j));
    KD_TRY(trace(j));
    map->rim_traced = true;
done:
    return status;
}
