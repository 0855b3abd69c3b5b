/* Self-test of listed rays by every engine: end points, deflections, and on which side of the critical curve a ray
 * is captured. */
#include "render/selftest/parts.h"

#include "render/device/device_internal.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ORDERS 3
#define COPIES 192 /* copies of each ray, so that several workgroups compute it */

struct engine {
    enum kd_engine engine;
    enum kd_precision precision;
    uint32_t steps; /* number of steps per half period */
};
static const struct engine engines[] = {
    { KD_ENGINE_CLOSED, KD_PRECISION_F64, 0 },
    { KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 16 },
    { KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 128 },
};
enum { ENGINES = sizeof engines / sizeof *engines };

/* The unit of allowed error. A number results from some tens of operations, each with an error up to the unit
 * roundoff. The steps of a method of order 6 add the method's error constant times (pi/steps)^6 for each half turn.
 * The constant was measured for these rays and has a margin of about ten. */
static double unit_of(const struct engine *e)
{
    double roundoff = e->precision == KD_PRECISION_F32 ? FLT_EPSILON / 2 : DBL_EPSILON / 2;
    return KD_SELFTEST_OPERATIONS * roundoff + (e->steps ? 1e-3 * pow(M_PI / e->steps, 6) : 0);
}

/* The unit of error at the ray's end. After the last crossing, frame dragging is integrated by Simpson's rule, of order
 * 4. */
static double end_unit_of(const struct engine *e)
{
    return unit_of(e) + (e->steps ? 2e-5 * pow(M_PI / e->steps, 4) : 0);
}

static void name_of(const struct engine *e, char out[32])
{
    snprintf(out, 32, "%s %s", kd_engine_name(e->engine), kd_precision_name(e->precision));
}

/* Traces the list of rays, ORDERS crossings each. */
static enum kd_status trace(const struct kd_selftest *test, const struct engine *e, const struct kd_selftest_ray *ray,
                            const double *list, size_t n, struct kd_ray_crossing *crossings, struct kd_ray_end *ends)
{
    const struct kd_rays_params params = {
        KD_HOLE_FROM(ray), .r = ray->radius,    .inclination_deg = ray->inclination_deg,
        .orders = ORDERS,  .engine = e->engine, .precision = e->precision,
        .steps = e->steps,
    };
    return kd_rays_trace(test->renderer, &params, list, n, crossings, ends, NULL, NULL, test->error);
}

enum { R, PHI, DELAY, G, SKY, QUANTITIES };
static const char *const quantities[QUANTITIES] = { "r (relative)", "phi (rad)", "delay (M)", "g (relative)",
                                                    "direction (rad)" };

static double turn(double x) { return remainder(x, 2 * M_PI); }

/* Compares with known numbers. Each bound is a unit of error, multiplied by the size of the summed terms plus the gain.
 * phi is a sum over half turns. delay is a sum of terms that are as large as the radius, or about 10 M near the
 * hole. */
static void judge(const struct kd_selftest_ray *ray, const struct engine *e, const struct kd_ray_crossing *crossings,
                  const struct kd_ray_end *end, struct kd_selftest_row rows[QUANTITIES])
{
    double unit = unit_of(e);
    bool right = end->fate == (ray->captured ? KD_RAY_CAPTURED : KD_RAY_ESCAPED) &&
                 end->n_crossings == (uint32_t)ray->n_crossings;
    if (!right)
        kd_selftest_compare(&rows[R], INFINITY, unit);
    for (int n = 0; n < ray->n_crossings && right; n++) {
        const struct kd_selftest_crossing *k = &ray->crossing[n];
        const struct kd_ray_crossing *c = &crossings[n];
        kd_selftest_compare(&rows[R], c->r / k->r - 1, unit * (1 + k->r_gain));
        kd_selftest_compare(&rows[PHI], c->phi - k->phi, unit * (M_PI * (n + 1) + k->phi_gain));
        kd_selftest_compare(&rows[DELAY], c->delay - k->delay, unit * (10 + k->r + fabs(k->delay) + k->delay_gain));
        kd_selftest_compare(&rows[G], c->g / k->g - 1, unit * (1 + k->g_gain));
    }
    if (right && !ray->captured)
        kd_selftest_compare(&rows[SKY], hypot(end->theta - ray->theta, sin(ray->theta) * turn(end->phi - ray->phi)),
                            end_unit_of(e) * (M_PI * (ray->n_crossings + 1) + ray->sky_gain));
}

struct copies {
    double list[2 * COPIES];
    struct kd_ray_crossing crossings[ORDERS * COPIES];
    struct kd_ray_end ends[COPIES];
};

/* Number of copies of a ray that differ from the first. */
static double differing(const struct copies *c)
{
    double sum = 0;
    for (size_t i = 1; i < COPIES; i++)
        sum += memcmp(c->crossings, c->crossings + ORDERS * i, sizeof *c->crossings * ORDERS) ||
               !kd_ray_ends_equal(c->ends, c->ends + i);
    return sum;
}

