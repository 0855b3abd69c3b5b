#include "physics/null/deflection.h"

#include "physics/math/quadrature.h"
#include "physics/null/null_radial.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* Bardeen, Press & Teukolsky 1972: L/E at r = 4 cos^2(x), x = acos(-a)/3, equals 6 cos x - a. */
double kd_deflection_critical(const struct kd_hole *hole)
{
    const double a = hole->a;
    return fabs(a) < 1 ? 6 * cos(acos(-a) / 3) - a : NAN;
}

/* The orbit in w = 1/r and Mino time, E = 1, L = b (docs/physics/geodesics.md at Q = 0):
 *   w'^2 = 1 - (b^2 - a^2) w^2 + 2 (b - a)^2 w^3,   phi' = b + chi',   chi' = a (2w - a b w^2)/(1 - 2w + a^2 w^2). */
static double slow(double a, double w) { return 1 - w * (2 - a * a * w); }

static double drag(double a, double b, double w) { return a * w * (2 - a * b * w) / slow(a, w); }

struct far { double a, b, w0; /* w0: at the closest approach */ };

/* With w = w0 sin(psi) the first root cancels in w'^2 = w0^2 cos^2(psi) D(psi), and
 *   alpha = 2 Int_0^{pi/2} (phi'/sqrt(D) - 1) dpsi,   D = b^2 - a^2 - 2 (b - a)^2 w0 (s + 1/(1 + s)),   s = sin(psi).
 * phi'^2 - D, written out, is free of b^2: no term of the order of the flat pi remains to cancel. */
static double far_bending(double x, double y, const void *context)
{
    const struct far *f = context;
    (void)y;
    double a = f->a, b = f->b, s = sin(M_PI / 2 * x), chi = drag(a, b, f->w0 * s);
    double mass = 2 * (b - a) * (b - a) * f->w0 * (s + 1 / (1 + s));
    double root = sqrt(b * b - a * a - mass);
    return M_PI * (a * a + mass + chi * (2 * b + chi)) / (root * (root + b + chi));
}

/* Solves w'^2 = 0 by Newton's method from 1/b, which is below the root. The cubic is convex enough here that the method
 * hardly overshoots. */
static double nearest_w(double a, double b)
{
    double quadratic = b * b - a * a, cubic = 2 * (b - a) * (b - a), w = 1 / b;
    for (int i = 0; i < 8; i++)
        w -= (1 - w * w * (quadratic - cubic * w)) / (w * (3 * cubic * w - 2 * quadratic));
    return w;
}

static const double far_away = 20;

static struct kd_null_radial radial_of(double a, double b)
{
    struct kd_null_motion motion = kd_null_motion_of(kd_hole(a), 0, 1, -b, 0);
    struct kd_null_roots roots = kd_null_roots_of(&motion);
    return kd_null_radial_of(&motion, &roots, false);
}

double kd_deflection(const struct kd_hole *hole, double b)
{
    const double a = hole->a;
    double critical = kd_deflection_critical(hole);
    if (!(b >= critical))
        return NAN;
    if (b > far_away)
        return kd_quadrature(far_bending, &(struct far) { a, b, nearest_w(a, b) });
    struct kd_null_radial q = radial_of(a, b);
    return q.turns ? 2 * (b * q.turn.tau + q.turn.phi) - M_PI : INFINITY;
}

double kd_deflection_closest(const struct kd_hole *hole, double b)
{
    const double a = hole->a;
    if (!(b >= kd_deflection_critical(hole)))
        return NAN;
    if (b > far_away)
        return 1 / nearest_w(a, b);
    struct kd_null_radial q = radial_of(a, b);
    return q.turns ? q.roots.r4 : kd_kerr_photon_orbit(hole);
}

double kd_deflection_farthest(const struct kd_hole *hole, double b)
{
    const double a = hole->a;
    if (!(b >= kd_deflection_critical(hole)) || a * b > 2 * hole->outer)
        return NAN;
    struct kd_null_radial q = radial_of(a, b);
    return q.turns ? q.roots.r3 : kd_kerr_photon_orbit(hole);
}

double kd_deflection_weak(double b) { return 4 / b; }

double kd_deflection_weak_second(const struct kd_hole *hole, double b)
{
    return (4 + (15 * M_PI / 4 - 4 * hole->a) / b) / b;
}

/* On the critical ray w'^2 = cubic (w_c - w)^2 (w - w_1), w_1 = quadratic/cubic - 2 w_c < 0. */
struct critical { double a, b, w, w1, cubic, rate; };

/* The integrand without its pole at w_c: (rate(w) - rate(w_c))/(1 - w/w_c) for rate = (b + chi')/sqrt(cubic (w -
 * w_1)). The factor is taken out of both differences, that of chi' and that of the root. */
static double regular(double x, double y, const void *context)
{
    (void)y;
    const struct critical *c = context;
    double a = c->a, b = c->b, wc = c->w, w = wc * x, product = w * wc;
    double root = sqrt(c->cubic * (w - c->w1)), root_c = sqrt(c->cubic * (wc - c->w1));
    double chi = -wc * a * (2 - 2 * a * a * product - a * b * (w + wc - 2 * product)) / (slow(a, w) * slow(a, wc));
    return chi / root + c->rate * c->cubic * wc / (root * (root + root_c));
}

/* For b = b_c (1 + delta) the double root separates by +-e, e^2 = delta b_c (d w'^2/db)/(cubic (w_c - w_1)), and the
 * pole integrates to rate arcosh(w_c/e). */
struct kd_deflection_strong kd_deflection_strong(const struct kd_hole *hole)
{
    const double a = hole->a;
    double r = kd_kerr_photon_orbit(hole), b = kd_deflection_critical(hole);
    if (isnan(b))
        return (struct kd_deflection_strong) { NAN, NAN };
    struct critical c = { .a = a, .b = b, .w = 1 / r, .cubic = 2 * (b - a) * (b - a) };
    c.w1 = (b * b - a * a) / c.cubic - 2 * c.w;
    c.rate = (b + drag(a, b, c.w)) / sqrt(c.cubic * (c.w - c.w1));
    double by_b = 2 * c.w * c.w * (b - 2 * (b - a) * c.w); /* -d w'^2/db at w_c */
    double e2 = b * by_b / (c.cubic * (c.w - c.w1));
    double rest = kd_quadrature(regular, &c);
    return (struct kd_deflection_strong) { .rate = c.rate,
                                           .offset = c.rate * log(4 * c.w * c.w / e2) + 2 * rest - M_PI };
}
