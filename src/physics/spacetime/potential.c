#include "physics/spacetime/potential.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

double kd_potential(const struct kd_hole *hole, double l, double mu2, double r)
{
    const double a = hole->a;
    double delta = kd_hole_delta(hole, r), big = kd_hole_area_in_plane(hole, r);
    return (a * l * kd_hole_mass(hole, r) + r * sqrt(fmax(0, delta) * (r * r * l * l + mu2 * big))) / big;
}

static const struct kd_potential_extrema none = { NAN, NAN, NAN, NAN };

/* The extrema for light or matter. Because V(a, L) = V(-a, -L), orbits towards -phi are those of the mirrored hole. */
struct kd_potential_extrema kd_potential_of_light(const struct kd_hole *hole, double l)
{
    struct kd_potential_extrema e = none;
    if (l == 0)
        return e;
    double s = copysign(1, l);
    e.r_max = kd_kerr_photon_orbit(kd_hole_turned(hole, s));
    e.v_max = s * l / kd_kerr_critical_impact(kd_hole_turned(hole, s));
    return e;
}

/* L of circular orbits decreases from infinity on the photon orbit to its minimum at the ISCO, and increases beyond.
 * The function bisects, to the last bit, between a radius where L exceeds l and one where it does not. */
static double circle_of_momentum(const struct kd_hole *hole, double l, double above, double below)
{
    for (;;) {
        double r = 0.5 * (above + below);
        if (r == above || r == below)
            return r;
        if (kd_kerr_momentum(hole, r) > l)
            above = r;
        else
            below = r;
    }
}

struct kd_potential_extrema kd_potential_of_matter(const struct kd_hole *hole, double l)
{
    struct kd_potential_extrema e = none;
    const double s = copysign(1, l);
    const struct kd_hole turned = kd_hole_turned_of(hole, s);
    hole = &turned;
    l *= s;
    double isco = kd_kerr_isco(hole), least = kd_kerr_momentum(hole, isco);
    if (!(l >= least))
        return e;
    /* The bracket of r_min ends at (L + 3)^2 + 16, where the L of the circular orbit, sqrt(r) far out, exceeds l even
     * for a = -1. */
    e.r_max = circle_of_momentum(hole, l, kd_kerr_photon_orbit(hole), isco);
    e.r_min = circle_of_momentum(hole, l, (l + 3) * (l + 3) + 16, isco);
    /* Uses V instead of the E of the circular orbit, because E is steep near the photon orbit, where V is flat. */
    e.v_max = kd_potential(hole, l, 1, e.r_max);
    e.v_min = kd_potential(hole, l, 1, e.r_min);
    return e;
}
