#include "physics/disk/thin_disk.h"

#include "physics/math/constants.h"
#include "physics/math/quadrature.h"
#include "physics/math/root.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* One of the logarithms in Page & Thorne's eq. 15n. It is computed by log1p, because the bracket cancels to second
 * order at the ISCO. */
static double log_term(double a, double x, double x0, double root, double other1, double other2)
{
    if (root == 0) /* a = 0: (root - a)^2 / root -> 0 */
        return 0;
    double k = 3 * (root - a) * (root - a) / (root * (root - other1) * (root - other2));
    return k * log1p((x - x0) / (x0 - root));
}

double kd_disk_flux_page_thorne(const struct kd_hole *hole, double r)
{
    const double a = hole->a;
    double r0 = kd_kerr_isco(hole);
    if (!(r > r0))
        return 0;
    double x = sqrt(r), x0 = sqrt(r0), dx = (r - r0) / (x + x0);
    /* Roots of x^3 - 3x + 2a; the middle one as a sine, which is accurate for a -> 0. */
    double x1 = 2 * cos((acos(a) - M_PI) / 3), x2 = 2 * sin(asin(a) / 3), x3 = -2 * cos(acos(a) / 3);
    double bracket = dx - 1.5 * a * log1p(dx / x0) - log_term(a, x, x0, x1, x2, x3) - log_term(a, x, x0, x2, x1, x3) -
                     log_term(a, x, x0, x3, x1, x2);
    double f = 1.5 * bracket / (x * x * (x * (x * x - 3) + 2 * a));
    return fmax(f, 0) / (4 * M_PI * r);
}

double kd_disk_flux_shakura_sunyaev(const struct kd_hole *hole, double r)
{
    double r0 = kd_kerr_isco(hole);
    return r > r0 ? 3 / (8 * M_PI * r * r * r) * (1 - sqrt(r0 / r)) : 0;
}

/* Up to constants the flux is B(x)/(x^4 (x^3 - 3x + 2a)), with x = sqrt(r) = 1 + y, x0 = sqrt(r_isco), d = 1 - a and
 *
 *   B' = (x^4 - 6x^2 + 8ax - 3a^2)/(x (x^3 - 3x + 2a))      x^3 - 3x + 2a = y^2 (y + 3) - 2d
 *
 * (eq. 15n is the integral of this from x0.) Near the ISCO, where the logarithms of 15n cancel, the integral itself
 * keeps all digits. The numerator is y^3 (y + 4) - 2d (1 + 4y) - 3d^2, which has the factor y - y0. */
struct rise {
    double a, y0, gap; /* gap: distance of x0 from the nearest root of x^3 - 3x + 2a, which is that of the photon
                        * orbit */
    double turns;      /* ln(1 + (x - x0)/gap), in which B' is smooth even for a nearly extremal hole */
};

static double below(double a, double y) { return y * y * (y + 3) - 2 * (1 - a); }

static double slope_of_bracket(double a, double y0, double beyond)
{
    double y = y0 + beyond, two = y * y + y0 * y0;
    return beyond * (two * (y + y0) + 4 * (two + y * y0) - 8 * (1 - a)) / ((1 + y) * below(a, y));
}

static double share(double along, double left, const void *context)
{
    const struct rise *r = context;
    double beyond = r->gap * expm1(r->turns * along);
    (void)left;
    return r->turns * (beyond + r->gap) * slope_of_bracket(r->a, r->y0, beyond);
}

/* A function that is positive where the flux grows with r; the place is x0 + span. */
static double growth(const void *user, double span)
{
    struct rise r = *(const struct rise *)user;
    r.turns = log1p(span / r.gap);
    double y = r.y0 + span, loss = 4 / (1 + y) + 3 * y * (2 + y) / below(r.a, y);
    return slope_of_bracket(r.a, r.y0, span) - kd_quadrature(share, &r) * loss;
}

double kd_disk_peak_page_thorne(const struct kd_hole *hole)
{
    double x0 = sqrt(kd_kerr_isco(hole));
    struct rise r = { .a = hole->a, .y0 = x0 - 1, .gap = x0 - sqrt(kd_kerr_photon_orbit(hole)) };
    /* The maximum is below 2.1 r_isco for all spins, and at the ISCO for an extremal hole. */
    double x = x0 + kd_root(growth, &r, 1e-7 * x0, 0.5 * x0);
    return x * x;
}

double kd_disk_peak_shakura_sunyaev(const struct kd_hole *hole)
{
    return 49. / 36 * kd_kerr_isco(hole); /* where the derivative of (1 - sqrt(r_in/r))/r^3 vanishes */
}

double kd_disk_redshift(const struct kd_hole *hole, double r, double lambda)
{
    return 1 / (kd_kerr_ut(hole, r) * (1 - kd_kerr_omega(hole, r) * lambda));
}

/* -p.u = [(P U + sigma sqrt(R S))/Delta - (lambda - a)(L - a E)]/r^2, sigma being the sign of p^r, with the radial
 * potentials R = P^2 - Delta K of the photon and S = U^2 - Delta (r^2 + J^2) of the gas. u^r has a closed form that
 * does not cancel at the ISCO: (u^r)^2 = 2/(3 r0) (r0/r - 1)^3. For sigma < 0 the bracket cancels at the horizon;
 * multiplied by its conjugate P U + sqrt(R S) it does not. */
double kd_disk_redshift_plunging(const struct kd_hole *hole, double r, double lambda, double eta, bool outwards)
{
    const double a = hole->a;
    double r0 = kd_kerr_isco(hole), e = 1 - kd_kerr_efficiency(hole), l = kd_kerr_momentum(hole, r0), j = l - a * e;
    double gap = fmax(0, r0 / r - 1), ur = sqrt(2 / (3 * r0) * gap) * gap;
    double delta = kd_hole_delta(hole, r);
    double p = r * r + a * (a - lambda), u = r * r * e - a * j;
    double k = eta + (lambda - a) * (lambda - a), m = r * r + j * j;
    double root = sqrt(fmax(0, p * p - delta * k)) * r * r * ur;
    double radial = outwards ? (p * u + root) / delta : (p * p * m + u * u * k - delta * k * m) / (p * u + root);
    return r * r / (radial - (lambda - a) * j);
}

double kd_disk_rate(const struct kd_hole *hole, double mass_msun, double mdot_edd)
{
    double luminosity = mdot_edd * 4 * M_PI * KD_GM_SUN_SI * mass_msun * KD_PROTON_KG * KD_C_M_S / KD_THOMSON_M2;
    return luminosity / (kd_kerr_efficiency(hole) * KD_C_M_S * KD_C_M_S);
}

double kd_disk_flux_si(double flux, const struct kd_hole *hole, double mass_msun, double mdot_edd)
{
    double light_s = KD_M_SUN_S * mass_msun; /* c^2/M^2 in s^-2 */
    return flux * kd_disk_rate(hole, mass_msun, mdot_edd) / (light_s * light_s);
}

double kd_disk_temperature(double flux, const struct kd_hole *hole, double mass_msun, double mdot_edd)
{
    return pow(kd_disk_flux_si(flux, hole, mass_msun, mdot_edd) / KD_STEFAN_BOLTZMANN_SI, 0.25);
}
