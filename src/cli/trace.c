#include "cli/trace.h"

#include "base/decimal.h"
#include "physics/math/angle.h"
#include "render/explain/steps.h"
#include "render/rays/closed.h"

#include <math.h>
#include <stdio.h>

enum kd_status kd_trace_explain(const struct kd_rays_steps *steps, bool points, struct kd_described_steps *out,
                                struct kd_error *error)
{
    const double alpha_beta[] = { steps->alpha, steps->beta };
    const struct kd_ray_labels labels = { alpha_beta, NULL, 1 };
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS];
    *out = (struct kd_described_steps) { .steps = steps, .points = points };
    const struct kd_null_ray ray = {
        .hole = kd_rays_hole(&steps->params),
        .radius = steps->params.r,
        .cos_theta = kd_cos_deg(steps->params.inclination_deg),
        .sin_theta = kd_sin_deg(steps->params.inclination_deg),
        .alpha = steps->alpha,
        .beta = steps->beta,
        .orders = (int)steps->params.orders,
    };
    enum kd_status status;
    KD_TRY(kd_rays_closed(&steps->params, &labels, KD_CLOSED_ERRORS, crossings, &out->end, NULL, NULL, error));
    out->motion = kd_ray_motion_of(&ray);
    KD_TRY(kd_ray_path_draw(&out->motion, &(struct kd_ray_path_frame) { 0 }, crossings, out->end.n_crossings,
                            &out->path, error));
    const int n = kd_ray_motion_why(&out->motion, out->end.fate, out->why, sizeof out->why);
    if (steps->end.fate != out->end.fate)
        snprintf(out->why + n, sizeof out->why - (size_t)n, " The engine's result differs: %s.",
                 kd_ray_fate_name(steps->end.fate));
done:
    return status;
}

void kd_trace_finish(struct kd_described_steps *trace) { kd_ray_path_finish(&trace->path); }

/* Writes a value. Residuals get few digits, and other values get the digits of their precision. */
static enum kd_status put_cell(const struct kd_rays_steps *steps, const struct kd_steps_column *column, double x,
                               struct kd_buffer *out)
{
    bool wide = steps->params.precision == KD_PRECISION_F64,
         residual = column->name[0] == 'r' && column->name[1] == 'e';
    if (!isfinite(x))
        return kd_buffer_printf(out, " %*s", residual ? 8 : wide ? 18 : 14, "-");
    return residual ? kd_buffer_printf(out, " %8.1e", x)
                    : kd_buffer_printf(out, " %*.*g", wide ? 18 : 14, wide ? 11 : 7, x);
}

static enum kd_status put_text_row(const struct kd_rays_steps *steps, const struct kd_rays_step *step,
                                   struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%6u %-8s %5u", step->number, kd_steps_stage(step), step->order));
    for (const struct kd_steps_column *c = kd_steps_columns(steps); c->name; c++)
        KD_TRY(put_cell(steps, c, kd_steps_value(step, c), out));
    KD_TRY(kd_buffer_printf(out, "\n"));
done:
    return status;
}

static enum kd_status put_verdict(const struct kd_described_steps *trace, struct kd_buffer *out)
{
    const struct kd_rays_steps *steps = trace->steps;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s, crossings %u", kd_ray_fate_name(steps->end.fate), steps->end.n_crossings));
    if (isfinite(steps->end.theta))
        KD_TRY(kd_buffer_printf(out, ", from theta %.11g, phi %.11g", steps->end.theta, steps->end.phi));
    if (isfinite(steps->end.error))
        KD_TRY(kd_buffer_printf(out, ", estimated error %.1e", steps->end.error));
    if (steps->lost)
        KD_TRY(kd_buffer_printf(out, "\n%zu more steps are not shown", steps->lost));
    KD_TRY(
        kd_buffer_printf(out, "\n%s\nwithout --trace the device gives %s\n", trace->why,
                         steps->same ? "the same, bit for bit" : "DIFFERENT numbers: it took other steps than these"));
done:
    return status;
}

