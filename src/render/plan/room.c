#include "render/plan/room.h"

#include "render/plan/sample.h"

#include "render/emit/emitter.h"

#include "interface.h"
#include "render/plan/photometry.h"
#include "render/view/critical_cache.h"
#include "render/view/layout.h"
#include "render/view/rim_grid.h"

/* The functions below return limits of the device: the capacity's if they are known, otherwise what Vulkan 1.2
 * guarantees (maxComputeWorkGroupCount, maxMemoryAllocationSize). */
static uint64_t groups_x(const struct kd_capacity *c) { return c->max_groups_x ? c->max_groups_x : 65535; }
static uint64_t groups_y(const struct kd_capacity *c) { return c->max_groups_y ? c->max_groups_y : 65535; }
static uint64_t buffer_bytes(const struct kd_capacity *c)
{
    uint64_t allocation = c->max_allocation_bytes ? c->max_allocation_bytes : 1ull << 30;
    return allocation < c->max_binding_bytes ? allocation : c->max_binding_bytes;
}

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

uint64_t kd_plan_open_most(const struct kd_plan *plan)
{
    const uint64_t band = (uint64_t)plan->picture.width * plan->picture.band_rows * plan->lens.side * plan->lens.side,
                   part = (uint64_t)plan->lens.critical_part * plan->lens.critical;
    return least(band > part ? band : part, KD_GIVEN_MOST);
}

/* Rows of pixels that each pass can process in one dispatch. The trace pass has a row of groups for each row of
 * rays. The other passes number the pixels of a band consecutively: the light pass takes 64 pixels for each
 * invocation, the post pass 4. The expose pass has a few hundred groups, far below the limit. */
static uint64_t rows_of_groups(const struct kd_plan *plan, const struct kd_capacity *c)
{
    uint64_t rows = groups_y(c) / plan->lens.side, in_line = groups_x(c) * KD_GROUP_SIZE;
    return least(rows, in_line * KD_POST_PIXELS / plan->picture.width);
}

/* On the host a picture exists twice, as pixels and as the encoded file. */
static uint64_t host_of(const struct kd_plan *plan) { return 2 * plan->cost.host_bytes + plan->cost.making_bytes; }

enum kd_status kd_plan_has_room(const struct kd_plan *plan, uint64_t more, const struct kd_capacity *c,
                                struct kd_error *error)
{
    const char *where = "device", *by = c->memory_by ? c->memory_by : "the device";
    const uint64_t host = host_of(plan) + more;
    uint64_t bytes = plan->cost.device_bytes + (c->host_memory ? host : 0), most = c->memory_bytes;
    if (bytes <= most && !c->host_memory && c->host_bytes && host > c->host_bytes) {
        where = "host";
        by = "the free memory of the host";
        bytes = host;
        most = c->host_bytes;
    }
    if (bytes <= most)
        return KD_OK;
    return kd_error_set(error, KD_ETOOBIG,
                        "the picture needs %.2f GiB of %s memory; it must be at most %.2f GiB (limit: %s): lower "
                        "image.width, image.height or image.samples",
                        (double)bytes / (1 << 30), where, (double)most / (1 << 30), by);
}

/* Decides whether the whole lens map is kept, and checks that everything fits. */
static enum kd_status fits(struct kd_plan *plan, uint64_t fixed, uint64_t one_band, const struct kd_capacity *c,
                           struct kd_error *error)
{
    const uint64_t others = fixed + (c->host_memory ? host_of(plan) : 0);
    plan->lens.cacheable = others + plan->cost.lens_bytes <= c->memory_bytes;
    plan->cost.device_bytes = fixed + (plan->lens.cacheable ? plan->cost.lens_bytes : one_band);
    return kd_plan_has_room(plan, 0, c, error);
}

/* Bytes of a beam: its rows of cells and its grids. */
static uint64_t beam_bytes(const struct kd_plan_picture *picture)
{
    if (!picture->beam.cell)
        return 0;
    return 12ull * picture->width * picture->height + kd_beam_lines_bytes(&picture->beam) +
           kd_beam_grids_bytes(&picture->beam);
}

enum kd_status kd_plan_beam_fits(const struct kd_plan_picture *picture, const struct kd_capacity *c,
                                 struct kd_error *error)
{
    const uint64_t lines = kd_beam_lines_bytes(&picture->beam), grids = kd_beam_grids_bytes(&picture->beam),
                   bytes = lines > grids ? lines : grids;
    if (!picture->beam.cell || bytes <= buffer_bytes(c))
        return KD_OK;
    return kd_error_set(error, KD_ETOOBIG,
                        "at this picture size style.beam_uas needs a buffer of %llu bytes; on this device it must be "
                        "at most %llu: lower image.width and image.height, or raise style.beam_uas",
                        (unsigned long long)bytes, (unsigned long long)buffer_bytes(c));
}

