#include "physics/null/deflection.h"

#include "physics/math/quadrature.h"
#include "physics/null/null_radial.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

double kd_deflection_critical(const struct kd_hole *hole)
{
    return fabs(hole->a) < 1 ? kd_kerr_critical_impact(hole) : NAN;
}

/* The orbit of light in w = 1/r and Mino time, with E = 1, L = b and Q = 0 (docs/physics/geodesics.md):
 *   w'^2 = 1 - (b^2 - a^2) w^2 + 2 (b - a)^2 w^3 - q^2 (b - a)^2 w^4,   phi' = b + chi',
 *   chi' = a (2w - (a b + q^2) w^2)/(1 - 2w + (a^2 + q^2) w^2). */
struct light {
    const struct kd_hole *hole;
    double a, b, drag; /* a b + q^2 */
};

static struct light light_of(const struct kd_hole *hole, double b)
{
    return (struct light) { hole, hole->a, b, kd_hole_rates_of(hole, 1, b).drag };
}

static double drag(const struct light *o, double w)
{
    return o->a * w * (2 - o->drag * w) / kd_hole_delta_w(o->hole, w);
}

static double quadratic(const struct light *o) { return o->b * o->b - o->a * o->a; }
static double cubic(const struct light *o) { return 2 * (o->b - o->a) * (o->b - o->a); }
static double quartic(const struct light *o) { return kd_hole_quartic(o->hole, 0, (o->b - o->a) * (o->b - o->a)); }

struct far {
    struct light light;
    double w0; /* w at the closest approach to the hole */
};

/* Integrand of the bending at large b. With w = w0 sin(psi), w'^2 is w0^2 cos^2(psi) D(psi), where the root at the
 * closest approach is divided out. Then
 *   alpha = 2 Int_0^{pi/2} (phi'/sqrt(D) - 1) dpsi,   s = sin(psi),
 *   D = b^2 - a^2 - (b - a)^2 w0 (2 (s + 1/(1 + s)) - q^2 w0 (1 + s^2)).
 * When phi'^2 - D is written out, b^2 cancels. So no terms as large as pi, the value for a straight ray, cancel. */
static double far_bending(double x, double y, const void *context)
{
    const struct far *f = context;
    (void)y;
    double a = f->light.a, b = f->light.b, s = sin(M_PI / 2 * x), chi = drag(&f->light, f->w0 * s);
    double mass = cubic(&f->light) * f->w0 * (s + 1 / (1 + s)) - quartic(&f->light) * f->w0 * f->w0 * (1 + s * s);
    double root = sqrt(b * b - a * a - mass);
    return M_PI * (a * a + mass + chi * (2 * b + chi)) / (root * (root + b + chi));
}

/* w at the closest approach, where w'^2 = 0. Newton's method starts from 1/b, which is below the root. Between 1/b and
 * the root the polynomial is so nearly convex that the method hardly overshoots. */
static double nearest_w(const struct light *o)
{
    const double two = quadratic(o), three = cubic(o), four = quartic(o);
    double w = 1 / o->b;
    for (int i = 0; i < 8; i++)
        w -= (1 - w * w * (two - (three - four * w) * w)) / (w * (3 * three * w - 2 * two - 4 * four * w * w));
    return w;
}

static const double far_away = 20;

static struct kd_null_radial radial_of(const struct kd_hole *hole, double b)
{
    struct kd_null_motion motion = kd_null_motion_of(hole, 0, 1, -b, 0);
    struct kd_null_roots roots = kd_null_roots_of(&motion);
    return kd_null_radial_of(&motion, &roots, false, KD_NULL_TAU_PHI);
}

double kd_deflection(const struct kd_hole *hole, double b)
{
    const struct light light = light_of(hole, b);
    double critical = kd_deflection_critical(hole);
    if (!(b >= critical))
        return NAN;
    if (b > far_away)
        return kd_quadrature(far_bending, &(struct far) { light, nearest_w(&light) });
    struct kd_null_radial q = radial_of(hole, b);
    return q.turns ? 2 * (b * q.turn.tau + q.turn.phi) - M_PI : INFINITY;
}

