/* This pass finds points of light: from a band's lens map it makes light over its pixels, before they are lit. */
#include "render/frame/job.h"

#include "render/device/prepare.h"
#include "render/view/camera.h"

#include <string.h>

#define LIST_GROUPS 128 /* of kernels whose invocations share a list out */
#define SPILL 2u        /* rows of pixels that an image may reach into the next band */

static enum kd_status kernel(struct kd_frame_job *j, enum kd_kernel kernel, uint32_t tile, const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    const struct kd_spec_stars spec = {
        .QUANTITIES = p->quantities, .ORDERS = p->orders, .SIDE = p->side, .SIGHT = kd_camera_sight(j->scene),
        .VISIBLE = j->scene->disk.band == KD_BAND_VISIBLE, .TILE = tile,
    };
    return kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

static uint32_t tiles_along(uint32_t rays) { return (rays + KD_STAR_TILE - 1) / KD_STAR_TILE; }

/* Pairs of the rays at hand and stars: of large tiles, then of small ones and of rays that are listed. */
static enum kd_status search(struct kd_frame_job *j, struct kd_vk_buffer *lens, const struct kd_stars_push *push)
{
    struct kd_store *s = j->store;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    const bool texels = sky->n + 1 <= kd_vk_info(j->r->vk)->max_texels; /* a third of the time in software */
    const enum kd_kernel tiles = texels ? KD_KERNEL_STAR_TILES_TEXELS : KD_KERNEL_STAR_TILES;
    struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_STARS].name, NULL,
        { { lens, 0, 0, false },
          { s->transfer, 0, sizeof(struct kd_emission), false },
          { s->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false },
          { s->star_pairs, 0, 0, true },
          { sky->stars, 0, 16ull * (sky->n + 1), false },
          { sky->cells, 0, 0, false },
          { s->star_rays, 0, 0, true } },
        push, { kd_frame_groups(tiles_along(push->width)), tiles_along(push->end - push->first) },
    };
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, d.pass, s->star_pairs, 0, 8, 0, j->error));
    KD_TRY(kd_vk_fill(j->r->vk, d.pass, s->star_rays, 0, 8, 0, j->error));
    KD_TRY(kernel(j, tiles, KD_STAR_TILE, &d.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    d.groups[0] = LIST_GROUPS;
    d.groups[1] = 0;
    KD_TRY(kernel(j, tiles, 3, &d.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    KD_TRY(kernel(j, texels ? KD_KERNEL_STAR_SEARCH_TEXELS : KD_KERNEL_STAR_SEARCH, 0, &d.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
done:
    return status;
}

/* The stars that the rays at hand see. */
static enum kd_status slice(struct kd_frame_job *j, struct kd_vk_buffer *lens, const struct kd_stars_push *push, struct kd_vk_buffer *light)
{
    struct kd_store *s = j->store;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    struct kd_vk_dispatch images = {
        kd_passes[KD_PASS_STARS].name, NULL,
        { { lens, 0, 0, false },
          { s->transfer, 0, sizeof(struct kd_emission), false },
          { s->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false },
          { s->star_pairs, 0, 0, false },
          { sky->stars, 0, 0, false },
          { s->cameras, (uint64_t)KD_CAMERA_GRID * KD_CAMERA_BYTES, KD_CAMERA_BYTES, false },
          { light, 0, 0, true } },
        push, { LIST_GROUPS },
    };
    enum kd_status status;
    KD_TRY(search(j, lens, push));
    KD_TRY(kernel(j, KD_KERNEL_STAR_IMAGES, 0, &images.pipeline));
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
        .row0 = kd_frame_band_first(j, from) * p->side, .room = KD_PLAN_PAIRS, .tiles = kd_plan_star_tiles(p), .stars = sky->n, .pixels_y = kd_frame_band_rows(j, to),
        .up = kd_frame_band_first(j, from) - kd_frame_band_first(j, to),
    };
    uint32_t step = KD_PLAN_STAR_RAYS / width;
    step = step > KD_STAR_TILE ? step / KD_STAR_TILE * KD_STAR_TILE : step ? step : 1; /* in whole tiles */
    enum kd_status status = KD_OK;
    for (uint32_t row = first * p->side; row < end * p->side && !status; row += step) {
        push.first = row;
        push.end = end * p->side - row < step ? end * p->side : row + step;
        status = slice(j, kd_frame_band_lens(j, from), &push, j->lens->star_light.buffers[to]);
    }
    return status;
}

static enum kd_status spread_over(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_plan *p = j->plan;
    const uint32_t rows = kd_frame_band_rows(j, band);
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_STARS].name, j->lens->star_light.buffers[band], 0, 24ull * p->width * rows, 0, j->error));
    KD_TRY(rows_of(j, band, 0, rows, band));
    if (p->cacheable && band > 0)
        KD_TRY(rows_of(j, band - 1, kd_frame_band_rows(j, band - 1) > SPILL ? kd_frame_band_rows(j, band - 1) - SPILL : 0, kd_frame_band_rows(j, band - 1), band));
    if (p->cacheable && band + 1 < p->bands)
        KD_TRY(rows_of(j, band + 1, 0, kd_frame_band_rows(j, band + 1) < SPILL ? kd_frame_band_rows(j, band + 1) : SPILL, band));
done:
    return status;
}

/* What the light of stars is made of now. */
static struct kd_star_key key_of(const struct kd_frame_job *j)
{
    struct kd_star_key key;
    memset(&key, 0, sizeof key); /* it is compared byte by byte */
    memcpy(key.lens, j->plan->lens_key, sizeof key.lens);
    key.visible = j->scene->disk.band == KD_BAND_VISIBLE;
    key.sky = j->scene->sky;
    key.block = j->r->emit->data.emission.sky; /* which way it is turned */
    return key;
}

enum kd_status kd_frame_stars(struct kd_frame_job *j, uint32_t band)
{
    struct kd_star_key *key = &j->lens->star_key;
    const struct kd_star_key now = key_of(j);
    enum kd_status status;
    if (!memcmp(key, &now, sizeof now))
        return KD_OK;
    KD_TRY(spread_over(j, band));
    if (band + 1 == j->plan->bands)
        memcpy(key, &now, sizeof now);
done:
    return status;
}
