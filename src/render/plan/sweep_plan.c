#include "render/plan/sweep_plan.h"

#include "render/plan/sweep_order.h"

#include <string.h>

struct sum {
    struct kd_sweep_order order;
    uint64_t device_bytes, host_bytes, rays; /* bytes: of the largest scene */
    double ms, shared_ms;
    bool measured;
};

/* What a scene does not take if its lens map is there already. */
static double trace_ms(const struct kd_plan *plan)
{
    double ms = 0;
    for (size_t i = 0; i < plan->n_passes && plan->cacheable; i++)
        ms += strcmp(plan->passes[i].name, kd_passes[KD_PASS_TRACE].name) ? 0 : plan->passes[i].estimate_ms;
    return ms;
}

static enum kd_status add(struct sum *sum, const struct kd_scene *scene, const struct kd_plan *plan, struct kd_error *error)
{
    const uint64_t host = plan->host_bytes + plan->making_bytes;
    uint64_t group;
    sum->device_bytes = plan->device_bytes > sum->device_bytes ? plan->device_bytes : sum->device_bytes;
    sum->host_bytes = host > sum->host_bytes ? host : sum->host_bytes;
    sum->rays += kd_plan_rays(plan);
    sum->ms += plan->estimate_ms;
    sum->measured &= plan->measured;
    if (kd_plan_lens_group(scene, &group) || kd_sweep_order_add(&sum->order, group, trace_ms(plan)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for the order of the scenes");
    return KD_OK;
}

static enum kd_status write(const struct kd_sweep *sweep, const struct sum *sum, struct kd_buffer *out)
{
    struct kd_json whole = kd_json_begin_lines(out), *json = &whole;
    kd_json_object(json, NULL);
    kd_json_number(json, "scenes", sweep->scenes);
    kd_json_number(json, "lens_maps", sum->order.groups);
    kd_json_number(json, "rays", (double)sum->rays);
    kd_json_object(json, "bytes");
    kd_json_number(json, "device", (double)sum->device_bytes);
    kd_json_number(json, "host", (double)sum->host_bytes);
    kd_json_end(json);
    kd_json_number(json, "estimate_ms", sum->ms - sum->shared_ms);
    kd_json_number(json, "shared_ms", sum->shared_ms);
    kd_json_string(json, "estimate_basis", sum->measured ? "measured" : "guess");
    kd_sweep_axes_json(sweep, json, "axes");
    kd_json_end(json);
    return kd_json_finish(json);
}

enum kd_status kd_sweep_plan_json(const struct kd_sweep *sweep, const struct kd_capacity *capacity, struct kd_buffer *out, struct kd_error *error)
{
    struct sum sum = { .measured = true };
    struct kd_error inner = { 0 };
    enum kd_status status = KD_OK;
    for (unsigned i = 0; i < sweep->scenes; i++) {
        struct kd_scene scene;
        struct kd_plan plan;
        KD_TRY(kd_sweep_scene(sweep, i, &scene, error));
        if ((status = kd_plan_make(&scene, capacity, &plan, &inner))) {
            kd_error_field(error, inner.pointer, "scene %u: %.440s", i, inner.message);
            error->status = status;
            goto done;
        }
        KD_TRY(add(&sum, &scene, &plan, error));
    }
    if (kd_sweep_order_end(&sum.order, &sum.shared_ms) || write(sweep, &sum, out))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the plan"));
done:
    kd_sweep_order_finish(&sum.order);
    return status;
}
