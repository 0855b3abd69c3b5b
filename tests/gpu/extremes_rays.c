/* Tests of listed rays at the extremes, by the engine in Mino time in both precisions. They are compared with the
 * closed form and with their own stated errors. A result may be wrong only if the engine marks the ray as undecided or
 * states a large enough error. For observers at a finite radius, every second ray starts outwards. */
#include "extremes.h"

#include "physics/spacetime/kerr.h"
#include "render/rays/rays.h"
#include "render/rays/device.h"
#include "render/rays/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ORDERS = 8, RAYS = 192 };

struct view {
    double spin, inclination, r;
    double critical; /* above 0: rays are placed at this relative distance from the edge of the shadow */
    double charge;
};

struct list {
    size_t n;
    double alpha_beta[2 * RAYS];
    bool outward[RAYS];
    struct kd_null_path path[RAYS];
    struct kd_ray_crossing crossings[RAYS * ORDERS];
    struct kd_ray_end ends[RAYS];
};

static double turn(double x) { return fabs(remainder(x, 2 * M_PI)); }

static struct kd_null_ray ray_of(const struct view *v, const double *alpha_beta)
{
    double i = v->inclination;
    return (struct kd_null_ray) {
        .hole = kd_hole_charged(v->spin, v->charge),
        .radius = v->r,
        .cos_theta = extreme_cos_deg(i),
        .sin_theta = extreme_sin_deg(i),
        .alpha = alpha_beta[0],
        .beta = alpha_beta[1],
        .orders = ORDERS,
    };
}

static struct kd_rays_params params_of(const struct view *v, enum kd_precision precision)
{
    return (struct kd_rays_params) {
        .spin = v->spin,
        .charge = v->charge,
        .r = v->r,
        .inclination_deg = v->inclination,
        .orders = ORDERS,
        .engine = KD_ENGINE_MINO_RKN6,
        .precision = precision,
    };
}

static bool captured(const struct view *v, double alpha, double beta)
{
    struct kd_null_ray ray = ray_of(v, (double[]) { alpha, beta });
    return kd_null_trace_fast(&ray).fate == KD_NULL_CAPTURED;
}

/* Places a ray at a relative distance from the shadow's edge, in the direction of the angle t from a point inside the
 * shadow. */
static void near_critical(const struct view *v, double t, double distance, double *out)
{
    double middle = 2.4 * v->spin * sin(v->inclination * (M_PI / 180)), c = cos(t), s = sin(t), in = 0, edge = 12;
    for (;;) {
        double half = 0.5 * (in + edge);
        if (half == in || half == edge)
            break;
        *(captured(v, middle + half * c, half * s) ? &in : &edge) = half;
    }
    out[0] = middle + edge * (1 + distance) * c;
    out[1] = edge * (1 + distance) * s;
}

/* Places rays evenly over the image. A sixth of them are placed on its axes, next to the axes, or far out. */
static void make(const struct view *v, struct list *list)
{
    static const double special[] = { 0,     -0.0, 1e-12, -1e-12, 1e-310, 5e-324, -1e-40,
                                      1e-25, 1e7,  -1e7,  2,      -2,     7,      5.196152422706632 };
    enum { SPECIAL = sizeof special / sizeof *special };
    struct kd_rays_params params = params_of(v, KD_PRECISION_F64);
    double half = v->r < 3 ? 6 : 9;
    list->n = 0;
    for (size_t k = 0; k < RAYS; k++) {
        double *out = &list->alpha_beta[2 * list->n];
        out[0] = half * (2 * extreme_x(k) - 1);
        out[1] = half * (2 * extreme_y(k) - 1);
        if (v->critical > 0)
            near_critical(v, 2 * M_PI * extreme_x(k), k % 2 ? v->critical : -v->critical, out);
        else if (k % 6 == 0)
            out[k / 6 % 2] = special[k / 12 % SPECIAL];
        if (kd_rays_check(&params, out, 1, NULL))
            continue; /* skipped, because no light with these constants reaches the observer */
        struct kd_null_ray ray = ray_of(v, out);
        ray.outward = list->outward[list->n] = !isinf(v->r) && k % 2;
        list->path[list->n++] = kd_null_trace(&ray);
    }
}

