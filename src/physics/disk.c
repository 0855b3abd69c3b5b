#include "physics/disk.h"

#include "physics/constants.h"
#include "physics/kerr.h"

#include <math.h>

/* One logarithm of Page & Thorne's eq. 15n; log1p because the bracket cancels to second order at the ISCO. */
static double log_term(double a, double x, double x0, double root, double other1, double other2)
{
    if (root == 0) /* a = 0: (root - a)^2 / root -> 0 */
        return 0;
    double k = 3 * (root - a) * (root - a) / (root * (root - other1) * (root - other2));
    return k * log1p((x - x0) / (x0 - root));
}

double kd_disk_flux_page_thorne(double a, double r)
{
    double r0 = kd_kerr_isco(a);
    if (!(r > r0))
        return 0;
    double x = sqrt(r), x0 = sqrt(r0), dx = (r - r0) / (x + x0);
    /* Roots of x^3 - 3x + 2a; the middle one by a sine, exact as a -> 0. */
    double x1 = 2 * cos((acos(a) - M_PI) / 3), x2 = 2 * sin(asin(a) / 3), x3 = -2 * cos(acos(a) / 3);
    double bracket = dx - 1.5 * a * log1p(dx / x0) - log_term(a, x, x0, x1, x2, x3) -
                     log_term(a, x, x0, x2, x1, x3) - log_term(a, x, x0, x3, x1, x2);
    double f = 1.5 * bracket / (x * x * (x * (x * x - 3) + 2 * a));
    return fmax(f, 0) / (4 * M_PI * r);
}

double kd_disk_flux_shakura_sunyaev(double a, double r)
{
    double r0 = kd_kerr_isco(a);
    return r > r0 ? 3 / (8 * M_PI * r * r * r) * (1 - sqrt(r0 / r)) : 0;
}

double kd_disk_peak(kd_disk_flux_fn flux_of, double a, double *flux)
{
    const double golden = 0.6180339887498949;
    double lo = kd_kerr_isco(a), hi = 4 * lo; /* both models peak below 2.1 r_isco */
    double x1 = hi - golden * (hi - lo), x2 = lo + golden * (hi - lo), f1 = flux_of(a, x1), f2 = flux_of(a, x2);
    while (hi - lo > 1e-9 * hi) {
        if (f1 > f2) {
            hi = x2, x2 = x1, f2 = f1;
            x1 = hi - golden * (hi - lo), f1 = flux_of(a, x1);
        } else {
            lo = x1, x1 = x2, f1 = f2;
            x2 = lo + golden * (hi - lo), f2 = flux_of(a, x2);
        }
    }
    double r = 0.5 * (lo + hi);
    if (flux)
        *flux = flux_of(a, r);
    return r;
}

double kd_disk_redshift(double a, double r, double lambda)
{
    return 1 / (kd_kerr_ut(a, r) * (1 - kd_kerr_omega(a, r) * lambda));
}

/* -p.u = [(P U + sigma sqrt(R S))/Delta - (lambda - a)(L - a E)]/r^2, sigma the sign of p^r, with the radial potentials
 * R = P^2 - Delta K of the photon and S = U^2 - Delta (r^2 + J^2) of the gas. u^r is known in closed form, which does not
 * cancel at the ISCO: (u^r)^2 = 2/(3 r0) (r0/r - 1)^3. For sigma < 0 the bracket cancels at the horizon; multiplied out by
 * P U + sqrt(R S) it does not. */
double kd_disk_redshift_plunging(double a, double r, double lambda, double eta, bool outwards)
{
    double r0 = kd_kerr_isco(a), e = 1 - kd_kerr_efficiency(a), l = kd_kerr_momentum(a, r0), j = l - a * e;
    double gap = fmax(0, r0 / r - 1), ur = sqrt(2 / (3 * r0) * gap) * gap;
    double h = kd_kerr_horizon(a), delta = (r - h) * (r - kd_kerr_inner_horizon(a));
    double p = r * r + a * (a - lambda), u = r * r * e - a * j;
    double k = eta + (lambda - a) * (lambda - a), m = r * r + j * j;
    double root = sqrt(fmax(0, p * p - delta * k)) * r * r * ur;
    double radial = outwards ? (p * u + root) / delta : (p * p * m + u * u * k - delta * k * m) / (p * u + root);
    return r * r / (radial - (lambda - a) * j);
}

double kd_disk_rate(double a, double mass_msun, double mdot_edd)
{
    double luminosity = mdot_edd * 4 * M_PI * KD_GM_SUN_SI * mass_msun * KD_PROTON_KG * KD_C_M_S / KD_THOMSON_M2;
    return luminosity / (kd_kerr_efficiency(a) * KD_C_M_S * KD_C_M_S);
}

double kd_disk_flux_si(double flux, double a, double mass_msun, double mdot_edd)
{
    double light_s = KD_M_SUN_S * mass_msun; /* c^2/M^2 in s^-2 */
    return flux * kd_disk_rate(a, mass_msun, mdot_edd) / (light_s * light_s);
}

double kd_disk_temperature(double flux, double a, double mass_msun, double mdot_edd)
{
    return pow(kd_disk_flux_si(flux, a, mass_msun, mdot_edd) / KD_STEFAN_BOLTZMANN_SI, 0.25);
}
