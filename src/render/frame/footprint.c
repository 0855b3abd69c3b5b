/* This pass finds the footprints of a lens map from differences of its rays: after they are traced, before light
 * needs them. */
#include "render/frame/job.h"

enum kd_status kd_frame_footprint_kernel(struct kd_frame_job *j, const struct kd_critical_lattice *l,
                                         const struct kd_vk_pipeline **out)
{
    *out = NULL;
    if (!kd_plan_has_footprints(j->plan))
        return KD_OK;
    const struct kd_critical_neighbours n =
        l && l->generator ? kd_critical_neighbours(l) : (struct kd_critical_neighbours) { 0 };
    struct kd_spec_footprint spec = { .QUANTITIES = j->plan->quantities, .ORDERS = j->plan->orders };
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

enum kd_status kd_frame_footprint(struct kd_frame_job *j, const struct kd_footprint_area *area)
{
    if (!kd_plan_has_footprints(j->plan) || area->push.first == area->push.end)
        return KD_OK;
    struct kd_vk_dispatch d = { kd_passes[KD_PASS_FOOTPRINT].name,
                                NULL,
                                { { area->lens, 0, 0, true }, { area->lens, 0, 0, false } },
                                &area->push,
                                { 0 } };
    const uint32_t n = area->push.end - area->push.first;
    d.groups[0] = kd_frame_groups(area->lattice ? n : area->push.width);
    d.groups[1] = area->lattice ? 1 : n;
    enum kd_status status = kd_frame_footprint_kernel(j, area->lattice, &d.pipeline);
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}
