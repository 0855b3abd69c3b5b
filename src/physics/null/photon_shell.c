#include "physics/null/photon_shell.h"

#include "physics/math/carlson.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdbool.h>

/* y = r - 1 of the prograde equatorial orbit without charge, from r = 4 cos^2(acos(-a)/3) [Bardeen, Press & Teukolsky
 * 1972, eq. 2.18]. With d = acos(a)/3 it is 2 sin^2 d + sqrt(3) sin 2d, in which all terms are positive. */
static double prograde_y(double spin)
{
    double d = 2.0 / 3 * asin(sqrt(0.5 * (1 - spin)));
    return 2 * sin(d) * (sin(d) + sqrt(3) * cos(d));
}

static double place_of(const struct kd_shell *s, double y, double w)
{
    double half = 0.5 * s->y_polar;
    return y >= half ? w : (half / s->spin) * (log(y / half) - 1);
}

/* y_P by Newton's method. It starts from y = 2, where the cubic is 4a^2 + 6q^2 >= 0; beyond this point the cubic is
 * convex. c: 1 + a^2 + 2N. */
static double polar_y(double c, double n)
{
    double y = 2;
    for (int i = 0; i < 12; i++)
        y -= ((y * y - c) * y - 2 * n) / (3 * y * y - c);
    return y;
}

/* The shell of a charged hole. The equatorial orbits are the roots of P of kerr.h, and have x = -+2s/(y + y_0 - 1). */
static void charged_shell(struct kd_shell *s, const struct kd_hole *hole)
{
    const double a2 = s->spin * s->spin;
    const struct kd_hole *with = kd_hole_turned(hole, hole->a < 0 ? -1 : 1),
                         *against = kd_hole_turned(hole, hole->a < 0 ? 1 : -1);
    s->charged = true;
    s->n = hole->root * hole->root;
    s->y_still = 0.5 * (1 + sqrt(1 + 8 * (s->n + a2)));
    s->y_polar = polar_y(1 + a2 + 2 * s->n, s->n);
    s->x_polar = -s->spin * (s->y_polar + 2) / ((s->y_polar + 1) * (s->y_polar + s->y_still - 1));
    const double pro = kd_kerr_ring_of_light(with), retro = kd_kerr_ring_of_light(against);
    s->prograde = place_of(s, pro, -2 * kd_kerr_ring_at(with, pro).s / (pro + s->y_still - 1) - s->x_polar);
    s->retrograde = 2 * kd_kerr_ring_at(against, retro).s / (retro + s->y_still - 1) - s->x_polar;
}

struct kd_shell kd_shell_of(const struct kd_hole *hole)
{
    const double a = hole->a;
    struct kd_shell s = { .a = a, .spin = fabs(a), .n = (1 - a) * (1 + a), .y_still = 2 };
    double a2 = a * a;
    if (kd_hole_is_charged(hole)) {
        charged_shell(&s, hole);
        return s;
    }
    s.y_polar = polar_y(3 - a2, s.n);
    s.x_polar = -4 * s.spin / ((1 + s.y_polar) * (1 + s.y_polar) + a2);
    /* The equatorial orbits satisfy r x^2 = 4. */
    double y = prograde_y(s.spin);
    s.prograde = place_of(&s, y, -2 / sqrt(1 + y) - s.x_polar);
    s.retrograde = 2 / sqrt(kd_kerr_photon_orbit(kd_hole(-s.spin))) - s.x_polar;
    return s;
}

static struct kd_shell_orbit orbit(const struct kd_shell *s, double y, double w)
{
    struct kd_shell_orbit o = { .a = s->a, .r = 1 + y, .y = y, .w = w, .n = s->n };
    double x = s->x_polar + w, cube = o.r * o.r * o.r;
    o.lambda = -copysign(1, s->a) * w * (y + s->y_polar + 2 * s->n / (y * s->y_polar));
    if (s->charged) {
        const double a = s->spin, still = s->n + a * a, m = x * (y + s->y_still - 1), square = o.r * o.r / (y * y);
        o.eta =
            square * (y < a ? (y * y * (2 * a - 1 + y) * (2 * a + 1 - y) - 4 * s->n * (still + y * (1 - y))) / (a * a)
                            : 4 * (y + still) - m * m);
        return o;
    }
    o.eta = y < 1 ? cube / (s->spin * s->spin) * (3 - y - 4 * s->n / (y * y)) : cube / (y * y) * (4 - o.r * x * x);
    return o;
}

struct kd_shell_orbit kd_shell_orbit_at(const struct kd_shell *s, double place)
{
    double half = 0.5 * s->y_polar, y = s->y_polar + s->spin * place;
    if (y >= half)
        return orbit(s, y, place);
    y = half * exp(s->spin * place / half + 1);
    return orbit(s, y, (y - s->y_polar) / s->spin);
}

struct kd_shell_orbit kd_shell_orbit_of_radius(const struct kd_hole *hole, double r)
{
    const double a = hole->a;
    struct kd_shell s = kd_shell_of(hole);
    double y = r - 1;
    const double sense = a < 0 ? -1 : 1;
    bool there = a != 0 && r >= kd_kerr_photon_orbit(kd_hole_turned(hole, sense)) &&
                 r <= kd_kerr_photon_orbit(kd_hole_turned(hole, -sense));
    return there ? orbit(&s, y, (y - s.y_polar) / s.spin) : (struct kd_shell_orbit) { a, NAN, NAN, NAN, NAN, NAN, s.n };
}

double kd_shell_bend(const struct kd_shell_orbit *o) { return 4 * o->r * (o->y * o->y * o->y + o->n) / (o->y * o->y); }

double kd_shell_inside(const struct kd_hole *hole, const struct kd_shell_orbit *o)
{
    const double q = o->a / o->r;
    return q * q * o->eta + 4 * (hole->q * hole->q) * kd_hole_delta_y(hole, o->y) / (o->y * o->y);
}

/* Polar integrals with u = sqrt(z) cos x, as in null_polar.h: du/dtau^2 = (z - u^2)(n + a^2 u^2), and disc = n + a^2 z.
 * The radial rates use (r^2 + a^2 - a lambda)/Delta = 2r/y, which holds on spherical photon orbits. */
struct kd_shell_exponents kd_shell_exponents(const struct kd_shell_orbit *o)
{
    double a = fabs(o->a), a2 = a * a, lambda = fabs(o->lambda), eta = fmax(o->eta, 0), r = o->r;
    double retro = o->w > 0 ? -1 : 1;                /* sign of a lambda */
    double minus = eta + o->lambda * o->lambda - a2; /* n - a^2 z, which is positive */
    double disc = hypot(minus, 2 * a * sqrt(eta)), n = 0.5 * (disc + minus), z = eta / n, root = sqrt(disc);
    double cc = lambda / (n + a2), nu = a2 * cc * cc, k1 = n / disc;
    double f = kd_carlson_rf(0, k1, 1);
    struct kd_shell_exponents e = { .mino = 2 * f / root };
    double u2 = 2 * z * (f - kd_carlson_rd(0, k1, 1) / 3) / root;
    double azimuth = M_PI + 2 * a2 * cc * kd_carlson_rj(0, k1, 1, 1 / (1 - nu)) / (3 * (1 - nu) * root);
    e.gamma = sqrt(kd_shell_bend(o)) * e.mino;
    e.delta = copysign(1, o->a) * (retro * azimuth + a * (2 * r / o->y - 1) * e.mino);
    e.tau = ((r * r + a2) * 2 * r / o->y + a * (retro * lambda - a)) * e.mino + a2 * u2;
    return e;
}
