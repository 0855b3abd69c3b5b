#include "render/rays/steps.h"

#include "interface.h"
#include "render/device/device_internal.h"
#include "render/rays/check.h"
#include "render/rays/device.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The constants that kernels write before the records. */
struct constants { double count, momentum, q, energy2, a2, k, d, pad; };
struct record { double stage, h, y[4], dy[4], chi; };
_Static_assert(sizeof(struct constants) == KD_TRACE_HEADER * sizeof(double), "the header of interface.h");
_Static_assert(sizeof(struct record) == KD_TRACE_RECORD * sizeof(double), "the record of interface.h");

static struct kd_rays_step nothing(void)
{
    struct kd_rays_step s = { .stage = KD_STAGE_START };
    for (double *x = &s.time; x <= &s.res_null; x++)
        *x = NAN;
    return s;
}

static double radial(const struct constants *c, double w, double dw)
{
    return dw * dw - (1 + w * w * (c->a2 + w * (2 * c->k - c->d * w)));
}

/* The azimuth, source minus observer, reduced to half a turn either way. */
static double azimuth(double y, double x, double chi) { return 0 + remainder(-(atan2(y, x) + chi), 2 * M_PI); }

/* Unpacks a record in Mino time. The record holds n and w, but u and w on the way to a crossing. */
static void mino(const struct constants *c, const struct record *r, struct kd_rays_step *s)
{
    const double *n = r->y, *v = r->dy;
    s->w = n[3], s->dw = v[3], s->u = n[2], s->du = v[2];
    s->r = 1 / s->w;
    s->res_w = radial(c, s->w, s->dw);
    if (r->stage >= 0) {
        s->res_u = s->du * s->du - (c->q + s->u * s->u * (c->a2 - c->energy2 * s->u * s->u));
        return;
    }
    s->n_x = n[0], s->n_y = n[1];
    s->phi = azimuth(n[1], n[0], r->chi);
    s->res_n = n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1;
    s->res_dn = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - (c->q + c->momentum * c->momentum + c->energy2 * n[2] * n[2]);
    s->res_l = n[0] * v[1] - n[1] * v[0] - c->momentum;
}

/* Kerr-Schild minus Boyer-Lindquist azimuth: atan2(a, r) minus the integral of a/Delta from infinity. */
static double drag(const struct kd_hole *hole, double r)
{
    const double a = hole->a, root = hole->root;
    return root > 0 ? a / (2 * root) * log1p(2 * root / (r - 1 - root)) : a / (r - 1);
}

/* Unpacks a record in Kerr-Schild coordinates. The Hamiltonian of rays_kerr_schild.comp is implemented here a second
 * time. momentum: L at the start. */
static void kerr_schild(const struct kd_hole *hole, double momentum, const struct record *record,
                        struct kd_rays_step *s)
{
    const double a = hole->a;
    const double *x = record->y, *p = record->dy;
    double rho2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - a * a;
    double r2 = 0.5 * (rho2 + sqrt(rho2 * rho2 + 4 * a * a * x[2] * x[2])), r = sqrt(r2), q = r2 + a * a;
    double lp = ((r * x[0] + a * x[1]) * p[0] + (r * x[1] - a * x[0]) * p[1]) / q + x[2] * p[2] / r;
    s->x = x[0], s->y = x[1], s->z = x[2], s->p_x = p[0], s->p_y = p[1], s->p_z = p[2];
    s->r = r, s->w = 1 / r, s->u = x[2] / r;
    s->phi = azimuth(x[1], x[0], drag(hole, r) - atan2(a, r));
    s->res_null = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1 -
                  kd_hole_mass(hole, r) * r2 / (r2 * r2 + a * a * x[2] * x[2]) * (1 + lp) * (1 + lp);
    s->res_l = x[0] * p[1] - x[1] * p[0] - momentum;
}

static bool is_kerr_schild(const struct kd_rays_params *p) { return p->engine >= KD_ENGINE_KS_EULER; }

/* Sets the stages and numbers of the records, which are in the order of the path. Sets the crossings from the end
 * points. */
