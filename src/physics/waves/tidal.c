#include "physics/waves/tidal.h"

#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdbool.h>

static bool positive(struct kd_tidal t) { return t.hole > 0 && t.mass > 0 && t.radius > 0; }

double kd_tidal_radius(struct kd_tidal t) { return positive(t) ? t.radius * cbrt(t.hole / t.mass) : NAN; }

double kd_tidal_penetration(struct kd_tidal t, double pericentre)
{
    return pericentre > 0 ? kd_tidal_radius(t) / pericentre : NAN;
}

double kd_tidal_energy_spread(struct kd_tidal t)
{
    double r = kd_tidal_radius(t);
    return t.hole * t.radius / (r * r);
}

double kd_tidal_fallback_time(struct kd_tidal t)
{
    double e = 2 * kd_tidal_energy_spread(t);
    return 2 * M_PI * t.hole / (e * sqrt(e));
}

double kd_tidal_fallback_rate(struct kd_tidal t, double time)
{
    double first = kd_tidal_fallback_time(t), x = time / first;
    return time < first ? 0 : t.mass / (3 * first * x * cbrt(x * x));
}

/* The hole's mass M for which r_t is `reach` times M: M = (R/reach)^(3/2) m^(-1/2). */
static double heaviest(struct kd_tidal t, double reach)
{
    double x = t.radius / reach;
    return t.mass > 0 && t.radius > 0 ? x * sqrt(x / t.mass) : NAN;
}

double kd_tidal_capture_mass(struct kd_tidal t, const struct kd_hole *hole)
{
    return heaviest(t, kd_kerr_marginally_bound(hole));
}

double kd_tidal_hills_mass(struct kd_tidal t, const struct kd_hole *hole) { return heaviest(t, hole->outer); }
