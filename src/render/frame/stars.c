/* The stars pass: finds the images of stars through a band's lens map, and spreads their light over the band's
 * pixels before the transfer pass. */
#include "render/frame/job.h"

#include "base/cores.h"
#include "render/device/prepare.h"
#include "render/view/camera.h"

#include <math.h>
#include <string.h>

/* number of workgroups for kernels whose invocations share a list; with 8192 groups an H200 is no faster */
#define LIST_GROUPS 128
/* Number of these workgroups for each core, if the device is a CPU. It is small because there a group costs 15 us
 * even if its list is already done, and because a rim has several grids. */
#define LIST_GROUPS_CORE 4
#define RIM_TILE KD_RIM_TILE_RAYS /* rays along a side of a small tile of the picture, and of a tile of the rim */
#define SPILL 2u                  /* rows by which an image may extend into the next band */

/* Rays among which stars are searched: some rows of a lens map, or a grid of the rim. */
struct part {
    struct kd_vk_buffer *lens;
    const struct kd_rim_grid *rim; /* the grid of the rim; NULL: rays of the picture */
    struct kd_stars_push push;
    struct kd_vk_buffer *light;
};

/* The rays that a kernel processes: rays of a picture without a rim, rays of a picture with a rim, or rays of the
 * rim. */
enum rays { NO_RIM, BESIDE_RIM, OF_RIM };

/* True if the rim is searched. A search for bright images leaves the rim out. */
static bool has_rim(const struct kd_frame_job *j) { return j->lens->rim.there && !j->plan->light.bright; }

static enum rays rays_of(const struct kd_frame_job *j, const struct part *part)
{
    return part->rim ? OF_RIM : has_rim(j) ? BESIDE_RIM : NO_RIM;
}

