#include "physics/disk/torus.h"

#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdbool.h>

/* ln h up to a constant. Equation 3.6 gives it from lapse and omega of the metric, with g_phiphi = A sin^2/Sigma and
 * U^2 = u_phi^2/g_phiphi; (u^t u_phi)^2 = l^2 equals U^2 (1 + U^2) g_phiphi/lapse^2. The shader uses the same constant
 * (emit/plasma.glsl). */
static double enthalpy(const struct kd_hole *hole, double l, double r, double u)
{
    const struct kd_metric_scalars m = kd_metric_at(hole, r, u);
    const double s2 = (1 - u) * (1 + u), u2 = 0.5 * (sqrt(1 + 4 * l * l * m.lapse2 * m.sigma / (m.area * s2)) - 1);
    return 0.5 * (log1p(u2) - log(m.lapse2)) - u2 - m.omega * l;
}

double kd_torus_log_enthalpy(const struct kd_torus *torus, const struct kd_hole *hole, double r, double u)
{
    return enthalpy(hole, torus->l, r, u) - torus->edge;
}

/* Outer radius where ln h vanishes, by bisection between a radius inside the torus and one outside. */
static double outer_of(const struct kd_torus *torus, const struct kd_hole *hole, double within, double beyond)
{
    for (int i = 0; i < 60; i++) {
        const double r = sqrt(within * beyond);
        *(kd_torus_log_enthalpy(torus, hole, r, 0) > 0 ? &within : &beyond) = r;
    }
    return within;
}

static double height_at(const struct kd_torus *torus, const struct kd_hole *hole, double r)
{
    double within = 0, beyond = 1;
    for (int i = 0; i < 40; i++) {
        const double u = 0.5 * (within + beyond);
        *(kd_torus_log_enthalpy(torus, hole, r, u) > 0 ? &within : &beyond) = u;
    }
    return beyond;
}

#define FAR 1e6
enum { RADII = 200 };

struct kd_torus kd_torus_of(const struct kd_hole *hole, double inner, double most)
{
    struct kd_torus t = { .l = kd_kerr_ut(hole, most) * kd_kerr_momentum(hole, most) };
    t.edge = enthalpy(hole, t.l, inner, 0);
    t.log_most = kd_torus_log_enthalpy(&t, hole, most, 0);
    const bool closes = kd_torus_log_enthalpy(&t, hole, FAR, 0) < 0;
    t.outer = closes ? outer_of(&t, hole, most, FAR) : INFINITY;
    for (int i = 1; i < RADII; i++)
        t.height =
            fmax(t.height, height_at(&t, hole, inner * pow((closes ? t.outer : FAR) / inner, (double)i / RADII)));
    return t;
}
