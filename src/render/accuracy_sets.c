#include "render/accuracy_sets.h"

#include "physics/kerr.h"

#include <math.h>

const char *const kd_accuracy_set_names[KD_ACCURACY_SETS] = {
    [KD_ACCURACY_BULK] = "bulk",           [KD_ACCURACY_NEAR_CRITICAL] = "near-critical",
    [KD_ACCURACY_NEAR_AXIS] = "near-axis", [KD_ACCURACY_EDGE_ON] = "edge-on",
    [KD_ACCURACY_NEAR_EXTREMAL] = "near-extremal",
};

const char *const kd_accuracy_set_rays[KD_ACCURACY_SETS] = {
    [KD_ACCURACY_BULK] = "a = 0.9, i = 70°, ±12 M",
    [KD_ACCURACY_NEAR_CRITICAL] = "a = 0.9, i = 70°, |b/b_c - 1| = 1e-2, 1e-3, ... 1e-6 on both sides of the critical curve",
    [KD_ACCURACY_NEAR_AXIS] = "a = 0.9: half i = 0.001°, ±12 M; half i = 70°, α = 0, ±1e-12, ... ±1e-2 M, β within ±12 M",
    [KD_ACCURACY_EDGE_ON] = "a = 0.9: half i = 90°, half i = 89.99°, ±12 M",
    [KD_ACCURACY_NEAR_EXTREMAL] = "a = 0.9999, i = 70°, ±12 M",
};

#define HALF 12.0 /* M, half the side of the image plane */

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

/* Point k of the sequence in the unit square. */
static double fraction(size_t k, double step)
{
    double x = 0.5 + step * (double)(k + 1);
    return x - floor(x);
}
static double first_of(size_t k) { return fraction(k, 0.7548776662466927); }
static double second_of(size_t k) { return fraction(k, 0.5698402909980532); }

/* beta^2 where the bound orbit of radius r appears; the constants from Bardeen 1973, eqs. 48 and 49, of which r - 1 is taken
 * out of numerator and denominator. */
static double beta_squared(double a, double u, double s, double r, double *alpha)
{
    double delta = (r - 2) * r + a * a, l = a + r / a * (r - 2 * delta / (r - 1));
    double eta = r * r * r / (a * a) * (4 * delta / ((r - 1) * (r - 1)) - r);
    *alpha = -l / s;
    return eta + u * u * (a * a - l * l / (s * s));
}

/* The radius between `dark` and `seen` at which beta vanishes. */
static double end_of_range(double a, double u, double s, double dark, double seen)
{
    double alpha;
    for (int k = 0; k < 200 && dark != seen; k++) {
        double middle = 0.5 * (dark + seen);
        if (middle == dark || middle == seen)
            break;
        *(beta_squared(a, u, s, middle, &alpha) >= 0 ? &seen : &dark) = middle;
    }
    return seen;
}

void kd_critical_point(double a, double inclination_deg, double t, double out[2])
{
    double s = sin(inclination_deg * (M_PI / 180)), u = cos(inclination_deg * (M_PI / 180));
    double near = kd_kerr_photon_orbit(fabs(a)), far = kd_kerr_photon_orbit(-fabs(a)), alpha;
    /* The orbit with L = 0, which the axis sees, is seen from everywhere. */
    double polar = 2 * sqrt(1 - a * a / 3) * cos(acos((1 - a * a) / pow(1 - a * a / 3, 1.5)) / 3) + 1;
    near = end_of_range(a, u, s, near, polar);
    far = end_of_range(a, u, s, far, polar);
    double r = near + (far - near) * 0.5 * (1 - cos(2 * M_PI * t));
    double beta = sqrt(fmax(beta_squared(a, u, s, r, &alpha), 0));
    out[0] = alpha;
    out[1] = t < 0.5 ? beta : -beta;
}

static void near_critical(const struct kd_accuracy_view *view, size_t k, double *out)
{
    double distance = pow(10, -2.0 - (double)(k / 2 % 5));
    kd_critical_point(view->spin, view->inclination_deg, first_of(k), out);
    for (int i = 0; i < 2; i++)
        out[i] *= k % 2 ? 1 + distance : 1 - distance;
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
    for (size_t k = 0; k < n; k++) {
        double *out = alpha_beta + 2 * k;
        out[0] = HALF * (2 * first_of(k) - 1);
        out[1] = HALF * (2 * second_of(k) - 1);
        if (set == KD_ACCURACY_NEAR_CRITICAL)
            near_critical(&views[view], k, out);
        else if (set == KD_ACCURACY_NEAR_AXIS && view == 1)
            out[0] = near_zero(k);
    }
}