static void tell(struct kd_rays_steps *out, const struct constants *c, const struct record *records)
{
    const struct kd_hole hole = kd_rays_hole(&out->params);
    /* time: Mino time of the current record; crossed: Mino time of the last crossing */
    double time = 0, crossed = 0, momentum = 0;
    unsigned number = 0, order = 0;
    for (size_t i = 0; i < out->n; i++) {
        const struct record *r = &records[i];
        struct kd_rays_step *s = &out->steps[i];
        *s = nothing();
        s->stage = r->stage == KD_TRACE_START      ? KD_STAGE_START
                   : r->stage == KD_TRACE_CROSSING ? KD_STAGE_CROSSING
                   : r->stage == KD_TRACE_END      ? KD_STAGE_END
                                                   : KD_STAGE_STEP;
        if (s->stage == KD_STAGE_END && out->steps[i - 1].stage == KD_STAGE_STEP)
            /* the time goes back to the last crossing, because steps towards a crossing that does not exist are
             * discarded */
            time = crossed;
        s->time = time += r->h;
        if (s->stage == KD_STAGE_CROSSING)
            crossed = time;
        s->number = number += s->stage == KD_STAGE_STEP || s->stage == KD_STAGE_END;
        if (is_kerr_schild(&out->params)) {
            momentum = i ? momentum : r->y[0] * r->dy[1] - r->y[1] * r->dy[0];
            kerr_schild(&hole, momentum, r, s);
        } else {
            mino(c, r, s);
        }
        s->order = s->stage == KD_STAGE_STEP ? (unsigned)r->stage : order;
        if (s->stage == KD_STAGE_CROSSING) {
            s->phi = out->crossings[order].phi;
            s->delay = out->crossings[order].delay;
            order++;
        }
    }
}

/* Traces the ray again by the kernel without recording, and compares the ends. */
static enum kd_status compare(struct kd_renderer *renderer, struct kd_rays_steps *out, struct kd_error *error)
{
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS];
    struct kd_ray_end end;
    const struct kd_ray_labels ray = { (double[]) { out->alpha, out->beta }, &out->outward, 1 };
    enum kd_status status = kd_rays_device(renderer, &out->params, &ray, crossings, &end, NULL, NULL, error);
    out->same = !status && kd_ray_ends_equal(&end, &out->end) &&
                !memcmp(crossings, out->crossings, out->params.orders * sizeof *crossings);
    return status;
}

enum kd_status kd_rays_steps_ask(struct kd_renderer *renderer, const struct kd_rays_params *params)
{
    const enum kd_status status = kd_rays_device_ask(renderer, params, true);
    return status ? status : kd_rays_device_ask(renderer, params, false); /* also requests the kernel of compare() */
}

/* Number of records for which there is room: twice those of the longest ray by any method. */
static size_t room(const struct kd_rays_params *p)
{
    return KD_TRACE_HEADER + KD_TRACE_RECORD * (size_t)(64 * p->steps + 64);
}

enum kd_status kd_rays_steps(struct kd_renderer *renderer, const struct kd_rays_params *params,
                             const struct kd_ray_labels *ray, struct kd_rays_steps *out, struct kd_error *error)
{
    *out = (struct kd_rays_steps) { .params = *params,
                                    .alpha = ray->alpha_beta[0],
                                    .beta = ray->alpha_beta[1],
                                    .outward = ray->outward && *ray->outward };
    double *numbers = NULL;
    enum kd_status status;
    KD_TRY(kd_rays_check(params, ray->alpha_beta, 1, error));
    if (params->engine == KD_ENGINE_CLOSED)
        return kd_error_field(error, "/accuracy/engine",
                              "engine is \"closed\", which takes no steps; it must be an engine of the device");
    out->params.steps = params->steps ? params->steps : kd_engine_steps(params->engine, params->precision);
    size_t most = room(&out->params);
    if (!(numbers = calloc(most, sizeof *numbers)))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the steps"));
    KD_TRY(kd_rays_device_told(renderer, &out->params, ray, out->crossings, &out->end, numbers, most, error));
    const struct constants *c = (const struct constants *)numbers;
    size_t kept = (most - KD_TRACE_HEADER) / KD_TRACE_RECORD, count = (size_t)c->count;
    out->n = count < kept ? count : kept;
    out->lost = count - out->n;
    if (!(out->steps = malloc((out->n + 1) * sizeof *out->steps)))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the steps"));
    tell(out, c, (const struct record *)(numbers + KD_TRACE_HEADER));
    KD_TRY(compare(renderer, out, error));
done:
    free(numbers);
    return status;
}
