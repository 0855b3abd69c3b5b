#include "physics/spacetime/infall.h"

#include "physics/math/quadrature.h"
#include "physics/math/root.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

bool kd_infall_is_level(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    return at->hole.a == 0 || at->u == 0 || at->s == 0 || (m->fall_momentum == 0 && kd_observer_energy(m, at) == 1);
}

/* A fall: (Sigma r')^2 = c[4] r^4 + ... + c[0]. If fall_from is finite, this polynomial is stored without the factor
 * fall_from - r, which vanishes at fall_from. */
struct fall {
    struct kd_hole hole;
    /* c: coefficients of the polynomial. above: distance from the upper end of the range of r to fall_from */
    double c[5], u, low, span, above;
    /* energy: E. momentum: L. swing: L/sin^2(theta). carter: K = Q + (L - a E)^2 */
    double energy, momentum, swing, carter;
    bool from_rest;
};

static struct fall fall_of(const struct kd_observer_motion *m, const struct kd_vantage *at, double r)
{
    double a = at->hole.a, e = kd_observer_energy(m, at), l = m->fall_momentum, bound = (e - 1) * (e + 1);
    double ls = l == 0 ? 0 : l / at->s, q = at->u * at->u * (ls * ls - a * a * bound), rest = l - a * e;
    const double k = q + rest * rest;
    double c[5];
    kd_hole_radial(&at->hole, bound, a * a * bound - l * l - q, q, k, c);
    struct fall f = {
        .c = { c[4], c[3], c[2], c[1], c[0] },
        .hole = at->hole,
        .u = at->u,
        .low = r,
        .span = at->r - r,
        .above = m->fall_from - at->r,
        .from_rest = isfinite(m->fall_from),
        .energy = e,
        .momentum = l,
        .swing = l == 0 ? 0 : ls / at->s,
        .carter = k,
    };
    /* divides by fall_from - r. Coefficients are in ascending powers; without spin the first ones are exactly 0 */
    if (f.from_rest)
        for (int i = 0; i < 4; i++)
            f.c[i] = (f.c[i] + (i ? f.c[i - 1] : 0)) / m->fall_from;
    return f;
}

/* P = E (r^2 + a^2) - a L at r. */
static double momentum_inwards(const struct fall *f, double r)
{
    double a = f->hole.a;
    return f->energy * (r * r + a * a) - a * f->momentum;
}

/* -Sigma r'. y: distance from the upper end of the range, divided by the length of the range. Between the horizons the
 * function uses (Sigma r')^2 = P^2 - Delta (r^2 + K), which is a sum of positive terms there. The polynomial would lose
 * digits by cancellation if the horizons almost coincided. */
static double speed(const struct fall *f, double r, double y)
{
    double speed2 = 0, delta = kd_hole_delta(&f->hole, r), p = momentum_inwards(f, r);
    if (delta < 0)
        return sqrt(p * p - delta * (r * r + f->carter));
    for (int i = f->from_rest ? 3 : 4; i >= 0; i--)
        speed2 = speed2 * r + f->c[i];
    if (f->from_rest)
        speed2 *= f->above + f->span * y;
    return sqrt(speed2);
}

static double pace(double x, double y, const void *user)
{
    const struct fall *f = user;
    double r = f->low + f->span * x;
    return f->span * (r * r + f->hole.a * f->hole.a * f->u * f->u) / speed(f, r, y);
}

double kd_infall_proper_time(const struct kd_observer_motion *m, const struct kd_vantage *at, double r)
{
    const struct fall f = fall_of(m, at, r);
    return f.span > 0 ? kd_quadrature(pace, &f) : 0;
}

/* (P + Sigma r')/Delta. It is regular at the horizon, because P^2 - (Sigma r')^2 = Delta (r^2 + K). */
static double ingoing(const struct fall *f, double r, double speed)
{
    double p = momentum_inwards(f, r);
    return p > 0 ? (r * r + f->carter) / (p + speed) : (p - speed) / kd_hole_delta(&f->hole, r);
}

/* Sigma dphi/dtau, where phi is that of ingoing Kerr-Schild coordinates: Boyer-Lindquist phi + integral of a/Delta dr
 * (Carter 1968). */
static double turning(double x, double y, const void *user)
{
    const struct fall *f = user;
    double r = f->low + f->span * x, v = speed(f, r, y);
    return f->span * (f->swing - f->hole.a * f->energy + f->hole.a * ingoing(f, r, v)) / v;
}

/* Sigma dt/dtau, where t is that of the same coordinates: Boyer-Lindquist t + integral of (2r - q^2)/Delta dr. */
static double ageing(double x, double y, const void *user)
{
    const struct fall *f = user;
    double a = f->hole.a, r = f->low + f->span * x, v = speed(f, r, y), s2 = (1 - f->u) * (1 + f->u);
    return f->span * (a * (f->momentum - a * f->energy * s2) + (r * r + a * a) * ingoing(f, r, v) + v) / v;
}

/* The integral of (2r - q^2)/Delta over r, up to a constant, for r outside the horizon. */
static double delay(const struct kd_hole *hole, double r)
{
    const double outer = hole->outer, inner = hole->inner;
    return 2 / (outer - inner) *
           (0.5 * kd_hole_mass(hole, outer) * log(r - outer) - 0.5 * kd_hole_mass(hole, inner) * log(r - inner));
}

struct kd_infall_way kd_infall_way(const struct kd_observer_motion *m, const struct kd_vantage *at, double r)
{
    const struct fall f = fall_of(m, at, r);
    struct kd_infall_way way = { .r = r };
    if (!(f.span > 0))
        return way;
    way.azimuth = kd_quadrature(turning, &f);
    way.time = kd_quadrature(ageing, &f);
    way.far_time = r > f.hole.outer ? way.time + delay(&f.hole, at->r) - delay(&f.hole, r) : INFINITY;
    return way;
}

double kd_infall_last(const struct kd_hole *hole)
{
    double outer = hole->outer, inner = hole->inner;
    return fmax(0.01, inner + fmin(0.01, 0.1 * (outer - inner)));
}

struct clock {
    const struct kd_observer_motion *motion;
    const struct kd_vantage *at;
    double proper_time;
};

static double too_far(const void *user, double r)
{
    const struct clock *c = user;
    return kd_infall_proper_time(c->motion, c->at, r) - c->proper_time;
}

struct kd_infall_way kd_infall_after(const struct kd_observer_motion *m, const struct kd_vantage *at,
                                     double proper_time)
{
    const struct clock clock = { m, at, proper_time };
    double last = fmin(kd_infall_last(&at->hole), at->r);
    bool ends = !(too_far(&clock, last) > 0);
    struct kd_infall_way way = kd_infall_way(m, at, ends ? last : kd_root(too_far, &clock, last, at->r));
    way.ended = ends;
    return way;
}
