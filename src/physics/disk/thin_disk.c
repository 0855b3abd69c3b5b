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
    if (root == 0) /* for a = 0, where root is 0, the limit of (root - a)^2 / root is 0 */
        return 0;
    double k = 3 * (root - a) * (root - a) / (root * (root - other1) * (root - other2));
    return k * log1p((x - x0) / (x0 - root));
}

/* With charge, from the general expression (Page & Thorne 1974, eqs 11b and 12) with the E, L and Omega of kerr.h:
 *
 *   4 pi r F = (3r - 4q^2)/(2 s r P^2) B(s),   dB/ds = X/(r P^2),   B = 0 at the ISCO, s^2 = r - q^2.
 *
 * The variable of the integral is ln(1 + (s - s_0)/gap), where gap is the distance from the photon orbit, because P
 * vanishes there. X is a polynomial of degree 6 in s. About the ISCO, where it vanishes, it is the sum of c_k (s -
 * s_0)^k, whose coefficients follow from
 *
 *   X' = 2s (Delta - 4 sigma^2 + 2ry - 4s sigma)      X'' = X'/s + 24 s (ys - sigma)      r Delta = 4 s^2 sigma^2,
 *
 * with 2ry - 4s sigma = (2y (y (s + a) - sigma) - 4sn)/(s + a) for a > 0, where it cancels next to r = 1. */
struct charged {
    const struct kd_hole *hole;
    /* y0, s0: y and s at the ISCO. gap: distance of s0 from the s of the photon orbit. turns: ln(1 + (s - s0)/gap) */
    double y0, s0, gap, turns;
    double c[6];
};

static struct charged charged_of(const struct kd_hole *hole)
{
    const double y0 = kd_kerr_ring_innermost(hole), light = kd_kerr_ring_of_light(hole);
    struct charged o = { .hole = hole, .y0 = y0, .s0 = kd_kerr_ring_at(hole, y0).s };
    o.gap = (y0 - light) / (o.s0 + kd_kerr_ring_at(hole, light).s);
    const struct kd_kerr_ring at = kd_kerr_ring_at(hole, y0);
    const double a = hole->a, q2 = hole->q * hole->q, n = hole->root * hole->root, s = at.s, r = 1 + y0, sum = s + a,
                 rest = y0 * s - at.sigma;
    const double pull = a > 0 ? (2 * y0 * (y0 * sum - at.sigma) - 4 * s * n) / sum : 2 * r * y0 - 4 * s * at.sigma;
    const double x1 = 2 * s * (pull - q2 * at.delta / (s * s)), x2 = x1 / s + 24 * s * rest,
                 x3 = x2 / s - x1 / (s * s) + 24 * rest + 24 * s * (2 * s * s + y0 - 1);
    const double c[] = { x1, x2 / 2, x3 / 6, 15 * s * s + 3 * q2 - 6, 6 * s, 1 };
    for (int k = 0; k < 6; k++)
        o.c[k] = c[k];
    return o;
}

/* X divided by s - s_0. */
static double charged_excess(const struct charged *o, double beyond)
{
    double sum = 0;
    for (int k = 5; k >= 0; k--)
        sum = sum * beyond + o->c[k];
    return sum;
}

/* The ring at the place s = s_0 + beyond. */
static struct kd_kerr_ring charged_ring(const struct charged *o, double beyond)
{
    return kd_kerr_ring_at(o->hole, o->y0 + beyond * (2 * o->s0 + beyond));
}

static double charged_share(double along, double left, const void *context)
{
    const struct charged *o = context;
    const double beyond = o->gap * expm1(o->turns * along);
    const struct kd_kerr_ring at = charged_ring(o, beyond);
    (void)left;
    return o->turns * (beyond + o->gap) * beyond * charged_excess(o, beyond) / ((1 + at.y) * at.p2);
}

static double charged_bracket(struct charged *o, double beyond)
{
    o->turns = log1p(beyond / o->gap);
    return kd_quadrature(charged_share, o);
}

static double charged_flux(const struct kd_hole *hole, double r)
{
    struct charged o = charged_of(hole);
    const double q2 = hole->q * hole->q, s = sqrt(r - q2), beyond = (r - 1 - o.y0) / (s + o.s0);
    if (!(beyond > 0))
        return 0;
    const struct kd_kerr_ring at = charged_ring(&o, beyond);
    const double bracket = charged_bracket(&o, beyond);
    return fmax(0, (3 * r - 4 * q2) / (2 * at.s * r * at.p2) * bracket) / (4 * M_PI * r);
}

/* A function of the place s = s_0 + beyond that is positive where the flux grows with r. It uses (P^2)' = 2r - 3 + a/s.
 */
