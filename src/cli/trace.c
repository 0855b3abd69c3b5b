#include "cli/trace.h"

#include "base/decimal.h"

#include <math.h>
#include <stddef.h>

struct column { const char *name; size_t at; };
#define C(name) { #name, offsetof(struct kd_rays_step, name) }
static const struct column mino[] = { C(time), C(r), C(w), C(dw), C(u), C(du), C(n_x), C(n_y), C(phi), C(delay), C(res_w), C(res_u),
                                      C(res_n), C(res_dn), C(res_l), { 0 } };
static const struct column kerr_schild[] = { C(time), C(r), C(u), C(phi), C(x), C(y), C(z), C(p_x), C(p_y), C(p_z), C(res_null),
                                             C(res_l), { 0 } };
#undef C

static const struct column *columns_of(const struct kd_rays_steps *steps)
{
    return steps->params.engine >= KD_ENGINE_KS_EULER ? kerr_schild : mino;
}

static double value(const struct kd_rays_step *step, const struct column *column)
{
    return *(const double *)((const char *)step + column->at);
}

static const char *stage_name(const struct kd_rays_step *step)
{
    static const char *const names[] = { "start", "step", "crossing", "end" };
    return names[step->stage];
}

static const char *fate_name(const struct kd_rays_steps *steps)
{
    static const char *const names[] = { "captured", "escaped", "undecided" };
    return names[steps->end.fate];
}

/* Prints residuals by their size, and all else to as many digits as the precision has. */
static enum kd_status put_cell(const struct kd_rays_steps *steps, const struct column *column, double x, struct kd_buffer *out)
{
    bool wide = steps->params.precision == KD_PRECISION_F64, residual = column->name[0] == 'r' && column->name[1] == 'e';
    if (!isfinite(x))
        return kd_buffer_printf(out, " %*s", residual ? 8 : wide ? 18 : 14, "-");
    return residual ? kd_buffer_printf(out, " %8.1e", x) : kd_buffer_printf(out, " %*.*g", wide ? 18 : 14, wide ? 11 : 7, x);
}

static enum kd_status put_text_row(const struct kd_rays_steps *steps, const struct kd_rays_step *step, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%6u %-8s %5u", step->number, stage_name(step), step->order));
    for (const struct column *c = columns_of(steps); c->name; c++)
        KD_TRY(put_cell(steps, c, value(step, c), out));
    KD_TRY(kd_buffer_printf(out, "\n"));
done:
    return status;
}

static enum kd_status put_verdict(const struct kd_rays_steps *steps, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s, crossings %u", fate_name(steps), steps->end.n_crossings));
    if (isfinite(steps->end.theta))
        KD_TRY(kd_buffer_printf(out, ", from theta %.11g, phi %.11g", steps->end.theta, steps->end.phi));
    if (isfinite(steps->end.error))
        KD_TRY(kd_buffer_printf(out, ", estimated error %.1e", steps->end.error));
    if (steps->lost)
        KD_TRY(kd_buffer_printf(out, "\n%zu more steps are not shown", steps->lost));
    KD_TRY(kd_buffer_printf(out, "\nwithout --trace the device gives %s\n",
                   steps->same ? "the same, bit for bit" : "OTHER numbers: these steps are not quite those"));
done:
    return status;
}

enum kd_status kd_trace_text(const struct kd_rays_steps *steps, struct kd_buffer *out)
{
    const struct kd_rays_params *p = &steps->params;
    bool wide = p->precision == KD_PRECISION_F64;
    const double numbers[] = { steps->alpha, steps->beta, p->spin, p->inclination_deg, p->r };
    char given[sizeof numbers / sizeof *numbers][KD_DECIMAL_SIZE];
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        kd_decimal_print(given[i], numbers[i]);
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "alpha %s, beta %s; spin %s, inclination %s, r %s; ", given[0], given[1],
                            given[2], given[3], isinf(p->r) ? "infinity" : given[4]));
    KD_TRY(kd_buffer_printf(out, "%s %s, %u steps a half period\n%6s %-8s %5s", kd_engine_name(p->engine),
                            kd_precision_name(p->precision), p->steps, "number", "stage", "order"));
    for (const struct column *c = columns_of(steps); c->name; c++)
        KD_TRY(kd_buffer_printf(out, " %*s", c->name[0] == 'r' && c->name[1] == 'e' ? 8 : wide ? 18 : 14, c->name));
    KD_TRY(kd_buffer_printf(out, "\n"));
    for (size_t i = 0; i < steps->n; i++)
        KD_TRY(put_text_row(steps, &steps->steps[i], out));
    KD_TRY(put_verdict(steps, out));