static bool all_finite(const struct kd_ray_end *e, const struct kd_ray_crossing *c)
{
    bool told = e->n_crossings || e->fate == KD_RAY_ESCAPED; /* a ray without results need not state an error */
    bool ok = (isnan(e->error) ? !told : isfinite(e->error) && e->error >= 0) &&
              (e->fate != KD_RAY_ESCAPED || (isfinite(e->theta) && isfinite(e->phi)));
    for (uint32_t n = 0; n < e->n_crossings; n++)
        ok = ok && isfinite(c[n].r) && isfinite(c[n].phi) && isfinite(c[n].delay) && isfinite(c[n].g) && c[n].g >= 0;
    return ok;
}

struct tally {
    double r[RAYS * ORDERS], phi;
    size_t n;
};

/* Compares those crossings of a ray that the answer states to be accurate. fault: error of the expected values
 * themselves. */
static void judge_crossings(const struct view *v, const struct kd_null_path *p, const struct kd_ray_end *e,
                            const struct kd_ray_crossing *c, const double *gain, const double *phi_gain,
                            struct tally *t)
{
    for (int n = 0; n < p->crossings && n < (int)e->n_crossings; n++) {
        const struct kd_null_crossing *x = &p->crossing[n];
        double r = fmax(fabs(c[n].r / x->r - 1) - x->error_r, 0) / (1 + gain[n]);
        double phi = fmax(turn(c[n].phi - x->phi) - x->error_phi, 0) / (1 + phi_gain[n]);
        t->r[t->n++] = r;
        bool thrown = p->turned && p->fate == KD_NULL_CAPTURED; /* excluded; docs/accuracy.md gives the reason */
        if (x->r > 1.6 * kd_hole_charged(v->spin, v->charge).outer && !thrown)
            t->phi = fmax(t->phi, phi);
    }
}

static void judge(const struct view *v, const struct list *list, size_t k, struct tally *t, struct extreme_row *row)
{
    const struct kd_null_path *p = &list->path[k];
    const struct kd_ray_end *e = &list->ends[k];
    const struct kd_ray_crossing *c = &list->crossings[k * ORDERS];
    struct kd_null_ray ray = ray_of(v, &list->alpha_beta[2 * k]);
    ray.outward = list->outward[k];
    double gain[ORDERS], phi_gain[ORDERS], most = 0, off = 0;
    extreme_condition(&ray, p, v->critical > 0 ? fmin(1e-9, 0.1 * v->critical) : 1e-9, NULL, gain, phi_gain);
    for (int n = 0; n < p->crossings; n++)
        most = fmax(most, gain[n]);
    for (int n = 0; n < p->crossings && n < (int)e->n_crossings; n++)
        off = fmax(off, fabs(c[n].r / p->crossing[n].r - 1) - p->crossing[n].error_r);
    bool unsure = e->fate == KD_RAY_UNDECIDED || e->error > 0.01 || e->error > 1000 * row->bound * (1 + most);
    row->unsure += unsure;
    if (!all_finite(e, c)) {
        row->broken++;
        return;
    }
    if (p->status != KD_NULL_OK)
        return;
    row->loose += off > e->error;
    if (unsure)
        return;
    row->broken += (e->fate == KD_RAY_ESCAPED) != (p->fate == KD_NULL_ESCAPED) || (int)e->n_crossings != p->crossings;
    judge_crossings(v, p, e, c, gain, phi_gain, t);
}

static enum kd_status run(struct kd_renderer *renderer, const struct kd_rays_params *params, struct list *list,
                          struct kd_error *error)
{
    if (isinf(params->r))
        return kd_rays_trace(renderer, params, list->alpha_beta, list->n, list->crossings, list->ends, NULL, NULL,
                             error);
    struct kd_ray_labels labels = { list->alpha_beta, list->outward, list->n };
    enum kd_status status = kd_rays_device(renderer, params, &labels, list->crossings, list->ends, NULL, NULL, error);
    for (size_t i = 0; i < list->n * ORDERS; i++) /* sets the members that only kd_rays_trace fills in */
        list->crossings[i].g = 1;
    return status;
}