double kd_deflection_closest(const struct kd_hole *hole, double b)
{
    const struct light light = light_of(hole, b);
    if (!(b >= kd_deflection_critical(hole)))
        return NAN;
    if (b > far_away)
        return 1 / nearest_w(&light);
    struct kd_null_radial q = radial_of(hole, b);
    return q.turns ? q.roots.r4 : kd_kerr_photon_orbit(hole);
}

double kd_deflection_farthest(const struct kd_hole *hole, double b)
{
    const double a = hole->a;
    if (!(b >= kd_deflection_critical(hole)) || a * b > kd_hole_mass(hole, hole->outer))
        return NAN;
    struct kd_null_radial q = radial_of(hole, b);
    return q.turns ? q.roots.r3 : kd_kerr_photon_orbit(hole);
}

double kd_deflection_weak(double b) { return 4 / b; }

double kd_deflection_weak_second(const struct kd_hole *hole, double b) { return kd_kerr_weak_bending(hole, b); }

/* Coefficients of the critical ray, for which w'^2 = (w_c - w)^2 (linear (w - w_1) - quartic w^2). linear = cubic - 2
 * quartic w_c, and w_1 = (quadratic - quartic w_c^2)/linear - 2 w_c is negative. */
struct critical {
    struct light light;
    double w, w1, linear, quartic, rate;
};

static double rest_of(const struct critical *c, double w) { return c->linear * (w - c->w1) - c->quartic * w * w; }

/* The integrand without its pole at w_c: (rate(w) - rate(w_c))/(1 - w/w_c) for rate = (b + chi')/sqrt(rest). The
 * numerator is a sum of two differences, one of chi' and one of the root. In each difference the factor 1 - w/w_c is
 * divided out algebraically. */
static double regular(double x, double y, const void *context)
{
    (void)y;
    const struct critical *c = context;
    const struct light *o = &c->light;
    double wc = c->w, w = wc * x, product = w * wc;
    double root = sqrt(rest_of(c, w)), root_c = sqrt(rest_of(c, wc));
    double chi = -wc * o->a * (2 - 2 * kd_hole_horizons(o->hole) * product - o->drag * (w + wc - 2 * product)) /
                 (kd_hole_delta_w(o->hole, w) * kd_hole_delta_w(o->hole, wc));
    return chi / root + c->rate * (c->linear - c->quartic * (w + wc)) * wc / (root * (root + root_c));
}

/* Bozza's limit. For b = b_c (1 + delta) the two roots move apart to w_c +- e, with e^2 = delta b_c (d
 * w'^2/db)/rest(w_c). The integral of the pole is then rate arcosh(w_c/e). */
struct kd_deflection_strong kd_deflection_strong(const struct kd_hole *hole)
{
    double r = kd_kerr_photon_orbit(hole), b = kd_deflection_critical(hole);
    const struct light o = light_of(hole, b);
    if (isnan(b))
        return (struct kd_deflection_strong) { NAN, NAN };
    struct critical c = { .light = o, .w = 1 / r, .quartic = quartic(&o) };
    c.linear = cubic(&o) - 2 * c.quartic * c.w;
    c.w1 = (quadratic(&o) - c.quartic * c.w * c.w) / c.linear - 2 * c.w;
    c.rate = (b + drag(&o, c.w)) / sqrt(rest_of(&c, c.w));
    double by_b = 2 * c.w * c.w * (b - kd_hole_mass_w(hole, c.w) * (b - o.a) * c.w); /* -d(w'^2)/db at w = w_c */
    double e2 = b * by_b / rest_of(&c, c.w);
    double rest = kd_quadrature(regular, &c);
    return (struct kd_deflection_strong) { .rate = c.rate,
                                           .offset = c.rate * log(4 * c.w * c.w / e2) + 2 * rest - M_PI };
}