static enum kd_status kernel(struct kd_frame_job *j, enum rays rays, enum kd_kernel kernel, uint32_t tile,
                             const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    const struct kd_spec_stars spec = {
        .QUANTITIES = p->lens.quantities,
        .ORDERS = p->lens.orders,
        .SIDE = p->lens.side,
        .SIGHT = kd_camera_sight(j->scene),
        .VISIBLE = j->scene->disk.band == KD_BAND_VISIBLE,
        .TILE = tile,
        .RIM = rays,
        .BRIGHT = p->light.bright && (kernel == KD_KERNEL_STAR_TILES || kernel == KD_KERNEL_STAR_TILES_TEXELS),
    };
    return kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* True if the kernels read texels, which takes a third of the time on a software device. */
static bool reads_texels(const struct kd_frame_job *j, uint64_t stars)
{
    return stars <= kd_vk_info(j->r->vk)->max_texels && kd_kernels_map_as_texels(j->r->vk);
}

/* The number of entries of the star buffer is not known yet. 2^17 is used, which is above the number of stars of the
 * catalogue; no sky has more stars. */
enum kd_status kd_frame_star_kernels(struct kd_frame_job *j)
{
    const bool rim = kd_rim_may_be(j->scene) && !j->plan->light.bright, texels = reads_texels(j, 1u << 17);
    const enum kd_kernel tiles = texels ? KD_KERNEL_STAR_TILES_TEXELS : KD_KERNEL_STAR_TILES,
                         find = texels ? KD_KERNEL_STAR_SEARCH_TEXELS : KD_KERNEL_STAR_SEARCH,
                         images = texels ? KD_KERNEL_STAR_IMAGES_TEXELS : KD_KERNEL_STAR_IMAGES;
    const enum rays picture = rim ? BESIDE_RIM : NO_RIM;
    const struct kd_vk_pipeline *later;
    enum kd_status status;
    KD_TRY(kernel(j, picture, tiles, KD_STAR_TILE, &later));
    KD_TRY(kernel(j, picture, tiles, RIM_TILE, &later));
    for (enum rays rays = picture; rays <= (rim ? OF_RIM : picture); rays++) {
        KD_TRY(kernel(j, rays, find, 0, &later));
        KD_TRY(kernel(j, rays, images, 0, &later));
    }
    if (rim)
        KD_TRY(kernel(j, OF_RIM, tiles, RIM_TILE, &later));
done:
    return status;
}

static uint32_t list_groups(const struct kd_frame_job *j)
{
    const uint32_t cores = LIST_GROUPS_CORE * kd_cores();
    return kd_vk_info(j->r->vk)->type == KD_VK_CPU && cores < LIST_GROUPS ? cores : LIST_GROUPS;
}

static struct kd_vk_binding camera(const struct kd_frame_job *j)
{
    return (struct kd_vk_binding) { j->store->cameras, (uint64_t)KD_CAMERA_WHOLE * KD_CAMERA_BYTES, KD_CAMERA_BYTES,
                                    false };
}

/* The binding of the rim. Some buffer must be bound even if there is no rim. */
static struct kd_vk_binding rim(const struct kd_frame_job *j)
{
    return (struct kd_vk_binding) { has_rim(j) ? j->lens->rim_lens : j->store->transfer, 0, 0, false };
}

static uint32_t along(uint32_t rays, uint32_t tile) { return (rays + tile - 1) / tile; }

/* Directions of a part's rays. */
static struct kd_vk_binding lens_of(const struct part *part)
{
    return (struct kd_vk_binding) { part->lens, part->rim ? 4ull * part->rim->first : 0,
                                    part->rim ? 12ull * kd_rim_grid_rays(part->rim) : 0, false };
}

/* Makes pairs of rays and stars. A picture is searched by large tiles, then by small tiles and listed rays. The rim is
 * searched by small tiles and rays. */
static enum kd_status search(struct kd_frame_job *j, const struct part *part)
{
    struct kd_store *s = j->store;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    const bool texels = reads_texels(j, sky->n + 1);
    const enum kd_kernel tiles = texels ? KD_KERNEL_STAR_TILES_TEXELS : KD_KERNEL_STAR_TILES;
    struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_STARS].name,
        NULL,
        { lens_of(part),
          { s->transfer, 0, sizeof(struct kd_emission), false },
          { s->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false },
          { s->star_pairs, 0, 0, true },
          { sky->stars, 0, 16ull * (sky->n + 1), false },
          { sky->cells, 0, 0, false },
          { s->star_rays, 0, 0, true },
          rim(j),
          camera(j),
          { part->light, 0, 0, true },
          { sky->stars, 0, 0, false } },
        &part->push,
        { list_groups(j) },
    };
    const uint32_t tile = part->rim ? RIM_TILE : KD_STAR_TILE;
    const enum rays rays = rays_of(j, part);
    struct kd_vk_dispatch first = d;
    first.groups[0] = kd_frame_groups(along(part->push.right - part->push.left, tile));
    first.groups[1] = along(part->push.end - part->push.first, tile);
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, d.pass, s->star_pairs, 0, 8, 0, j->error));
    KD_TRY(kd_vk_fill(j->r->vk, d.pass, s->star_rays, 0, 8, 0, j->error));
    KD_TRY(kernel(j, rays, tiles, tile, &first.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &first, j->error));
    if (!part->rim) {
        KD_TRY(kernel(j, rays, tiles, RIM_TILE, &d.pipeline));
        KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    }
    KD_TRY(kernel(j, rays, texels ? KD_KERNEL_STAR_SEARCH_TEXELS : KD_KERNEL_STAR_SEARCH, 0, &d.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
done:
    return status;
}

/* Finds the images of stars that the rays of a part see. */
static enum kd_status stars_of(struct kd_frame_job *j, const struct part *part)
{
    struct kd_store *s = j->store;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    struct kd_vk_dispatch images = {
        kd_passes[KD_PASS_STARS].name,
        NULL,
        { lens_of(part),
          { s->transfer, 0, sizeof(struct kd_emission), false },
          { s->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false },
          { s->star_pairs, 0, 0, false },
          { sky->stars, 0, 0, false },
          camera(j),
          { part->light, 0, 0, true },
          rim(j) },
        &part->push,
        { list_groups(j) },
    };
    const enum kd_kernel spread = reads_texels(j, sky->n + 1) ? KD_KERNEL_STAR_IMAGES_TEXELS : KD_KERNEL_STAR_IMAGES;
    enum kd_status status;
    KD_TRY(search(j, part));
    KD_TRY(kernel(j, rays_of(j, part), spread, 0, &images.pipeline));
    KD_TRY(kd_vk_dispatch(j->r->vk, &images, j->error));
done:
    return status;
}

static enum kd_status submit(struct kd_frame_job *j)
{
    enum kd_status status;
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_frame_report(j, 0));
done:
    return status;
}

