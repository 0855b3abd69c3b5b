#include "physics/spacetime/epicyclic.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

double kd_epicyclic_radial(const struct kd_hole *hole, double r)
{
    return kd_kerr_omega(hole, r) * sqrt(kd_kerr_stiffness_radial(hole, r)) / r;
}

double kd_epicyclic_vertical(const struct kd_hole *hole, double r)
{
    return kd_kerr_omega(hole, r) * sqrt(kd_kerr_stiffness_vertical(hole, r)) / r;
}

/* By the metric, d(phi)/dt = (L (1 - m/r) + maE/r) / (E (r^2 + a^2 + ma^2/r) - maL/r) in the plane, where m r is the
 * mass term; on the circular orbit this quotient is Omega. m is 2 without charge, and d(m/r)/dr = -2 pull/r^2. */
double kd_epicyclic_shear(const struct kd_hole *hole, double r)
{
    const double a = hole->a;
    double e = kd_kerr_energy(hole, r), l = kd_kerr_momentum(hole, r), omega = kd_kerr_omega(hole, r);
    double m = kd_hole_mass_w(hole, 1 / r), pull = kd_hole_pull_w(hole, 1 / r);
    double over = 2 * (l - a * e) * pull / (r * r);
    double under = 2 * e * (r - a * a * pull / (r * r)) + 2 * a * l * pull / (r * r);
    double energy = e * (r * r + a * a + m * a * a / r) - m * a * l / r;
    return (over - omega * under) / energy;
}
