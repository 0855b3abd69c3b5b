#include "render/accuracy/sets.h"

#include "physics/null/critical.h"

#include <math.h>
#include <stdbool.h>

const char *const kd_accuracy_set_names[KD_ACCURACY_SETS] = {
    [KD_ACCURACY_BULK] = "bulk",
    [KD_ACCURACY_NEAR_CRITICAL] = "near-critical",
    [KD_ACCURACY_NEAR_AXIS] = "near-axis",
    [KD_ACCURACY_EDGE_ON] = "edge-on",
    [KD_ACCURACY_NEAR_EXTREMAL] = "near-extremal",
};

const char *const kd_accuracy_set_rays[KD_ACCURACY_SETS] = {
    [KD_ACCURACY_BULK] = "a = 0.9, i = 70°, ±12 M",
    [KD_ACCURACY_NEAR_CRITICAL] =
        "a = 0.9, i = 70°, |ρ/ρ_c - 1| = 5e-2, 5e-3, ... 5e-6 on both sides of the critical curve",
    [KD_ACCURACY_NEAR_AXIS] =
        "a = 0.9: half i = 0.001°, ±12 M; half i = 70°, α = 0, ±1e-12, ... ±1e-2 M, β within ±12 M",
    [KD_ACCURACY_EDGE_ON] = "a = 0.9: half i = 90°, half i = 89.99°, ±12 M",
    [KD_ACCURACY_NEAR_EXTREMAL] = "a = 0.9999, i = 70°, ±12 M",
};

#define HALF 12.0 /* half the side of the image plane, M */
#define NEAR 0.05

uint32_t kd_accuracy_views(enum kd_accuracy_set set, struct kd_accuracy_view out[KD_ACCURACY_VIEWS])
{
    out[0] = (struct kd_accuracy_view) { .spin = 0.9, .inclination_deg = 70 };
    out[1] = out[0];
    switch (set) {
    case KD_ACCURACY_NEAR_AXIS: out[0].inclination_deg = 1e-3; return 2;
    case KD_ACCURACY_EDGE_ON:
        out[0].inclination_deg = 90;
        out[1].inclination_deg = 89.99;
        return 2;
    case KD_ACCURACY_NEAR_EXTREMAL: out[0].spin = 0.9999; return 1;
    default: return 1;
    }
}

/* One coordinate, 0 to 1, of point k of the sequence in the unit square. `step` is the sequence's step along this
 * coordinate. */
static double fraction(size_t k, double step)
{
    double x = 0.5 + step * (double)(k + 1);
    return x - floor(x);
}
static double first_of(size_t k) { return fraction(k, 0.7548776662466927); }
static double second_of(size_t k) { return fraction(k, 0.5698402909980532); }

static struct kd_critical curve_of(const struct kd_accuracy_view *view)
{
    double i = view->inclination_deg * (M_PI / 180);
    return kd_critical_of(&(struct kd_critical_observer) { .hole = kd_hole_of(view->spin),
                                                           .radius = INFINITY,
                                                           .cos_theta = view->inclination_deg == 90 ? 0 : cos(i),
                                                           .sin_theta = sin(i) });
}

static void near_critical(const struct kd_critical *curve, size_t k, double *out)
{
    double distance = NEAR * pow(10, -(double)(k / 2 % 5));
    const struct kd_critical_point p = kd_critical_at(curve, 2 * M_PI * first_of(k));
    double rho = p.rho * (k % 2 ? 1 + distance : 1 - distance);
    out[0] = curve->centre + rho * cos(p.angle);
    out[1] = rho * sin(p.angle);
}

static bool is_near_critical(const struct kd_critical *curve, const double *ray)
{
    double x = ray[0] - curve->centre, y = ray[1];
    return fabs(hypot(x, y) / kd_critical_at(curve, atan2(y, x)).rho - 1) < NEAR;
}

/* Gets the next point of the sequence that lies outside the near-critical set; advances *k. */
static void anywhere(const struct kd_critical *curve, size_t *k, double *out)
{
    do {
        out[0] = HALF * (2 * first_of(*k) - 1);
        out[1] = HALF * (2 * second_of(*k) - 1);
        ++*k;
    } while (is_near_critical(curve, out));
}

static double near_zero(size_t k)
{
    double alpha = k % 12 ? pow(10, -1.0 - (double)(k % 12)) : 0;
    return k / 12 % 2 ? -alpha : alpha;
}

void kd_accuracy_rays(enum kd_accuracy_set set, uint32_t view, size_t n, double *alpha_beta)
{
    struct kd_accuracy_view views[KD_ACCURACY_VIEWS];
    kd_accuracy_views(set, views);
    const struct kd_critical curve = curve_of(&views[view]);
    size_t next = 0;
    for (size_t k = 0; k < n; k++) {
        double *out = alpha_beta + 2 * k;
        if (set == KD_ACCURACY_NEAR_CRITICAL)
            near_critical(&curve, k, out);
        else
            anywhere(&curve, &next, out);
        if (set == KD_ACCURACY_NEAR_AXIS && view == 1)
            out[0] = near_zero(k);
    }
}