static void trace(struct kd_renderer *renderer, const struct view *v, const char *what, struct list *list,
                  enum kd_precision precision)
{
    static struct tally t;
    bool wide = precision == KD_PRECISION_F64;
    struct kd_rays_params params = params_of(v, precision);
    struct extreme_row row = { .engine = wide ? "mino-rkn6 f64" : "mino-rkn6 f32",
                               .rays = list->n,
                               .bound = wide ? 1e-11 : 2e-6,
                               .phi_bound = wide ? 1e-9 : 2e-6,
                               .unsure_most = 0.05 };
    struct kd_error error = { 0 };
    /* The bound is larger next to the horizon. There half a turn in latitude leads far out or back in, in the usual
     * number of steps. */
    if (v->r < 1.1 * kd_hole_charged(v->spin, v->charge).outer) {
        row.bound = wide ? 2e-8 : 1e-4;
        row.unsure_most = 0.1;
    }
    /* The smallest distance from the critical curve at which a precision can decide the fate of a ray. For extremal
     * holes this distance is larger, in proportion to the errors of the last digits. */
    if (v->critical > 0)
        row.unsure_most = v->critical < (wide ? 1e-8 : 1e-4) ? 1 : 0.25;
    snprintf(row.what, sizeof row.what, "%s", what);
    t.n = 0, t.phi = 0;
    if (list->n && run(renderer, &params, list, &error)) {
        printf("%s: %s\n", what, error.message);
        row.broken = list->n;
    } else {
        for (size_t k = 0; k < list->n; k++)
            judge(v, list, k, &t, &row);
    }
    extreme_spread(t.r, t.n, &row);
    row.phi = t.n ? t.phi : NAN;
    extreme_row(&row);
}

static void both(struct kd_renderer *renderer, const char *what, struct view v)
{
    static struct list list;
    make(&v, &list);
    trace(renderer, &v, what, &list, KD_PRECISION_F32);
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    if (capacity.float64)
        trace(renderer, &v, what, &list, KD_PRECISION_F64);
}

static const struct {
    const char *name;
    double a, q;
} spins[] = {
    { "a 0", 0 },
    { "a 5e-324", 5e-324 },
    { "a 0.9", 0.9 },
    { "a 1-1e-7", 0.9999999 },
    { "a 1-1e-12", 0.999999999999 },
    { "a -1+1e-12", -0.999999999999 },
    { "a 0.9, q 1e-300", 0.9, 1e-300 },
    { "q 1-1e-12", 0, 0.999999999999 },
    { "a 0.8, q 0.6-1e-12", 0.8, 0.599999999999 },
};
enum { SPINS = sizeof spins / sizeof *spins };

static void inclinations(struct kd_renderer *renderer)
{
    const struct {
        const char *name;
        double i;
    } angles[] = {
        { "i 0", 0 },
        { "i 0+", 5e-324 },
        { "i 45", 45 },
        { "i 90-", nextafter(90, 0) },
        { "i 90", 90 },
        { "i 90+", nextafter(90, 91) },
        { "i 180-", nextafter(180, 0) },
        { "i 180", 180 },
    };
    for (int a = 0; a < SPINS; a++)
        for (int i = 0; i < 8; i++) {
            char what[48];
            snprintf(what, sizeof what, "%s, %s", spins[a].name, angles[i].name);
            both(renderer, what, (struct view) { spins[a].a, angles[i].i, INFINITY, 0, spins[a].q });
        }
}

static void observers(struct kd_renderer *renderer)
{
    for (int a = 0; a < SPINS; a++) {
        const double spin = spins[a].a;
        const struct kd_hole hole = kd_hole_charged(spin, spins[a].q);
        const struct {
            const char *name;
            double r;
        } places[] = {
            { "1.000001 r+", 1.000001 * hole.outer },
            { "1.0001 r+", 1.0001 * hole.outer },
            { "r photon", kd_kerr_photon_orbit(&hole) },
            { "r photon, retrograde", kd_kerr_photon_orbit(kd_hole_turned(&hole, -1)) },
            { "r 1e6", 1e6 },
        };
        for (int k = 0; k < 2 * (int)(sizeof places / sizeof *places); k++) {
            char what[48];
            snprintf(what, sizeof what, "%s, i %d, %s", spins[a].name, k % 2 ? 90 : 60, places[k / 2].name);
            both(renderer, what, (struct view) { spin, k % 2 ? 90 : 60, places[k / 2].r, 0, spins[a].q });
        }
    }
}

static void critical_rays(struct kd_renderer *renderer)
{
    for (int a = 0; a < SPINS; a++)
        for (int k = 3; k <= 12 && spins[a].a != 5e-324; k++) {
            char what[48];
            snprintf(what, sizeof what, "%s, i %d, b/bc 1+-1e-%d", spins[a].name, k % 2 ? 60 : 90, k);
            both(renderer, what, (struct view) { spins[a].a, k % 2 ? 60 : 90, INFINITY, pow(10, -k), spins[a].q });
        }
}

void extreme_rays(struct kd_renderer *renderer)
{
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    if (!capacity.float64)
        printf("SKIP: mino-rkn6 f64: the device has no double precision\n");
    inclinations(renderer);
    observers(renderer);
    critical_rays(renderer);
}