done:
    return status;
}

/* "name":number, with a comma before it; nothing for a number that does not exist. */
static enum kd_status put_member(const char *name, double x, struct kd_buffer *out)
{
    char text[KD_DECIMAL_SIZE];
    if (!isfinite(x))
        return KD_OK;
    kd_decimal_print(text, x);
    return kd_buffer_printf(out, ",\"%s\":%s", name, text);
}

static enum kd_status put_json_step(const struct kd_rays_steps *steps, size_t i, struct kd_buffer *out)
{
    const struct kd_rays_step *step = &steps->steps[i];
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s{\"number\":%u,\"stage\":\"%s\",\"order\":%u", i ? "," : "", step->number,
                            stage_name(step), step->order));
    for (const struct column *c = columns_of(steps); c->name; c++)
        KD_TRY(put_member(c->name, value(step, c), out));
    KD_TRY(kd_buffer_printf(out, "}"));
done:
    return status;
}

enum kd_status kd_trace_json(const struct kd_rays_steps *steps, struct kd_buffer *out)
{
    const struct kd_rays_params *p = &steps->params;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "{\"engine\":\"%s\",\"precision\":\"%s\"", kd_engine_name(p->engine), kd_precision_name(p->precision)));
    KD_TRY(kd_buffer_printf(out, ",\"steps_a_half_period\":%u,\"orders\":%u", p->steps, p->orders));
    const struct { const char *name; double x; } members[] = {
        { "spin", p->spin }, { "inclination_deg", p->inclination_deg }, { "r", p->r }, /* without r: from infinity */
        { "alpha", steps->alpha }, { "beta", steps->beta }, { "sky_theta", steps->end.theta }, { "sky_phi", steps->end.phi },
        { "error", steps->end.error },
    };
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        KD_TRY(put_member(members[i].name, members[i].x, out));
    KD_TRY(kd_buffer_printf(out, ",\"fate\":\"%s\",\"crossings\":%u,\"not_shown\":%zu,\"same_without_trace\":%s,\"steps\":[",
                            fate_name(steps), steps->end.n_crossings, steps->lost, steps->same ? "true" : "false"));
    for (size_t i = 0; i < steps->n; i++)
        KD_TRY(put_json_step(steps, i, out));
    KD_TRY(kd_buffer_printf(out, "]}\n"));
done:
    return status;
}

static enum kd_status put_csv_row(const struct kd_rays_steps *steps, const struct kd_rays_step *step, struct kd_buffer *out)
{
    char text[KD_DECIMAL_SIZE];
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%u,%s,%u", step->number, stage_name(step), step->order));
    for (const struct column *c = columns_of(steps); c->name; c++) {
        double x = value(step, c);
        text[0] = '\0';
        if (isfinite(x))
            kd_decimal_print(text, x);
        KD_TRY(kd_buffer_printf(out, ",%s", text));
    }
    KD_TRY(kd_buffer_printf(out, "\n"));
done:
    return status;
}

enum kd_status kd_trace_csv(const struct kd_rays_steps *steps, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "number,stage,order"));
    for (const struct column *c = columns_of(steps); c->name; c++)
        KD_TRY(kd_buffer_printf(out, ",%s", c->name));
    KD_TRY(kd_buffer_printf(out, "\n"));
    for (size_t i = 0; i < steps->n; i++)
        KD_TRY(put_csv_row(steps, &steps->steps[i], out));
done:
    return status;
}
