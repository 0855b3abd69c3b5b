/* Writes a plan as JSON. */
#include "render/plan/plan.h"

#include "base/json.h"
#include "lens.h"

#include <math.h>

static void add_passes(struct kd_json *json, const struct kd_plan_cost *cost)
{
    kd_json_array(json, "passes");
    for (size_t i = 0; i < cost->n_passes; i++) {
        const struct kd_plan_pass *pass = &cost->passes[i];
        kd_json_object(json, NULL);
        kd_json_string(json, "name", pass->name);
        if (*pass->kernel)
            kd_json_string(json, "kernel", pass->kernel);
        kd_json_number(json, "invocations", (double)pass->invocations);
        kd_json_number(json, "estimate_ms", pass->estimate_ms);
        kd_json_end(json);
    }
    kd_json_end(json);
}

static void add_constants(struct kd_json *json, const struct kd_plan_lens *lens)
{
    kd_json_object(json, "specialisation");
    kd_json_number(json, "orders", lens->orders);
    kd_json_number(json, "steps", lens->setting.steps);
    kd_json_number(json, "samples", lens->side);
    kd_json_bool(json, "radius_only", kd_plan_is_radii(lens));
    kd_json_bool(json, "phi", kd_plan_holds(lens, KD_LENS_PHI));
    kd_json_bool(json, "sky", kd_plan_holds(lens, KD_LENS_SKY));
    kd_json_end(json);
}

static void add_accuracy(struct kd_json *json, const struct kd_plan *plan)
{
    const struct kd_setting *by = &plan->lens.setting;
    kd_json_object(json, "accuracy");
    kd_json_string(json, "engine", kd_engine_name(by->engine));
    kd_json_string(json, "precision", kd_precision_name(by->precision));
    kd_json_number(json, "steps", by->steps);
    if (isfinite(by->holds))
        kd_json_number(json, "holds", by->holds);
    kd_json_string(json, "table", plan->report.accuracy_measured ? "measured" : "built-in");
    kd_json_end(json);
}

static void add_bytes(struct kd_json *json, const struct kd_plan_cost *cost)
{
    kd_json_object(json, "bytes");
    kd_json_number(json, "lens_map", (double)cost->lens_bytes);
    kd_json_number(json, "device", (double)cost->device_bytes);
    kd_json_number(json, "host", (double)(cost->host_bytes + cost->making_bytes));
    kd_json_end(json);
}

enum kd_status kd_plan_to_json(const struct kd_plan *plan, struct kd_buffer *out)
{
    struct kd_json whole = kd_json_begin_lines(out), *json = &whole;
    kd_json_object(json, NULL);
    kd_json_number(json, "rays", (double)plan->lens.rays);
    kd_json_number(json, "critical_pixels", (double)plan->lens.critical_pixels);
    kd_json_number(json, "critical_rays", (double)(kd_plan_rays(&plan->lens) - plan->lens.rays));
    kd_json_number(json, "width", plan->picture.cut.width ? plan->picture.cut.width : plan->picture.width);
    if (plan->picture.eyes)
        kd_json_number(json, "eyes", plan->picture.eyes);
    kd_json_number(json, "height", kd_plan_shown_height(&plan->picture));
    if (plan->picture.strips)
        kd_json_number(json, "strips", plan->picture.strips);
    add_passes(json, &plan->cost);
    add_constants(json, &plan->lens);
    add_accuracy(json, plan);
    add_bytes(json, &plan->cost);
    kd_json_number(json, "bands", plan->picture.bands);
    kd_json_bool(json, "lens_map_cacheable", plan->lens.cacheable);
    kd_json_string(json, "lens_map_key", plan->lens.key);
    if (plan->cost.kernels_ms > 0)
        kd_json_number(json, "kernels_ms", plan->cost.kernels_ms);
    kd_json_number(json, "estimate_ms", plan->cost.estimate_ms + plan->cost.kernels_ms);
    kd_json_string(json, "estimate_basis", plan->report.measured ? "measured" : "guess");
    kd_json_array(json, "approximations");
    for (size_t i = 0; i < plan->report.n_approximations; i++)
        kd_json_string(json, NULL, plan->report.approximations[i].text);
    kd_json_end(json);
    kd_json_end(json);
    return kd_json_finish(json);
}
