#include "render/explain/steps.h"

#include <math.h>

#define C(name) { #name, offsetof(struct kd_rays_step, name) }
static const struct kd_steps_column mino[] = { C(time),  C(r),      C(w),     C(dw),    C(u),     C(du),
                                               C(n_x),   C(n_y),    C(phi),   C(delay), C(res_w), C(res_u),
                                               C(res_n), C(res_dn), C(res_l), { 0 } };
static const struct kd_steps_column kerr_schild[] = { C(time), C(r),   C(u),   C(phi),      C(x),     C(y), C(z),
                                                      C(p_x),  C(p_y), C(p_z), C(res_null), C(res_l), { 0 } };
#undef C

const struct kd_steps_column *kd_steps_columns(const struct kd_rays_steps *steps)
{
    return steps->params.engine >= KD_ENGINE_KS_EULER ? kerr_schild : mino;
}

double kd_steps_value(const struct kd_rays_step *step, const struct kd_steps_column *column)
{
    return *(const double *)((const char *)step + column->at);
}

const char *kd_steps_stage(const struct kd_rays_step *step)
{
    static const char *const names[] = { "start", "step", "crossing", "end" };
    return names[step->stage];
}

static void put_step(struct kd_json *json, const struct kd_steps_column *columns, const struct kd_rays_step *step)
{
    kd_json_array(json, NULL);
    kd_json_number(json, NULL, step->number);
    kd_json_string(json, NULL, kd_steps_stage(step));
    kd_json_number(json, NULL, step->order);
    for (const struct kd_steps_column *c = columns; c->name; c++)
        kd_json_number(json, NULL, kd_steps_value(step, c)); /* NAN becomes null */
    kd_json_end(json);
}

void kd_steps_json(struct kd_json *json, const struct kd_rays_steps *steps)
{
    const struct kd_steps_column *columns = kd_steps_columns(steps);
    kd_json_object(json, "trace");
    kd_json_string(json, "engine", kd_engine_name(steps->params.engine));
    kd_json_string(json, "precision", kd_precision_name(steps->params.precision));
    kd_json_number(json, "steps_a_half_period", steps->params.steps);
    kd_json_string(json, "fate", kd_ray_fate_name(steps->end.fate));
    kd_json_number(json, "crossings", steps->end.n_crossings);
    kd_json_number(json, "not_shown", (double)steps->lost);
    kd_json_bool(json, "same_without_trace", steps->same);
    kd_json_array(json, "columns");
    kd_json_string(json, NULL, "number");
    kd_json_string(json, NULL, "stage");
    kd_json_string(json, NULL, "order");
    for (const struct kd_steps_column *c = columns; c->name; c++)
        kd_json_string(json, NULL, c->name);
    kd_json_end(json);
    kd_json_array(json, "steps");
    for (size_t i = 0; i < steps->n; i++)
        put_step(json, columns, &steps->steps[i]);
    kd_json_end(json);
    kd_json_end(json);
}
