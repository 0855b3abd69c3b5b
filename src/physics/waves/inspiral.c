#include "physics/waves/inspiral.h"

#include "physics/math/quadrature.h"

#include <math.h>
#include <stdbool.h>

static bool bound(double eta, double a, double e) { return eta > 0 && eta <= 0.25 && a > 0 && e >= 0 && e < 1; }

static double one_minus_e2(double e) { return (1 - e) * (1 + e); }

double kd_inspiral_eta(double q) { return q > 0 ? q / ((1 + q) * (1 + q)) : NAN; }

double kd_inspiral_chirp_mass(double eta) { return eta > 0 && eta <= 0.25 ? pow(eta, 0.6) : NAN; }

double kd_inspiral_enhancement(double e)
{
    double e2 = e * e;
    return e >= 0 && e < 1 ? (1 + e2 * (73.0 / 24 + e2 * (37.0 / 96))) / pow(one_minus_e2(e), 3.5) : NAN;
}

double kd_inspiral_power(double eta, double a, double e)
{
    return bound(eta, a, e) ? 32.0 / 5 * eta * eta / pow(a, 5) * kd_inspiral_enhancement(e) : NAN;
}

/* Peters' constant beta, which is 64/5 m1 m2 (m1 + m2). */
static double beta(double eta) { return 64.0 / 5 * eta; }

double kd_inspiral_axis_rate(double eta, double a, double e)
{
    return bound(eta, a, e) ? -beta(eta) / (a * a * a) * kd_inspiral_enhancement(e) : NAN;
}

double kd_inspiral_eccentricity_rate(double eta, double a, double e)
{
    if (!bound(eta, a, e))
        return NAN;
    return -304.0 / 15 * eta * e / (pow(a, 4) * pow(one_minus_e2(e), 2.5)) * (1 + 121.0 / 304 * e * e);
}

double kd_inspiral_period_rate(double eta, double a, double e)
{
    return 3 * M_PI * sqrt(a) * kd_inspiral_axis_rate(eta, a, e);
}

double kd_inspiral_axis(double a0, double e0, double e)
{
    if (!(a0 > 0 && e0 > 0 && e0 < 1 && e >= 0 && e < 1))
        return NAN;
    double sum = (1 + 121.0 / 304 * e * e) / (1 + 121.0 / 304 * e0 * e0);
    return a0 * pow(e / e0, 12.0 / 19) * one_minus_e2(e0) / one_minus_e2(e) * pow(sum, 870.0 / 2299);
}

/* Integrand of P 5.14 in the variable x with e = e0 x. The power of e0 cancels against that of c0. */
static double slowing(double x, double y, const void *context)
{
    double e0 = *(const double *)context, ex = e0 * x;
    double rest = one_minus_e2(e0) + e0 * e0 * y * (1 + x); /* 1 - e^2 */
    return pow(x, 29.0 / 19) * pow(1 + 121.0 / 304 * ex * ex, 1181.0 / 2299) / (rest * sqrt(rest));
}

double kd_inspiral_time(double eta, double a, double e)
{
    if (!bound(eta, a, e))
        return NAN;
    double circle = pow(a, 4) / (4 * beta(eta));
    /* c0 without the factor a e^(12/19) */
    double c0 = one_minus_e2(e) * pow(1 + 121.0 / 304 * e * e, -870.0 / 2299);
    return 48.0 / 19 * circle * pow(c0, 4) * kd_quadrature(slowing, &e);
}

static const double isco = 6;

double kd_inspiral_frequency(double eta, double tau)
{
    if (!(eta > 0 && eta <= 0.25 && tau > 0))
        return NAN;
    double a = sqrt(sqrt(4 * beta(eta) * tau));
    return a >= isco * (1 - 1e-14) ? 1 / (M_PI * a * sqrt(a)) : NAN;
}

double kd_inspiral_frequency_isco(void) { return 1 / (M_PI * isco * sqrt(isco)); }

double kd_inspiral_strain(double eta, double f, double d)
{
    return eta > 0 && eta <= 0.25 && f > 0 && d > 0 ? 4 * eta / d * pow(M_PI * f, 2.0 / 3) : NAN;
}
