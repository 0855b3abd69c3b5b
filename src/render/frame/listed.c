/* Traces more rays for listed pixels: runs the kernels of the grid over a list of pixels, and overwrites the light
 * of these pixels. */
#include "render/frame/lens.h"

#include "render/lens/listed.h"

#include <math.h>

static const char *pass_of(const struct kd_frame_part *part, enum kd_pass_id id)
{
    return part->list->pass ? part->list->pass : kd_passes[id].name;
}

struct kd_frame_part kd_frame_part_of(const struct kd_frame_job *j, const struct kd_frame_list *list, uint64_t number)
{
    struct kd_frame_part part = {
        .list = list,
        .first = number * list->most,
        .n = list->most,
        .lens = list->buffers[list->again ? 0 : number],
    };
    if (part.n > list->pixels->n - part.first)
        part.n = list->pixels->n - part.first;
    part.push.stride = (uint32_t)(list->most * list->lattice.rays);
    part.push.list = j->plan->lens.planes * part.push.stride;
    part.push.steps = j->plan->light.march.steps;
    part.push.fine = j->plan->light.march.fine;
    part.push.opaque = (float)j->plan->light.march.opaque;
    part.push.unseen = (float)j->plan->light.march.unseen;
    part.push.lost_most = kd_plan_lost_most(j->plan);
    return part;
}

void kd_frame_part_in_band(const struct kd_frame_job *j, const struct kd_frame_part *part, uint32_t band,
                           uint64_t *from, uint64_t *to)
{
    const uint32_t row = kd_frame_band_first(j, band);
    const uint64_t first = part->first, a = kd_critical_pixels_above(part->list->pixels, row);
    const uint64_t b = kd_critical_pixels_above(part->list->pixels, row + kd_frame_band_rows(j, band));
    *from = a > first ? a - first : 0;
    *to = b < first ? 0 : b - first < part->n ? b - first : part->n;
}

/* Progress of refinement in rows. Rays at the critical curve before refinement do not count. */
static double refined_rows(struct kd_frame_job *j, uint64_t rays)
{
    const double rows = j->refine_rays > 0 ? fmin(j->refine_rows, j->refine_rows * (double)rays / j->refine_rays) : 0;
    j->refine_rows -= rows;
    j->refine_rays -= j->refine_rays > 0 ? fmin((double)rays, j->refine_rays) : 0;
    return rows;
}

/* Runs a kernel over pixels `from` to `to` of a part in slices. There is one invocation for each ray if the kernel
 * makes rays, otherwise one for each pixel. base: the dispatch without its pipeline and size. */
static enum kd_status run_part(struct kd_frame_job *j, const struct kd_frame_part *part, uint64_t from, uint64_t to,
                               const struct kd_vk_dispatch *base, int makes, double ns_per_ray)
{
    const bool rays = makes == KD_MAKES_RAYS;
    enum kd_status status = KD_OK;
    for (uint32_t step; from < to; from += step) {
        step = kd_frame_slice(j, ns_per_ray * part->list->lattice.rays, (uint32_t)(to - from));
        struct kd_slice push = part->push;
        struct kd_vk_dispatch d = *base;
        push.row0 = (uint32_t)from;
        push.rows = step;
        d.push = &push;
        d.groups[0] = kd_frame_groups(rays ? (uint64_t)push.rows * part->list->lattice.rays : push.rows);
        d.groups[1] = 1;
        KD_TRY(rays ? kd_frame_trace_kernel(j, &part->list->lattice, &d.pipeline)
                    : kd_frame_light_kernel(j, &part->list->lattice, makes, &d.pipeline));
        for (const uint32_t turns = kd_frame_turns(j->plan, part->list->lattice.rays, makes); push.ray < turns;
             push.ray++)
            KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
        KD_TRY(kd_frame_report(j, rays ? refined_rows(j, push.rows * part->list->lattice.rays) : 0));
    }
done:
    return status;
}

enum kd_status kd_frame_upload_pixels(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    struct kd_vk_buffer *staging;
    struct kd_vk *vk = j->r->vk;
    uint64_t bytes = 8 * part->n;
    enum kd_status status = kd_vk_buffer_create(vk, bytes, KD_VK_UPLOAD, "listed pixels", &staging, j->error);
    if (status)
        return status;
    float *to = kd_vk_buffer_map(staging);
    for (uint64_t i = 0; i < part->n; i++) {
        to[2 * i] = (float)part->list->pixels->pixels[part->first + i].x;
        to[2 * i + 1] = (float)part->list->pixels->pixels[part->first + i].y;
    }
    status = kd_vk_copy(vk, "upload", part->lens, 4ull * part->push.list, staging, 0, bytes, j->error);
    kd_vk_buffer_destroy(vk, staging);
    return status;
}