enum kd_status kd_plan_bands(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                             struct kd_error *error)
{
    uint64_t row_lens = 4ull * plan->lens.planes * plan->picture.width * plan->lens.side * plan->lens.side;
    uint64_t row_light = (kd_plan_pixel_bytes(&plan->light) + (plan->light.march.steps ? 4 : 0)) * plan->picture.width,
             row_out = plan->picture.no_image ? 0 : (scene->image.bit_depth == 16 ? 6ull : 3ull) * plan->picture.width;
    /* refinement chooses pixels by values of 16 bits */
    uint64_t row_shown = plan->lens.adaptive ? 6ull * plan->picture.width : row_out;
    uint64_t row_layers = 4ull * plan->picture.n_layers * plan->picture.width;
    uint64_t widest = row_lens > row_light ? row_lens : row_light;
    widest = row_layers > widest ? row_layers : widest;
    uint64_t row_points = plan->light.points ? 24ull * plan->picture.width : 0;
    widest = row_points > widest ? row_points : widest;
    const uint64_t going_on = plan->light.march.steps ? kd_plan_lost_bytes(1) : 0;
    uint64_t rows = (buffer_bytes(c) - 64 - going_on - 256 * plan->picture.n_layers) / widest,
             fit = rows_of_groups(plan, c);
    if (rows < 1)
        return kd_error_set(error, KD_ETOOBIG,
                            "one row of the picture needs %llu bytes; on this device it must be at most %llu",
                            (unsigned long long)widest, (unsigned long long)buffer_bytes(c));
    if (fit < 1 || (uint64_t)plan->picture.width * plan->lens.side > groups_x(c) * KD_GROUP_SIZE)
        return kd_error_set(error, KD_ETOOBIG,
                            "one row of the picture has %llu rays, too many for %llu workgroups of %d on this device",
                            (unsigned long long)plan->picture.width * plan->lens.side, (unsigned long long)groups_x(c),
                            KD_GROUP_SIZE);
    rows = least(rows, fit);
    plan->picture.band_rows = (uint32_t)(rows < plan->picture.height ? rows : plan->picture.height);
    plan->picture.bands = (plan->picture.height + plan->picture.band_rows - 1) / plan->picture.band_rows;
    kd_sample_fit(plan, buffer_bytes(c));
    uint64_t at_curve = kd_plan_critical_parts(&plan->lens) * kd_plan_critical_bytes(&plan->lens);
    plan->cost.lens_bytes = row_lens * plan->picture.height + at_curve;
    plan->cost.making_bytes = kd_emit_making_bytes(scene);
    plan->cost.host_bytes = (row_out + row_layers + (plan->lens.adaptive ? 12ull * plan->picture.width : 0) +
                             (plan->picture.radiance ? 12ull * plan->picture.width : 0)) *
                            plan->picture.height;
    uint64_t fixed =
        plan->lens.listed_bytes + kd_sample_bytes(plan) + 8 * (1 + kd_plan_open_most(plan)) +
        kd_emit_device_bytes(scene) + row_light * plan->picture.height + going_on * plan->picture.bands +
        2 * (row_shown * plan->picture.band_rows + 64) + (1 << 20) + plan->picture.bloom.bytes +
        beam_bytes(&plan->picture) + (plan->light.photometry ? 2 * kd_light_bytes(plan) : 0) +
        row_points * plan->picture.height +
        (plan->light.points ? kd_plan_pair_bytes() + kd_plan_star_ray_bytes(plan) + kd_rim_bytes_most() : 0) +
        plan->picture.n_layers * kd_plan_layer_bytes(&plan->picture) * plan->picture.bands +
        kd_plan_readback_bytes(&plan->picture);
    uint64_t one_band = row_lens * plan->picture.band_rows + at_curve;
    return fits(plan, fixed, one_band, c, error);
}

enum kd_status kd_plan_critical(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                                struct kd_error *error)
{
    struct kd_critical_pixels list;
    const uint64_t side = least(plan->lens.side * (uint64_t)scene->image.critical_factor, KD_CRITICAL_SIDE);
    const uint64_t dense = least(KD_PLAN_ADAPTIVE_SIDE * (uint64_t)scene->image.critical_factor, KD_CRITICAL_SIDE);
    /* with one order and no ends, no pixels are planned here, because no part of the direct image is thinner than a
     * pixel */
    if (plan->lens.ring || side <= plan->lens.side ||
        !(plan->lens.orders > 1 || plan->lens.ends || plan->light.march.steps))
        return KD_OK;
    enum kd_status status = kd_critical_cache(scene, &list, error);
    uint64_t n = list.n, most = (buffer_bytes(c) - 64) / (4 * (plan->lens.planes * side * side + 2));
    kd_critical_pixels_finish(&list);
    if (status || !n)
        return status;
    most = least(most, groups_x(c) * KD_GROUP_SIZE / (side * side));
    most = least(most, (1ull << 32) / (4 * (plan->lens.planes * side * side + 2))); /* the kernel counts in 32 bits */
    if (!most)
        return KD_OK;
    plan->lens.critical = (uint32_t)(side * side);
    plan->lens.critical_dense = plan->lens.adaptive ? (uint32_t)(dense * dense) : 0;
    plan->lens.critical_pixels = n;
    plan->lens.critical_part = n < most ? n : most;
    return KD_OK;
}

void kd_plan_adapt(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c)
{
    if (!kd_scene_adapts(scene) || plan->lens.ring || plan->picture.no_image || !plan->picture.rgb ||
        !plan->lens.planes)
        return;
    plan->lens.adaptive = KD_PLAN_ADAPTIVE_SIDE * KD_PLAN_ADAPTIVE_SIDE;
    plan->lens.listed_bytes =
        least(least(4ull * plan->lens.rays * (plan->lens.planes * plan->lens.adaptive + 2), KD_PLAN_LISTED_BYTES),
              buffer_bytes(c) - 64);
    if (!kd_plan_listed_most(&plan->lens,
                             KD_CRITICAL_SIDE * KD_CRITICAL_SIDE)) /* the buffer has no room for even one pixel */
        plan->lens.listed_bytes = 4ull * (plan->lens.planes * KD_CRITICAL_SIDE * KD_CRITICAL_SIDE + 2);
}