static enum kd_status put_steps(const struct kd_rays_steps *steps, struct kd_buffer *out)
{
    const bool wide = steps->params.precision == KD_PRECISION_F64;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%6s %-8s %5s", "number", "stage", "order"));
    for (const struct kd_steps_column *c = kd_steps_columns(steps); c->name; c++)
        KD_TRY(kd_buffer_printf(out, " %*s", c->name[0] == 'r' && c->name[1] == 'e' ? 8 : wide ? 18 : 14, c->name));
    KD_TRY(kd_buffer_printf(out, "\n"));
    for (size_t i = 0; i < steps->n; i++)
        KD_TRY(put_text_row(steps, &steps->steps[i], out));
done:
    return status;
}

static enum kd_status put_points(const struct kd_ray_path *path, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (size_t k = 0; k < KD_PATH_COLUMNS && !status; k++)
        status = kd_buffer_printf(out, " %15s%s", kd_ray_path_columns[k], k + 1 < KD_PATH_COLUMNS ? "" : "\n");
    for (size_t i = 0; i < path->course.n && !status; i++) {
        double row[KD_PATH_COLUMNS];
        kd_ray_path_row(path, i, row);
        for (size_t k = 0; k < KD_PATH_COLUMNS && !status; k++)
            status = kd_buffer_printf(out, " %15.9g%s", row[k], k + 1 < KD_PATH_COLUMNS ? "" : "\n");
    }
    return status;
}

/* Writes a parameter of the hole, unless it is 0. */
static enum kd_status put_parameter(struct kd_buffer *out, const char *name, double value)
{
    char text[KD_DECIMAL_SIZE];
    kd_decimal_print(text, value);
    return value != 0 ? kd_buffer_printf(out, ", %s %s", name, text) : KD_OK;
}

enum kd_status kd_trace_text(const struct kd_described_steps *trace, struct kd_buffer *out)
{
    const struct kd_rays_steps *steps = trace->steps;
    const struct kd_rays_params *p = &steps->params;
    const double numbers[] = { steps->alpha, steps->beta, p->spin, p->inclination_deg, p->r };
    char given[sizeof numbers / sizeof *numbers][KD_DECIMAL_SIZE];
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        kd_decimal_print(given[i], numbers[i]);
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "alpha %s, beta %s; spin %s", given[0], given[1], given[2]));
#define MORE(x, name, ...) KD_TRY(put_parameter(out, #name, p->name));
    KD_HOLE_MORE(MORE, )
#undef MORE
    KD_TRY(kd_buffer_printf(out, ", inclination %s, r %s; ", given[3], isinf(p->r) ? "infinity" : given[4]));
    KD_TRY(kd_buffer_printf(out, "%s %s, %u steps a half period\n", kd_engine_name(p->engine),
                            kd_precision_name(p->precision), p->steps));
    KD_TRY(kd_ray_motion_text(&trace->motion, out));
    KD_TRY(trace->points ? put_points(&trace->path, out) : put_steps(steps, out));
    KD_TRY(put_verdict(trace, out));
done:
    return status;
}

/* Writes a number, or nothing if it is not finite. */
static void put_member(struct kd_json *json, const char *name, double x)
{
    if (isfinite(x))
        kd_json_number(json, name, x);
}

static void put_json_step(struct kd_json *json, const struct kd_rays_steps *steps, const struct kd_rays_step *step)
{
    kd_json_object(json, NULL);
    kd_json_number(json, "number", step->number);
    kd_json_string(json, "stage", kd_steps_stage(step));
    kd_json_number(json, "order", step->order);
    for (const struct kd_steps_column *c = kd_steps_columns(steps); c->name; c++)
        put_member(json, c->name, kd_steps_value(step, c));
    kd_json_end(json);
}