static double charged_growth(const void *user, double beyond)
{
    struct charged o = *(const struct charged *)user;
    const struct kd_kerr_ring at = charged_ring(&o, beyond);
    const double r = 1 + at.y, q2 = o.hole->q * o.hole->q;
    const double loss = 3 / (3 * r - 4 * q2) - 0.5 / (at.s * at.s) - 2 / r - (2 * r - 3 + o.hole->a / at.s) / at.p2;
    return beyond * charged_excess(&o, beyond) / (2 * at.s * r * at.p2) + charged_bracket(&o, beyond) * loss;
}

static double charged_peak(const struct kd_hole *hole)
{
    const struct charged o = charged_of(hole);
    const double beyond = kd_root(charged_growth, &o, 1e-7 * o.s0, 0.7 * o.s0);
    return 1 + o.y0 + beyond * (2 * o.s0 + beyond);
}

double kd_disk_flux_page_thorne(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole))
        return charged_flux(hole, r);
    const double a = hole->a;
    double r0 = kd_kerr_isco(hole);
    if (!(r > r0))
        return 0;
    double x = sqrt(r), x0 = sqrt(r0), dx = (r - r0) / (x + x0);
    /* Roots of x^3 - 3x + 2a. The middle root is computed by a sine, which is accurate for a -> 0. */
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
 * (Eq. 15n is the integral of B' from x0.) Near the ISCO, where the logarithms of 15n cancel, quadrature of B' keeps
 * all digits. The numerator is y^3 (y + 4) - 2d (1 + 4y) - 3d^2, which has the factor y - y0. */
struct rise {
    /* gap: distance of x0 from the nearest root of x^3 - 3x + 2a, which is the root at the photon orbit */
    double a, y0, gap;
    double turns; /* ln(1 + (x - x0)/gap), the variable in which B' is smooth even for a nearly extremal hole */
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

/* A function of the place x = x0 + span that is positive where the flux grows with r. */
static double growth(const void *user, double span)
{
    struct rise r = *(const struct rise *)user;
    r.turns = log1p(span / r.gap);
    double y = r.y0 + span, loss = 4 / (1 + y) + 3 * y * (2 + y) / below(r.a, y);
    return slope_of_bracket(r.a, r.y0, span) - kd_quadrature(share, &r) * loss;
}

double kd_disk_peak_page_thorne(const struct kd_hole *hole)
{
    if (kd_hole_is_charged(hole))
        return charged_peak(hole);
    double x0 = sqrt(kd_kerr_isco(hole));
    struct rise r = { .a = hole->a, .y0 = x0 - 1, .gap = x0 - sqrt(kd_kerr_photon_orbit(hole)) };
    /* The search covers radii up to about 2.1 r_isco. For all spins the maximum is in this range; for an extremal hole
     * it is at the ISCO. */
    double x = x0 + kd_root(growth, &r, 1e-7 * x0, 0.5 * x0);
    return x * x;
}

double kd_disk_peak_shakura_sunyaev(const struct kd_hole *hole)
{
    return 49. / 36 * kd_kerr_isco(hole); /* the derivative of (1 - sqrt(r_in/r))/r^3 vanishes here */
}

double kd_disk_redshift(const struct kd_hole *hole, double r, double lambda)
{
    return 1 / (kd_kerr_ut(hole, r) * (1 - kd_kerr_omega(hole, r) * lambda));
}

/* The energy of the photon in the frame of the gas is -p.u = [(P U + sigma sqrt(R S))/Delta - (lambda - a)(L - a
 * E)]/r^2. sigma is the sign of p^r. R = P^2 - Delta K is the radial potential of the photon, and S = U^2 - Delta (r^2
 * + J^2) that of the gas. u^r has a closed form without cancellation at the ISCO: (u^r)^2 = 2/(3 r0) (r0/r - 1)^3, and
 * with charge J^2 (w - w0)^3 (2 - q^2 (3 w0 + w)) at w = 1/r. For sigma < 0 the terms P U and sqrt(R S) cancel at the
 * horizon. Multiplying by the conjugate P U + sqrt(R S) avoids this. */
double kd_disk_redshift_plunging(const struct kd_hole *hole, double r, double lambda, double eta, bool outwards)
{
    const double a = hole->a;
    double r0 = kd_kerr_isco(hole), e = 1 - kd_kerr_efficiency(hole), l = kd_kerr_momentum(hole, r0), j = l - a * e;
    double gap = fmax(0, r0 / r - 1), ur = sqrt(2 / (3 * r0) * gap) * gap;
    if (kd_hole_is_charged(hole))
        ur = sqrt(gap * (2 - hole->q * hole->q * (3 / r0 + 1 / r)) / r0) * gap * fabs(j) / r0;
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