/* Push constants for the rim. The constants for a part's rays are not set yet. */
static struct kd_stars_push push_of(const struct kd_frame_job *j)
{
    const struct kd_rim *r = &j->lens->rim;
    const struct kd_sky_buffers *sky = j->prepared->own[KD_EMITTER_sky];
    return (struct kd_stars_push) {
        .room = KD_PLAN_PAIRS,
        .tiles = kd_plan_star_tiles(j->plan),
        .stars = sky->n,
        .least = j->plan->light.bright ? (float)KD_STAR_LEAST_BRIGHT : (float)KD_STAR_LEAST,
        .none = (float)r->none,
        .full = (float)r->full,
        .ahead_x = (float)r->ahead[0],
        .ahead_y = (float)r->ahead[1],
        .ahead_z = (float)r->ahead[2],
        .right_x = (float)r->right[0],
        .right_y = (float)r->right[1],
        .right_z = (float)r->right[2],
        .up_x = (float)r->up[0],
        .up_y = (float)r->up[1],
        .up_z = (float)r->up[2],
    };
}

/* Sets the conversion from places of images to places in the light of a band. Places of images refer to the whole
 * picture, so that a tile is identical to that part of the picture. */
static void set_light(struct kd_stars_push *push, const struct kd_frame_job *j, uint32_t band)
{
    const struct kd_window window = kd_scene_window(j->scene);
    push->pixels_y = kd_frame_band_rows(j, band);
    push->up = 0u - window.top - kd_frame_band_first(j, band);
    push->rightward = 0u - window.left;
}

/* Processes rows `first` to `end` of the band `from`, and adds the light of their stars to the band `to`. */
static enum kd_status rows_of(struct kd_frame_job *j, uint32_t from, uint32_t first, uint32_t end, uint32_t to)
{
    const struct kd_plan *p = j->plan;
    const uint32_t width = p->picture.width * p->lens.side;
    const struct kd_window window = kd_scene_window(j->scene);
    struct part part = { .lens = kd_frame_band_lens(j, from),
                         .push = push_of(j),
                         .light = j->lens->star_light.buffers[to] };
    part.push.width = part.push.right = width;
    part.push.rows = kd_frame_band_rows(j, from) * p->lens.side;
    part.push.stride = width * p->picture.band_rows * p->lens.side;
    part.push.row0 = (window.top + kd_frame_band_first(j, from)) * p->lens.side;
    part.push.column0 = window.left * p->lens.side;
    set_light(&part.push, j, to);
    uint32_t step = KD_PLAN_STAR_RAYS / width;
    /* rounded down to a multiple of the tile */
    step = step > KD_STAR_TILE ? step / KD_STAR_TILE * KD_STAR_TILE : step ? step : 1;
    enum kd_status status = KD_OK;
    for (uint32_t row = first * p->lens.side; row < end * p->lens.side && !status; row += step) {
        part.push.first = row;
        part.push.end = end * p->lens.side - row < step ? end * p->lens.side : row + step;
        KD_TRY(stars_of(j, &part));
        KD_TRY(submit(j));
    }
done:
    return status;
}