static enum kd_status list_part(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    const uint32_t rays = part->list->lattice.rays;
    enum kd_status status = KD_OK;
    for (uint32_t step, from = 0; from < part->n; from += step) {
        step = kd_frame_slice(j, j->plan->cost.trace_ns * rays, (uint32_t)part->n - from);
        const struct kd_lens_rows rows = {
            .first = (uint32_t)(part->first + from),
            .count = step,
            .pixels = part->list->pixels->pixels,
            .lattice = &part->list->lattice,
            .to = part->lens,
            .offset = (uint64_t)from * rays,
            .stride = part->push.stride,
        };
        KD_TRY(kd_frame_list_rays(j, &rows));
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

/* Traces a part by the kernel, and settles the rays that the kernel leaves undecided. */
static enum kd_status trace_and_settle(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    struct kd_vk_dispatch d = kd_frame_trace(j, NULL, part->lens, part->list->camera);
    enum kd_status status;
    d.pass = pass_of(part, KD_PASS_TRACE);
    KD_TRY(kd_frame_forget_open(j, part));
    KD_TRY(run_part(j, part, 0, part->n, &d, KD_MAKES_RAYS, j->plan->cost.trace_ns));
    KD_TRY(kd_frame_settle(j, part, 0));
done:
    return status;
}

/* Makes the footprints of a traced part, in slices. */
static enum kd_status footprint_part(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    struct kd_footprint_area area = {
        .lens = part->lens,
        .lattice = &part->list->lattice,
        .push = { .rows = (uint32_t)part->n, .list = part->push.list, .stride = part->push.stride },
    };
    const uint32_t rays = (uint32_t)(part->n * part->list->lattice.rays);
    enum kd_status status = KD_OK;
    for (uint32_t step, from = 0; kd_plan_has_footprints(&j->plan->lens) && from < rays; from += step) {
        step = kd_frame_slice_at_most(j, j->plan->cost.trace_ns, rays - from);
        area.push.first = from;
        area.push.end = from + step;
        KD_TRY(kd_frame_footprint(j, &area));
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

static enum kd_status trace_part(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    enum kd_status status = kd_frame_upload_pixels(j, part);
    if (status || !j->plan->lens.planes) /* if the march makes all light, it traces its own rays */
        return status;
    if (part->list->between)
        return kd_frame_between(j, part);
    if (j->plan->lens.path == KD_LENS_LISTED)
        return list_part(j, part);
    return trace_and_settle(j, part);
}

/* Computes the pixels' light anew, for the picture or a layer of light. */
static enum kd_status transfer_part(struct kd_frame_job *j, struct kd_frame_part *part, int makes, double ns)
{
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < j->plan->picture.bands && !status; band++) {
        uint64_t from, to;
        kd_frame_part_in_band(j, part, band, &from, &to);
        struct kd_vk_dispatch d = kd_frame_transfer(j, NULL, part->lens, band, part->list->camera, makes);
        d.pass = makes < 0 ? pass_of(part, kd_plan_light_pass(&j->plan->light)) : d.pass;
        part->push.band0 = kd_frame_band_first(j, band);
        status = run_part(j, part, from, to, &d, makes, ns);
        if (!status && makes == KD_MAKES_PICTURE)
            status = kd_frame_follow_lost(j, &d, &part->push, &part->list->lattice,
                                          kd_frame_turns(j->plan, part->list->lattice.rays, makes));
    }
    return status;
}

enum kd_status kd_frame_light_list(struct kd_frame_job *j, const struct kd_frame_list *list, bool needed)
{
    struct kd_capacity c;
    enum kd_status status = KD_OK;
    kd_renderer_capacity(j->r, &c);
    for (uint64_t k = 0; k * list->most < list->pixels->n; k++) {
        struct kd_frame_part part = kd_frame_part_of(j, list, k);
        if (needed) {
            KD_TRY(trace_part(j, &part));
            KD_TRY(footprint_part(j, &part));
        }
        for (int makes = KD_MAKES_PICTURE; makes < (list->layers ? (int)j->plan->picture.n_layers : 0); makes++)
            if (makes == KD_MAKES_PICTURE ||
                (kd_layer_kinds[j->plan->picture.layers[makes].kind].of == KD_OF_LIGHT && !j->plan->light.march.steps))
                KD_TRY(transfer_part(j, &part, makes, kd_plan_light_ns(&j->plan->light, &c)));
        KD_TRY(kd_frame_probe_listed(j, &part));
    }
done:
    return status;
}
