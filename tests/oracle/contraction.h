/* Redshift of gas that plunges from the ISCO, by contraction with the metric. */
#ifndef KD_TESTS_CONTRACTION_H
#define KD_TESTS_CONTRACTION_H

#include <math.h>

/* A circular orbit in the plane, from the metric and its derivatives: the square of 1/u^t, E, L, and dL/dr. */
struct circle_by_metric { long double norm, energy, momentum, slope; };
static inline struct circle_by_metric circle_by_metric(long double a, long double q, long double r)
{
    long double r2 = r * r, q2 = q * q, f = 2 / r - q2 / r2, f1 = (2 * q2 / r - 2) / r2,
                f2 = (4 - 6 * q2 / r) / (r2 * r);
    long double tt = f - 1, tp = -a * f, pp = r2 + a * a + a * a * f, pp1 = 2 * r + a * a * f1;
    long double omega = (a * f1 + sqrtl(a * a * f1 * f1 - f1 * pp1)) / pp1;
    long double domega = -(f2 - 2 * a * f2 * omega + (2 + a * a * f2) * omega * omega) / (2 * (pp1 * omega - a * f1));
    struct circle_by_metric o = { .norm = -(tt + 2 * tp * omega + pp * omega * omega) };
    long double ut = 1 / sqrtl(o.norm), along = tp + pp * omega;
    o.energy = -(tt + tp * omega) * ut;
    o.momentum = along * ut;
    o.slope = (pp1 * omega - a * f1 + pp * domega) * ut + along * along * domega * ut * ut * ut;
    return o;
}

/* E and L of the ISCO. Outside the ISCO, L grows with r. Circular orbits begin at the radius of circular light, where
 * the norm vanishes. */
struct plunge_by_metric { double a, q, energy, momentum; };
static inline struct plunge_by_metric plunge_by_metric(double a, double q)
{
    long double low = 1 + sqrtl(1 - (long double)a * a - (long double)q * q), high = 10;
    for (int k = 0; k < 80; k++) {
        const long double r = 0.5L * (low + high);
        const struct circle_by_metric o = circle_by_metric(a, q, r);
        if (o.norm > 0 && o.slope > 0)
            high = r;
        else
            low = r;
    }
    const struct circle_by_metric o = circle_by_metric(a, q, high);
    return (struct plunge_by_metric) { a, q, (double)o.energy, (double)o.momentum };
}

/* g = 1/(-k.u) with every component written out. k is raised by the inverse metric. u^r follows from u.g.u = -1 with
 * the E and L of the ISCO, and k_r from k.g.k = 0. No potentials are used. */
static inline double redshift_of_plunge(const struct plunge_by_metric *gas, double r, double lambda, double eta,
                                        double sign)
{
    double a = gas->a, q = gas->q, f = 2 / r - q * q / (r * r), e = gas->energy, l = gas->momentum;
    double delta = r * r - 2 * r + a * a + q * q, pp = r * r + a * a + a * a * f;
    double itt = -pp / delta, itp = -a * f / delta, ipp = (1 - f) / delta, irr = delta / (r * r);
    double ut = -itt * e + itp * l, up = -itp * e + ipp * l, energy2 = -itt * e * e + 2 * itp * e * l - ipp * l * l;
    double ur_down = -sqrt((energy2 - 1) / irr); /* the gas moves inwards; k_theta^2 = eta at the equator */
    double null = -itt + 2 * itp * lambda - ipp * lambda * lambda - eta / (r * r);
    double kr_down = sign * sqrt(null / irr);
    return 1 / (ut - lambda * up - irr * kr_down * ur_down);
}

#endif