static enum kd_status grid_of(struct kd_frame_job *j, const struct kd_rim_grid *grid, uint32_t to)
{
    struct part part = {
        .lens = j->lens->rim_lens, .rim = grid, .push = push_of(j), .light = j->lens->star_light.buffers[to]
    };
    part.push.width = grid->columns;
    part.push.rows = grid->rows;
    part.push.first = grid->y.first, part.push.end = grid->y.end;
    part.push.stride = kd_rim_grid_rays(grid);
    part.push.rim = grid->table;
    part.push.far = (float)exp(grid->l);
    part.push.fall = (float)grid->dl;
    set_light(&part.push, j, to);
    enum kd_status status = KD_OK;
    for (int k = 0; k < 2 && grid->x[k].end && !status; k++) {
        part.push.left = grid->x[k].first, part.push.right = grid->x[k].end;
        status = stars_of(j, &part);
    }
    return status;
}

/* Adds images next to the critical curve to the light of a band. */
static enum kd_status rim_of(struct kd_frame_job *j, uint32_t to)
{
    const struct kd_rim_grids *grids = &j->lens->rim_grids;
    uint32_t rays = 0; /* number of rays whose commands are recorded but not submitted */
    enum kd_status status = KD_OK;
    for (uint32_t i = 0; has_rim(j) && i < grids->n; i++) {
        KD_TRY(grid_of(j, &grids->of[i], to));
        rays += kd_rim_grid_rays(&grids->of[i]);
        if (rays < KD_PLAN_STAR_RAYS / 4 && i + 1 < grids->n)
            continue;
        KD_TRY(submit(j));
        rays = 0;
    }
done:
    return status;
}

static enum kd_status spread_over(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_plan *p = j->plan;
    const uint32_t rows = kd_frame_band_rows(j, band);
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_STARS].name, j->lens->star_light.buffers[band], 0,
                      24ull * p->picture.width * rows, 0, j->error));
    if (has_rim(j))
        KD_TRY(kd_frame_trace_rim(j));
    KD_TRY(rim_of(j, band));
    KD_TRY(rows_of(j, band, 0, rows, band));
    if (p->lens.cacheable && band > 0)
        KD_TRY(rows_of(j, band - 1,
                       kd_frame_band_rows(j, band - 1) > SPILL ? kd_frame_band_rows(j, band - 1) - SPILL : 0,
                       kd_frame_band_rows(j, band - 1), band));
    if (p->lens.cacheable && band + 1 < p->picture.bands)
        KD_TRY(rows_of(j, band + 1, 0,
                       kd_frame_band_rows(j, band + 1) < SPILL ? kd_frame_band_rows(j, band + 1) : SPILL, band));
done:
    return status;
}

/* Key of the present light of stars. It is made before other threads use the device, because those threads may change
 * the renderer's sky. */
static struct kd_star_key key_of(const struct kd_frame_job *j)
{
    struct kd_star_key key;
    memset(&key, 0, sizeof key); /* cleared, because keys are compared byte by byte */
    memcpy(key.lens, j->plan->lens.key, sizeof key.lens);
    key.bright = j->plan->light.bright;
    key.visible = j->scene->disk.band == KD_BAND_VISIBLE;
    key.sky = j->scene->sky;
    key.block = j->r->emit->data.emission.sky; /* this block includes the sky's orientation */
    return key;
}

void kd_frame_begin_stars(struct kd_frame_job *j)
{
    j->star_key = key_of(j);
    j->stars_kept = !memcmp(&j->lens->star_key, &j->star_key, sizeof j->star_key);
    if (!j->stars_kept)
        j->lens->star_key.lens[0] = 0;
}

enum kd_status kd_frame_stars(struct kd_frame_job *j, uint32_t band)
{
    enum kd_status status = j->stars_kept ? KD_OK : spread_over(j, band);
    if (!status && !j->stars_kept && band + 1 == j->plan->picture.bands)
        memcpy(&j->lens->star_key, &j->star_key, sizeof j->star_key);
    return status;
}
