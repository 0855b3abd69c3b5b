/* Interpolates rays of listed pixels from the rays of the grid instead of tracing them (comp/between.comp). */
#include "render/frame/lens.h"

#include "render/view/critical_pixels.h"

#include <string.h>

bool kd_frame_has_between(const struct kd_frame_job *j)
{
    return j->plan->lens.side == 1 && (j->plan->lens.cacheable || j->plan->picture.bands == 1);
}

static enum kd_status dispatch(struct kd_frame_job *j, uint32_t band, uint32_t side, struct kd_vk_buffer *listed,
                               struct kd_between_push *push)
{
    const struct kd_plan *p = j->plan;
    const struct kd_spec_between spec = {
        .QUANTITIES = p->lens.quantities, .ORDERS = p->lens.orders, .SIDE = side ? side : 1, .MARK = !side
    };
    struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_REFINE].name,
        NULL,
        { { listed, 0, 0, true }, { kd_frame_band_lens(j, band), 0, 0, false } },
        push,
        { kd_frame_groups(push->count), 1 },
    };
    push->width = p->picture.width;
    push->row0 = kd_frame_band_first(j, band);
    push->map_rows = kd_frame_band_rows(j, band);
    push->map_stride = p->picture.width * p->picture.band_rows;
    enum kd_status status = kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_BETWEEN, &spec.QUANTITIES,
                                           sizeof spec / 4, &d.pipeline, j->error);
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

enum kd_status kd_frame_between(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    const uint32_t side = part->list->lattice.shift;
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < j->plan->picture.bands; band++) {
        uint64_t from, to;
        kd_frame_part_in_band(j, part, band, &from, &to);
        for (uint32_t step; from < to; from += step) {
            /* the slice is sized for the time that tracing these rays would take, which is an upper bound */
            step = kd_frame_slice_at_most(j, j->plan->cost.trace_ns * part->list->lattice.rays, (uint32_t)(to - from));
            struct kd_between_push push = {
                .first = (uint32_t)from,
                .count = step,
                .stride = part->push.stride,
                .list = part->push.list,
            };
            KD_TRY(dispatch(j, band, side, part->lens, &push));
            KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
            KD_TRY(kd_frame_report(j, 0));
        }
    }
done:
    return status;
}

/* Marks the pixels of one part. The part's buffer has room for its pixels and for a result word for each pixel. The
 * words are copied to the host. */
static enum kd_status mark_part(struct kd_frame_job *j, const struct kd_frame_part *part, struct kd_vk_buffer *host,
                                uint8_t *marks)
{
    enum kd_status status = kd_frame_upload_pixels(j, part);
    for (uint32_t band = 0; band < j->plan->picture.bands && !status; band++) {
        uint64_t from, to;
        kd_frame_part_in_band(j, part, band, &from, &to);
        struct kd_between_push push = {
            .first = (uint32_t)from, .count = (uint32_t)(to - from), .list = part->push.list, .marks = (uint32_t)part->n
        };
        if (from < to)
            status = dispatch(j, band, 0, part->lens, &push);
    }
    KD_TRY(status);
    KD_TRY(
        kd_vk_copy(j->r->vk, kd_passes[KD_PASS_REFINE].name, host, 0, part->lens, 8 * part->n, 4 * part->n, j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
    const float *words = kd_vk_buffer_map(host);
    for (uint64_t i = 0; i < part->n; i++)
        marks[part->first + i] = words[i] > 0;
done:
    return status;
}

#define MARKED_AT_ONCE (1u << 18) /* number of pixels in one dispatch, which takes some milliseconds */

enum kd_status kd_frame_mark_between(struct kd_frame_job *j, const struct kd_critical_pixels *pixels, uint8_t *marks)
{
    uint64_t most = j->plan->lens.listed_bytes / 12;
    most = most < MARKED_AT_ONCE ? most : MARKED_AT_ONCE;
    struct kd_vk_buffer *host = NULL;
    enum kd_status status = KD_OK;
    memset(marks, 0, pixels->n);
    if (!kd_frame_has_between(j) || !pixels->n)
        return KD_OK;
    const struct kd_frame_list list = { .pixels = pixels, .most = most, .buffers = &j->store->listed, .again = true };
    KD_TRY(kd_vk_buffer_create(j->r->vk, 4 * (pixels->n < most ? pixels->n : most), KD_VK_READBACK,
                               "which pixels lie between rays", &host, j->error));
    for (uint64_t k = 0; k * most < pixels->n; k++) {
        struct kd_frame_part part = kd_frame_part_of(j, &list, k);
        part.push.list = 0;
        KD_TRY(mark_part(j, &part, host, marks));
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    kd_vk_buffer_destroy(j->r->vk, host);
    return status;
}
