#include "render/output/cost.h"

#include "base/clock.h"
#include "render/plan/layer_kinds.h"

#include <string.h>

/* Time that a frame saves if its lens map is cached. */
static double trace_ms(const struct kd_plan *plan)
{
    double ms = 0;
    for (size_t i = 0; i < plan->cost.n_passes && plan->lens.cacheable; i++)
        ms += strcmp(plan->cost.passes[i].name, kd_passes[KD_PASS_TRACE].name) ? 0 : plan->cost.passes[i].estimate_ms;
    return ms;
}

/* Bytes of the frame's layers as numbers, with 4 bytes for each number. */
static double file_bytes(const struct kd_series *series, const struct kd_scene *scene,
                         const struct kd_plan_picture *picture)
{
    const struct kd_words *layers = &scene->image.layers;
    double numbers = 0;
    for (int i = 0; i < layers->count && series && series->frame->carries & KD_CARRIES_LAYERS; i++)
        numbers += (layers->at[i].word == KD_LAYER_rgb ? 3. : 1.) * kd_plan_shown_width(picture) *
                   kd_plan_shown_height(picture);
    return 4 * numbers;
}

enum kd_status kd_cost_add(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                           const struct kd_scene *scene, const struct kd_plan *plan, struct kd_error *error)
{
    const uint64_t host = plan->cost.host_bytes + plan->cost.making_bytes;
    uint64_t group;
    if (series && series->swept && kd_cube_compare(&cost->shape, cost->frames, scene, &plan->picture, error))
        return error->status;
    cost->frames++;
    cost->file_bytes += file_bytes(series, scene, &plan->picture);
    cost->device_bytes = plan->cost.device_bytes > cost->device_bytes ? plan->cost.device_bytes : cost->device_bytes;
    cost->host_bytes = host > cost->host_bytes ? host : cost->host_bytes;
    cost->rays += kd_plan_rays(&plan->lens);
    cost->ms += plan->cost.estimate_ms;
    cost->guessed |= !plan->report.measured;
    if (!sweep)
        return KD_OK;
    cost->trace_ms += trace_ms(plan);
    if (kd_plan_lens_group(scene, &group) || kd_sweep_order_add(&cost->order, group, trace_ms(plan)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for sorting %u scenes by lens map", sweep->scenes);
    return KD_OK;
}

enum kd_status kd_cost_end(struct kd_cost *cost, struct kd_error *error)
{
    return kd_sweep_order_end(&cost->order, &cost->shared_ms)
               ? kd_error_set(error, KD_ENOMEM, "out of memory for sorting %u frames by lens map", cost->frames)
               : KD_OK;
}

void kd_cost_finish(struct kd_cost *cost) { kd_sweep_order_finish(&cost->order); }

static enum kd_status plan_scene(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                                 const struct kd_capacity *capacity, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_error inner = { 0 };
    enum kd_status status;
    KD_TRY(kd_sweep_scene(sweep, cost->frames, &scene, error));
    status = series ? kd_format_plan(series->frame, &scene, capacity, &plan, &inner)
                    : kd_plan_make(&scene, capacity, &plan, &inner);
    if (status) {
        kd_error_field(error, "/axes", "scene %u: %.440s", cost->frames, inner.message);
        return error->status = status;
    }
    KD_TRY(kd_cost_add(cost, series, sweep, &scene, &plan, error));
done:
    return status;
}

enum kd_status kd_cost_sweep(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                             const struct kd_capacity *capacity, double until_ms, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    while (cost->frames < sweep->scenes) {
        KD_TRY(plan_scene(cost, series, sweep, capacity, error));
        if (kd_clock_ms() >= until_ms)
            break;
    }
    if (cost->frames == sweep->scenes)
        KD_TRY(kd_cost_end(cost, error));
done:
    return status;
}

enum kd_status kd_cost_json(const struct kd_cost *cost, const struct kd_sweep *sweep, struct kd_buffer *out)
{
    struct kd_json whole = kd_json_begin_lines(out), *json = &whole;
    kd_json_object(json, NULL);
    kd_json_number(json, "scenes", sweep->scenes);
    kd_json_number(json, "lens_maps", cost->order.groups);
    kd_json_number(json, "rays", (double)cost->rays);
    kd_json_object(json, "bytes");
    kd_json_number(json, "device", (double)cost->device_bytes);
    kd_json_number(json, "host", (double)cost->host_bytes);
    if (cost->file_bytes > 0)
        kd_json_number(json, "files", cost->file_bytes);
    kd_json_end(json);
    kd_json_number(json, "estimate_ms", cost->ms - cost->shared_ms);
    kd_json_number(json, "shared_ms", cost->shared_ms);
    kd_json_string(json, "estimate_basis", cost->guessed ? "guess" : "measured");
    kd_sweep_axes_json(sweep, json, "axes");
    kd_json_end(json);
    return kd_json_finish(json);
}
