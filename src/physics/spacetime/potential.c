#include "physics/spacetime/potential.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

double kd_potential(double a, double l, double mu2, double r)
{
    double delta = (r - kd_kerr_horizon(a)) * (r - kd_kerr_inner_horizon(a));
    double big = r * (r * (r * r + a * a) + 2 * a * a);
    return (2 * a * l * r + r * sqrt(fmax(0, delta) * (r * r * l * l + mu2 * big))) / big;
}

double kd_potential_critical_impact(double a) { return 6 * cos(acos(-a) / 3) - a; }

static const struct kd_potential_extrema none = { NAN, NAN, NAN, NAN };

/* V(a, L) = V(-a, -L): orbits that turn towards -phi are those of the mirrored hole. */
struct kd_potential_extrema kd_potential_of_light(double a, double l)
{
    struct kd_potential_extrema e = none;
    if (l == 0)
        return e;
    double s = copysign(1, l);
    e.r_max = kd_kerr_photon_orbit(s * a);
    e.v_max = s * l / kd_potential_critical_impact(s * a);
    return e;
}

/* L of the circular orbit falls from infinity at the photon orbit to the ISCO and rises from there: bisection between a
 * radius where it is above l and one where it is below, to the last bit. */
static double circle_of_momentum(double a, double l, double above, double below)
{
    for (;;) {
        double r = 0.5 * (above + below);
        if (r == above || r == below)
            return r;
        if (kd_kerr_momentum(a, r) > l)
            above = r;
        else
            below = r;
    }
}

struct kd_potential_extrema kd_potential_of_matter(double a, double l)
{
    struct kd_potential_extrema e = none;
    double s = copysign(1, l);
    a *= s;
    l *= s;
    double isco = kd_kerr_isco(a), least = kd_kerr_momentum(a, isco);
    if (!(l >= least))
        return e;
    /* Far out L = sqrt(r): beyond (L + 3)^2 + 16 it is above l, for a = -1 too. */
    e.r_max = circle_of_momentum(a, l, kd_kerr_photon_orbit(a), isco);
    e.r_min = circle_of_momentum(a, l, (l + 3) * (l + 3) + 16, isco);
    /* V is taken here and not E of the circular orbit, which is steep towards the photon orbit where V is flat. */
    e.v_max = kd_potential(a, l, 1, e.r_max);
    e.v_min = kd_potential(a, l, 1, e.r_min);
    return e;
}
