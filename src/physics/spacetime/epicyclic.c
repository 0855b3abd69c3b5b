#include "physics/spacetime/epicyclic.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* kappa^2 r^2/Omega^2 = x^4 - 6x^2 + 8ax - 3a^2 with x = sqrt(r), the quartic whose root is the ISCO. For a = 1 the
 * root is triple, at x = 1. Written in d = x - 1 and e = 1 - a, it has no avoidable cancellation there. */
double kd_epicyclic_radial(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring o = kd_kerr_ring_at(hole, r - 1);
        const double x = r == kd_kerr_isco(hole) ? 0 : kd_kerr_ring_excess(hole, &o);
        return kd_kerr_omega(hole, r) * sqrt(x) / (r * o.s);
    }
    double x = sqrt(r), d = (r - 1) / (x + 1), e = 1 - hole->a;
    double q = d * d * d * (d + 4) - e * (2 + 8 * d + 3 * e);
    if (r == kd_kerr_isco(hole)) /* exactly 0 instead of a rounding error */
        q = 0;
    return kd_kerr_omega(hole, r) * sqrt(q) / r;
}

/* The vertical frequency has x^4 - 4ax + 3a^2 instead, whose root at a = x = 1 is double. */
double kd_epicyclic_vertical(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring o = kd_kerr_ring_at(hole, r - 1);
        const double a = hole->a, square = (r * r + a * a) * o.sigma * o.sigma + a * (2 * o.sigma + a) * o.delta;
        return kd_kerr_omega(hole, r) * sqrt(square) / (r * o.s);
    }
    double x = sqrt(r), d = (r - 1) / (x + 1), e = 1 - hole->a;
    double q = d * d * (r + 2 * x + 3) + e * (4 * d - 2 + 3 * e);
    return kd_kerr_omega(hole, r) * sqrt(q) / r;
}

/* d(phi)/dt = (L (1 - 2/r) + 2aE/r) / (E (r^2 + a^2 + 2a^2/r) - 2aL/r) in the plane, from the metric, with 2/r -
 * q^2/r^2 for 2/r if there is a charge; the quotient is Omega. */
double kd_epicyclic_shear(const struct kd_hole *hole, double r)
{
    const double a = hole->a;
    double e = kd_kerr_energy(hole, r), l = kd_kerr_momentum(hole, r), omega = kd_kerr_omega(hole, r);
    if (kd_hole_is_charged(hole)) {
        const double q2 = hole->q * hole->q, mass = (2 - q2 / r) / r, slope = 2 * (q2 / r - 1) / (r * r), j = l - a * e;
        return (-j * slope - omega * (2 * e * r - a * j * slope)) / (e * (r * r + a * a) - a * j * mass);
    }
    double over = 2 * (l - a * e) / (r * r), under = 2 * e * (r - a * a / (r * r)) + 2 * a * l / (r * r);
    double energy = e * (r * r + a * a + 2 * a * a / r) - 2 * a * l / r;
    return (over - omega * under) / energy;
}