enum kd_status kd_trace_json(const struct kd_described_steps *trace, struct kd_buffer *out)
{
    const struct kd_rays_steps *steps = trace->steps;
    const struct kd_rays_params *p = &steps->params;
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "engine", kd_engine_name(p->engine));
    kd_json_string(&json, "precision", kd_precision_name(p->precision));
    const struct {
        const char *name;
        double x;
    } members[] = {
        { "steps_a_half_period", p->steps },
        { "orders", p->orders },
        { "spin", p->spin },
#define MORE(x, of, ...) { #of, p->of },
        KD_HOLE_MORE(MORE, )
#undef MORE
            { "inclination_deg", p->inclination_deg },
        { "r", p->r }, /* if the ray comes from infinity, r is infinite and is left out */
        { "alpha", steps->alpha },
        { "beta", steps->beta },
        { "lambda", trace->motion.lambda },
        { "eta", trace->motion.eta },
        { "sky_theta", steps->end.theta },
        { "sky_phi", steps->end.phi },
        { "error", steps->end.error },
    };
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        put_member(&json, members[i].name, members[i].x);
    kd_ray_motion_json(&json, &trace->motion);
    kd_json_string(&json, "fate", kd_ray_fate_name(steps->end.fate));
    kd_json_string(&json, "why", trace->why);
    kd_json_number(&json, "crossings", steps->end.n_crossings);
    kd_json_number(&json, "not_shown", (double)steps->lost);
    kd_json_bool(&json, "same_without_trace", steps->same);
    kd_json_array(&json, "steps");
    for (size_t i = 0; i < steps->n; i++)
        put_json_step(&json, steps, &steps->steps[i]);
    kd_json_end(&json);
    kd_ray_path_json(&json, &trace->path);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

static enum kd_status put_csv_row(const struct kd_rays_steps *steps, const struct kd_rays_step *step,
                                  struct kd_buffer *out)
{
    char text[KD_DECIMAL_SIZE];
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%u,%s,%u", step->number, kd_steps_stage(step), step->order));
    for (const struct kd_steps_column *c = kd_steps_columns(steps); c->name; c++) {
        double x = kd_steps_value(step, c);
        text[0] = '\0';
        if (isfinite(x))
            kd_decimal_print(text, x);
        KD_TRY(kd_buffer_printf(out, ",%s", text));
    }
    KD_TRY(kd_buffer_printf(out, "\n"));
done:
    return status;
}

static enum kd_status put_csv_points(const struct kd_ray_path *path, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (size_t k = 0; k < KD_PATH_COLUMNS && !status; k++)
        status = kd_buffer_printf(out, "%s%s", k ? "," : "", kd_ray_path_columns[k]);
    for (size_t i = 0; i < path->course.n && !status; i++) {
        double row[KD_PATH_COLUMNS];
        kd_ray_path_row(path, i, row);
        for (size_t k = 0; k < KD_PATH_COLUMNS && !status; k++) {
            char text[KD_DECIMAL_SIZE];
            kd_decimal_print(text, row[k]);
            status = kd_buffer_printf(out, "%s%s", k ? "," : "\n", text);
        }
    }
    return status ? status : kd_buffer_printf(out, "\n");
}

enum kd_status kd_trace_csv(const struct kd_described_steps *trace, struct kd_buffer *out)
{
    const struct kd_rays_steps *steps = trace->steps;
    enum kd_status status;
    if (trace->points)
        return put_csv_points(&trace->path, out);
    KD_TRY(kd_buffer_printf(out, "number,stage,order"));
    for (const struct kd_steps_column *c = kd_steps_columns(steps); c->name; c++)
        KD_TRY(kd_buffer_printf(out, ",%s", c->name));
    KD_TRY(kd_buffer_printf(out, "\n"));
    for (size_t i = 0; i < steps->n; i++)
        KD_TRY(put_csv_row(steps, &steps->steps[i], out));
done:
    return status;
}
