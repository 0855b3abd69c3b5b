/* This pass finds points of light: from a band's lens map it makes light over its pixels, before they are lit. */
#include "render/frame/job.h"

#include "render/device/prepare.h"
#include "render/view/camera.h"

#define SLICE_RAYS (1u << 17) /* some 20 ms; and few enough that their pairs have room */
#define IMAGE_GROUPS 128      /* of the second kernel, whose invocations share the pairs out */
#define SPILL 2u              /* rows of pixels that an image may reach into the next band */

static enum kd_status kernel(struct kd_frame_job *j, enum kd_kernel kernel, const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    const struct kd_spec_stars spec = {
        .QUANTITIES = p->quantities, .ORDERS = p->orders, .SIDE = p->side, .SIGHT = kd_camera_sight(j->scene),
        .VISIBLE = j->scene->disk.band == KD_BAND_VISIBLE,
    };
    return kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* The rays of so many rows from push->first on. */
static enum kd_status slice(struct kd_frame_job *j, struct kd_vk_buffer *lens, const struct kd_stars_push *push, uint32_t rows, struct kd_vk_buffer *light)
{
    struct kd_store *s = j->store;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    const struct kd_vk_binding emission = { s->transfer, 0, sizeof(struct kd_emission), false };
    const struct kd_vk_binding tables = { s->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false };
    const bool texels = sky->n + 1 <= kd_vk_info(j->r->vk)->max_texels; /* a third of the time in software */
    struct kd_vk_dispatch search = {
        kd_passes[KD_PASS_STARS].name, NULL,
        { { lens, 0, 0, false }, emission, tables, { s->star_pairs, 0, 0, true }, { sky->stars, 0, 16ull * (sky->n + 1), false }, { sky->cells, 0, 0, false } },
        push, { kd_frame_groups(push->width), rows },
    };
    struct kd_vk_dispatch images = {
        kd_passes[KD_PASS_STARS].name, NULL,
        { { lens, 0, 0, false }, emission, tables, { s->star_pairs, 0, 0, false }, { sky->stars, 0, 0, false },
          { s->cameras, (uint64_t)KD_CAMERA_GRID * KD_CAMERA_BYTES, KD_CAMERA_BYTES, false }, { light, 0, 0, true } },
        push, { IMAGE_GROUPS },
    };
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_STARS].name, s->star_pairs, 0, 8, 0, j->error));
    KD_TRY(kernel(j, texels ? KD_KERNEL_STAR_SEARCH_TEXELS : KD_KERNEL_STAR_SEARCH, &search.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &search, j->error));
    KD_TRY(kernel(j, KD_KERNEL_STAR_IMAGES, &images.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &images, j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_frame_report(j, 0));
done:
    return status;
}

/* Rows of pixels of a band, first to end of it, to the light of another or of the same. */
static enum kd_status rows_of(struct kd_frame_job *j, uint32_t from, uint32_t first, uint32_t end, uint32_t to)
{
    const struct kd_plan *p = j->plan;
    const uint32_t width = p->width * p->side;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    struct kd_stars_push push = {
        .width = width, .rows = kd_frame_band_rows(j, from) * p->side, .stride = width * p->band_rows * p->side,
        .row0 = kd_frame_band_first(j, from) * p->side, .room = KD_PLAN_PAIRS, .stars = sky->n, .pixels_y = kd_frame_band_rows(j, to),
        .up = kd_frame_band_first(j, from) - kd_frame_band_first(j, to),
    };
    uint32_t step = SLICE_RAYS / width ? SLICE_RAYS / width : 1;
    enum kd_status status = KD_OK;
    for (uint32_t row = first * p->side; row < end * p->side && !status; row += step) {
        uint32_t left = end * p->side - row;
        push.first = row;
        status = slice(j, kd_frame_band_lens(j, from), &push, left < step ? left : step, j->store->star_light.buffers[to]);
    }
    return status;
}

enum kd_status kd_frame_stars(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_plan *p = j->plan;
    const uint32_t rows = kd_frame_band_rows(j, band);
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_STARS].name, j->store->star_light.buffers[band], 0, 24ull * p->width * rows, 0, j->error));
    KD_TRY(rows_of(j, band, 0, rows, band));
    if (p->cacheable && band > 0)
        KD_TRY(rows_of(j, band - 1, kd_frame_band_rows(j, band - 1) > SPILL ? kd_frame_band_rows(j, band - 1) - SPILL : 0, kd_frame_band_rows(j, band - 1), band));
    if (p->cacheable && band + 1 < p->bands)
        KD_TRY(rows_of(j, band + 1, 0, kd_frame_band_rows(j, band + 1) < SPILL ? kd_frame_band_rows(j, band + 1) : SPILL, band));
done:
    return status;
}
