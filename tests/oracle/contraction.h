/* Redshift of gas that plunges from the ISCO, by contraction with the metric. */
#ifndef KD_TESTS_CONTRACTION_H
#define KD_TESTS_CONTRACTION_H

#include "physics/spacetime/kerr.h"

#include <math.h>

/* g = 1/(-k.u) with every component written out. The inverse metric raises k; u^r follows from u.g.u = -1 with the E
 * and L of the ISCO, k_r from k.g.k = 0. Uses no potentials. */
static inline double redshift_of_plunge(const struct kd_hole *hole, double r, double lambda, double eta, double sign)
{
    double a = hole->a, q = hole->q, f = 2 / r - q * q / (r * r);
    double isco = kd_kerr_isco(hole), e = kd_kerr_energy(hole, isco), l = kd_kerr_momentum(hole, isco);
    double delta = r * r - 2 * r + a * a + q * q, pp = r * r + a * a + a * a * f;
    double itt = -pp / delta, itp = -a * f / delta, ipp = (1 - f) / delta, irr = delta / (r * r);
    double ut = -itt * e + itp * l, up = -itp * e + ipp * l, energy2 = -itt * e * e + 2 * itp * e * l - ipp * l * l;
    double ur_down = -sqrt((energy2 - 1) / irr); /* inwards; k_theta^2 = eta at the equator */
    double null = -itt + 2 * itp * lambda - ipp * lambda * lambda - eta / (r * r);
    double kr_down = sign * sqrt(null / irr);
    return 1 / (ut - lambda * up - irr * kr_down * ur_down);
}

#endif
