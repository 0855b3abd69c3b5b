/* The footprint pass: computes footprints of a lens map from differences of its rays. It runs between tracing and
   light. */
#include "render/frame/job.h"

enum kd_status kd_frame_footprint_kernel(struct kd_frame_job *j, const struct kd_critical_lattice *l,
                                         const struct kd_vk_pipeline **out)
{
    *out = NULL;
    if (!kd_plan_has_footprints(&j->plan->lens))
        return KD_OK;
    const struct kd_critical_neighbours n =
        l && l->generator ? kd_critical_neighbours(l) : (struct kd_critical_neighbours) { 0 };
    struct kd_spec_footprint spec = { .QUANTITIES = j->plan->lens.quantities, .ORDERS = j->plan->lens.orders };
    if (l) {
        spec.CRITICAL = l->rays;
        spec.GENERATOR = l->generator;
        spec.SHIFT = l->shift;
    }
    uint32_t *to = &spec.X1;
    for (int i = 0; i < 4; i++) {
        to[2 * i] = (uint32_t)n.to[i].x;
        to[2 * i + 1] = (uint32_t)n.to[i].y;
    }
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_FOOTPRINT + (kd_kernels_map_as_texels(j->r->vk) ? 1 : 0),
                          &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

static enum kd_status dispatch(struct kd_frame_job *j, const struct kd_footprint_area *area, struct kd_vk_dispatch *d)
{
    d->pass = kd_passes[KD_PASS_FOOTPRINT].name;
    d->push = &area->push;
    d->bindings[0] = (struct kd_vk_binding) { area->lens, 0, 0, true };
    /* the kernel reads this binding only if there are counts */
    d->bindings[KD_FOOTPRINT_PLACES].buffer = d->counts ? d->counts : j->store->undecided;
    d->bindings[2] = (struct kd_vk_binding) { area->lens, 0, 0, false };
    const enum kd_status status = kd_frame_footprint_kernel(j, area->lattice, &d->pipeline);
    return status ? status : kd_vk_dispatch(j->r->vk, d, j->error);
}

enum kd_status kd_frame_footprint(struct kd_frame_job *j, const struct kd_footprint_area *area)
{
    if (!kd_plan_has_footprints(&j->plan->lens) || area->push.first == area->push.end)
        return KD_OK;
    const uint32_t n = area->push.end - area->push.first;
    struct kd_vk_dispatch d = { .groups = { kd_frame_groups(area->lattice ? n : area->push.width),
                                            area->lattice ? 1 : n } };
    return dispatch(j, area, &d);
}

enum kd_status kd_frame_footprint_sampled(struct kd_frame_job *j, const struct kd_footprint_area *area, uint32_t row0,
                                          uint32_t traced)
{
    struct kd_footprint_area alone = *area, held = *area;
    struct kd_vk_dispatch d = { .counts = j->store->sample, .counts_at = 16 * KD_STAGE_ALONE };
    if (!kd_plan_has_footprints(&j->plan->lens))
        return KD_OK;
    alone.push.alone = 1;
    alone.push.origin_x = (uint32_t)j->store->alone_x;
    alone.push.origin_y = (uint32_t)j->store->alone_y - row0;
    alone.push.list = j->store->alone;
    enum kd_status status = dispatch(j, &alone, &d);
    held.push.alone = 2;
    held.push.end = traced < area->push.end ? traced : area->push.end;
    return status || held.push.first >= held.push.end ? status : kd_frame_footprint(j, &held);
}