static enum kd_status ray_set(const struct kd_selftest *test, const struct engine *e, size_t first, size_t n,
                              struct copies *c, struct kd_selftest_row *same)
{
    struct kd_selftest_row rows[QUANTITIES];
    char by[32];
    name_of(e, by);
    for (int q = 0; q < QUANTITIES; q++)
        kd_selftest_begin(&rows[q], "equations of motion by Taylor series, 38 digits", by, "rays, %s: %s",
                          test->reference->rays[first].set, quantities[q]);
    for (size_t i = first; i < first + n; i++) {
        const struct kd_selftest_ray *ray = &test->reference->rays[i];
        for (size_t k = 0; k < COPIES; k++)
            memcpy(c->list + 2 * k, (double[]) { ray->alpha, ray->beta }, 2 * sizeof *c->list);
        enum kd_status status = trace(test, e, ray, c->list, COPIES, c->crossings, c->ends);
        if (status)
            return status;
        judge(ray, e, c->crossings, c->ends, rows);
        kd_selftest_compare(same, differing(c), 0);
    }
    for (int q = 0; q < QUANTITIES; q++) {
        enum kd_status status = rows[q].compared || q != SKY ? kd_selftest_end(test, &rows[q]) : KD_OK;
        if (status)
            return status;
    }
    return KD_OK;
}

static enum kd_status ends(const struct kd_selftest *test, const struct engine *e)
{
    const struct kd_selftest_reference *reference = test->reference;
    struct copies *c = malloc(sizeof *c);
    struct kd_selftest_row same;
    char by[32];
    name_of(e, by);
    kd_selftest_begin(&same, "each other", by, "rays: copies of %d that differ", COPIES);
    enum kd_status status;
    if (!c)
        KD_TRY(kd_error_set(test->error, KD_ENOMEM, "out of memory for the self-test"));
    for (size_t i = 0, n; i < reference->n_rays; i += n) {
        for (n = 1; i + n < reference->n_rays && !strcmp(reference->rays[i].set, reference->rays[i + n].set);)
            n++;
        KD_TRY(ray_set(test, e, i, n, c, &same));
    }
    KD_TRY(kd_selftest_end(test, &same));
done:
    free(c);
    return status;
}

/* Compares the azimuth of escape in the equatorial plane. */
static enum kd_status deflection(const struct kd_selftest *test, const struct engine *e)
{
    struct kd_selftest_row row;
    char by[32];
    name_of(e, by);
    kd_selftest_begin(&row, "quadrature of dphi/dr; Keeton & Petters 2005", by, "deflection in the plane (rad)");
    for (size_t i = 0; i < test->reference->n_deflections; i++) {
        const struct kd_selftest_deflection *d = &test->reference->deflections[i];
        const struct kd_selftest_ray ray = { .spin = d->spin, .radius = INFINITY, .inclination_deg = 90 };
        struct kd_ray_crossing crossings[ORDERS];
        struct kd_ray_end end;
        enum kd_status status = trace(test, e, &ray, (double[]) { -d->b, 0 }, 1, crossings, &end);
        if (status)
            return status;
        /* Light of lambda = b rotates towards +phi, from the source to the observer. */
        double error = end.fate == KD_RAY_ESCAPED ? turn(end.phi + d->phi) : NAN;
        kd_selftest_compare(&row, error, end_unit_of(e) * (fabs(d->phi) + d->gain));
    }
    return kd_selftest_end(test, &row);
}

#define NEAREST 60 /* number of distances, which differ by a quarter of a power of ten each */

/* Traces rays near a point of the critical curve, at 1 +- 10^(-k/4) of its distance, and finds the ray furthest from
 * the curve that has the wrong fate. Rays just inside and just outside diverge by a factor of e^pi each half turn.
 * An error of one unit in the constants, in E^2 = 1 or in a step shifts the curve by about one unit of b. */
static enum kd_status critical(const struct kd_selftest *test, const struct engine *e,
                               const struct kd_selftest_critical *p)
{
    const struct kd_selftest_ray ray = { .spin = p->spin, .radius = INFINITY, .inclination_deg = p->inclination_deg };
    double list[4 * NEAREST];
    struct kd_ray_crossing crossings[2 * NEAREST * ORDERS];
    struct kd_ray_end found[2 * NEAREST];
    struct kd_selftest_row row;
    char by[32];
    name_of(e, by);
    kd_selftest_begin(&row, p->spin == 0 ? "Hilbert 1917: b = 3 sqrt 3" : "Bardeen 1973: R = R' = 0, 38 digits", by,
                      "edge of the shadow, %s (relative)", p->name);
    for (int i = 0; i < 2 * NEAREST; i++) {
        double scale = 1 + (i & 1 ? 1 : -1) * pow(10, -0.25 * (i / 2 + 4));
        list[2 * i] = scale * p->alpha;
        list[2 * i + 1] = scale * p->beta;
    }
    enum kd_status status = trace(test, e, &ray, list, 2 * NEAREST, crossings, found);
    double wrong = 0;
    for (int i = 0; i < 2 * NEAREST; i++)
        if (found[i].fate != (i & 1 ? KD_RAY_ESCAPED : KD_RAY_CAPTURED))
            wrong = fmax(wrong, pow(10, -0.25 * (i / 2 + 4)));
    kd_selftest_compare(&row, wrong, unit_of(e));
    return status ? status : kd_selftest_end(test, &row);
}

enum kd_status kd_selftest_rays(const struct kd_selftest *test)
{
    bool wide = kd_vk_info(test->renderer->vk)->float64;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < ENGINES; i++) {
        const struct engine *e = &engines[i];
        if (e->engine != KD_ENGINE_CLOSED && e->precision == KD_PRECISION_F64 && !wide)
            continue;
        KD_TRY(ends(test, e));
        KD_TRY(deflection(test, e));
        for (size_t k = 0; k < test->reference->n_criticals; k++)
            KD_TRY(critical(test, e, &test->reference->criticals[k]));
    }
done:
    return status;
}
