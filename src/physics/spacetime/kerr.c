#include "physics/spacetime/kerr.h"

#include "physics/math/root.h"

#include <math.h>

/* (1 - a)(1 + a), because 1 - a*a loses all digits as |a| -> 1. */
static double one_minus_a2(double a) { return (1 - a) * (1 + a); }

double kd_kerr_twist(const struct kd_hole *hole, double r)
{
    double gap = r - hole->outer, apart = 2 * hole->root;
    return hole->a / apart * log1p(apart / gap);
}

double kd_kerr_ergosphere(const struct kd_hole *hole, double cos_theta)
{
    if (kd_hole_is_charged(hole)) /* uses 1 - q^2 - a^2 cos^2 = root^2 + a^2 sin^2 */
        return 1 + sqrt(hole->root * hole->root + hole->a * hole->a * (1 - cos_theta) * (1 + cos_theta));
    return 1 + sqrt(one_minus_a2(hole->a * cos_theta));
}

struct kd_kerr_ring kd_kerr_ring_at(const struct kd_hole *hole, double y)
{
    const double a = hole->a, n = hole->root * hole->root, s = sqrt(fmax(0, y + n + a * a));
    struct kd_kerr_ring o = { .y = y, .s = s, .sigma = a > 0 ? (y + n) / (s + a) : s - a };
    o.delta = kd_hole_delta_y(hole, y);
    o.p2 = o.delta - o.sigma * o.sigma;
    return o;
}

double kd_kerr_ring_excess(const struct kd_hole *hole, const struct kd_kerr_ring *o)
{
    const double a = hole->a, n = hole->root * hole->root, s = o->s, y = o->y, r = 1 + y, sum = s + a;
    if (!(a > 0))
        return r * o->delta - 4 * s * s * o->sigma * o->sigma;
    return (y * y * (y * sum * sum - o->sigma * (3 * s + a)) - n * (r * sum * sum + 4 * s * s * (2 * y + n))) /
           (sum * sum);
}

static double light_circles(const void *hole, double y) { return kd_kerr_ring_at(hole, y).p2; }

static double orbit_is_stable(const void *hole, double y)
{
    const struct kd_kerr_ring o = kd_kerr_ring_at(hole, y);
    return kd_kerr_ring_excess(hole, &o);
}

/* Places of these orbits, by a search. Without charge the orbits are at r < 4.01 and r < 9.01, and charge moves them
 * inwards. */
double kd_kerr_ring_of_light(const struct kd_hole *hole) { return kd_root(light_circles, hole, hole->root, 3.01); }

double kd_kerr_ring_innermost(const struct kd_hole *hole)
{
    return kd_root(orbit_is_stable, hole, kd_kerr_ring_of_light(hole), 8.01);
}

static struct kd_kerr_ring ring_of(const struct kd_hole *hole, double r) { return kd_kerr_ring_at(hole, r - 1); }

double kd_kerr_isco(const struct kd_hole *hole)
{
    const double a = hole->a;
    if (kd_hole_is_charged(hole))
        return 1 + kd_kerr_ring_innermost(hole);
    if (a == 0) /* sqrt(6) would be rounded, and its square would be less than 6 */
        return 6;
    double z1 = 1 + cbrt(one_minus_a2(a)) * (cbrt(1 + a) + cbrt(1 - a));
    double z2 = sqrt(3 * a * a + z1 * z1);
    double r = 3 + z2 - copysign(sqrt(fmax(0, 3 - z1) * (3 + z1 + 2 * z2)), a);

    /* For small a, 3 - Z1 loses digits by cancellation and may be negative, and its root is accurate to 1e-8 only.
     * Newton's method on the defining quartic in x = sqrt(r), x^4 - 6x^2 + 8ax - 3a^2 = 0, restores the digits. Near a
     * = 1 the quartic has a triple root, and the formula is more accurate. */
    if (fabs(a) < 0.7) {
        double x = sqrt(r);
        for (int i = 0; i < 3; i++)
            x -= (((x * x - 6) * x + 8 * a) * x - 3 * a * a) / ((4 * x * x - 12) * x + 8 * a);
        r = x * x;
    }
    return fabs(a) <= 1 ? r : NAN; /* returns NaN outside the domain, where the cube roots would still give a number */
}

double kd_kerr_photon_orbit(const struct kd_hole *hole)
{
    if (kd_hole_is_charged(hole))
        return 1 + kd_kerr_ring_of_light(hole);
    /* 2(1 + cos(2/3 acos(-a))) = 4 cos^2(acos(-a)/3). */
    double c = cos(acos(-hole->a) / 3);
    return 4 * c * c;
}

double kd_kerr_critical_impact(const struct kd_hole *hole)
{
    if (kd_hole_is_charged(hole))
        return 1 / kd_kerr_omega(hole, kd_kerr_photon_orbit(hole));
    return 6 * cos(acos(-hole->a) / 3) - hole->a;
}

double kd_kerr_outermost_photon_orbit(const struct kd_hole *hole)
{
    return kd_kerr_photon_orbit(kd_hole_turned(hole, hole->a > 0 ? -1 : 1));
}

/* A function of y = r - 1 with the sign of E - 1: r P (E - 1). */
static double energy_above_rest(const void *user, double y)
{
    const struct kd_hole *hole = user;
    const struct kd_kerr_ring o = kd_kerr_ring_at(hole, y);
    return o.delta + hole->a * o.sigma - (1 + y) * sqrt(fmax(0, o.p2));
}

double kd_kerr_marginally_bound(const struct kd_hole *hole)
{
    const double a = hole->a;
    /* E decreases from infinity at the photon orbit to less than 1 at the ISCO, so these radii bracket the root */
    if (kd_hole_is_charged(hole))
        return 1 + kd_root(energy_above_rest, hole, kd_kerr_ring_of_light(hole), kd_kerr_ring_innermost(hole));
    double s = 1 + sqrt(1 - a);
    return a >= -1 ? s * s : NAN;
}

double kd_kerr_omega(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole)) {
        const double s = ring_of(hole, r).s;
        return s / (r * r + hole->a * s);
    }
    return 1 / (r * sqrt(r) + hole->a);
}

/* Near a = 1 prograde orbits are close to r = 1, where 1 - 3/r + 2a/r^(3/2) and the numerators of E and L cancel and
 * lose half their digits. These expressions are polynomials in x = sqrt(r). They are regrouped about x = 1, in terms of
 * x - 1 and 1 - a, which have full precision. */
struct circle { double x, d, e, norm; }; /* sqrt(r); x - 1; 1 - a; sqrt(x^3 (x^3 - 3x + 2a)) */

static struct circle circle_of(double a, double r)
{
    struct circle o = { .x = sqrt(r), .e = 1 - a };
    o.d = (r - 1) / (o.x + 1);
    o.norm = sqrt(r * o.x * (o.d * o.d * (o.x + 2) - 2 * o.e)); /* this root vanishes at the photon orbit */
    return o;
}

/* E = (x^3 - 2x + a) / sqrt(x^3 (x^3 - 3x + 2a)) */
double kd_kerr_energy(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring g = ring_of(hole, r);
        return (g.delta + hole->a * g.sigma) / (r * sqrt(g.p2));
    }
    struct circle o = circle_of(hole->a, r);
    return (o.d * (r + o.x - 1) - o.e) / o.norm;
}

/* L = (x^4 - 2ax + a^2) / sqrt(x^3 (x^3 - 3x + 2a)) */
double kd_kerr_momentum(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring g = ring_of(hole, r);
        return (hole->a * g.delta + (r * r + hole->a * hole->a) * g.sigma) / (r * sqrt(g.p2));
    }
    struct circle o = circle_of(hole->a, r);
    return (o.d * (o.x * (r + o.x + 1) - 1) + o.e * (2 * o.d + o.e)) / o.norm;
}

double kd_kerr_ut(const struct kd_hole *hole, double r)
{
    const double a = hole->a;
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring g = ring_of(hole, r);
        return (r * r + a * g.s) / (r * sqrt(g.p2));
    }
    struct circle o = circle_of(a, r);
    return (r * o.x + a) / o.norm;
}

/* The radial stiffness. Without charge it is x^4 - 6x^2 + 8ax - 3a^2 with x = sqrt(r), the quartic whose root is the
 * ISCO. For a = 1 the root is triple, at x = 1. Written in d = x - 1 and e = 1 - a, the quartic has no avoidable
 * cancellation there. */
double kd_kerr_stiffness_radial(const struct kd_hole *hole, double r)
{
    if (r == kd_kerr_isco(hole)) /* returns exactly 0 at the ISCO, instead of a rounding error */
        return 0;
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring o = ring_of(hole, r);
        return kd_kerr_ring_excess(hole, &o) / (o.s * o.s);
    }
    double x = sqrt(r), d = (r - 1) / (x + 1), e = 1 - hole->a;
    return d * d * d * (d + 4) - e * (2 + 8 * d + 3 * e);
}

/* The vertical stiffness. Without charge it is x^4 - 4ax + 3a^2, which has a double root at a = x = 1. */
double kd_kerr_stiffness_vertical(const struct kd_hole *hole, double r)
{
    if (kd_hole_is_charged(hole)) {
        const struct kd_kerr_ring o = ring_of(hole, r);
        const double a = hole->a;
        return ((r * r + a * a) * o.sigma * o.sigma + a * (2 * o.sigma + a) * o.delta) / (o.s * o.s);
    }
    double x = sqrt(r), d = (r - 1) / (x + 1), e = 1 - hole->a;
    return d * d * (r + 2 * x + 3) + e * (4 * d - 2 + 3 * e);
}

double kd_kerr_weak_bending(const struct kd_hole *hole, double b)
{
    return (4 + (15 * M_PI / 4 - 4 * hole->a - 3 * M_PI / 4 * hole->q * hole->q) / b) / b;
}

double kd_kerr_weak_advance(const struct kd_hole *hole, double p) { return (6 - hole->q * hole->q) * M_PI / p; }

/* At the ISCO E^2 = 1 - 2/(3 r) [BPT 2.12 with 2.21], which gives 1 - E without a subtraction. */
double kd_kerr_efficiency(const struct kd_hole *hole)
{
    if (kd_hole_is_charged(hole))
        return 1 - kd_kerr_energy(hole, kd_kerr_isco(hole));
    double x = 2 / (3 * kd_kerr_isco(hole));
    return x / (1 + sqrt(1 - x));
}

double kd_kerr_dragging(const struct kd_hole *hole, double r, double cos_theta)
{
    return kd_metric_at(hole, r, cos_theta).omega;
}

double kd_kerr_rotation_reach(const struct kd_hole *hole, double r, double cos_theta, double sin_theta)
{
    const double a = hole->a;
    double delta = fmax(0, kd_hole_delta(hole, r)), w = r * r + a * a;
    double sigma = r * r + a * a * cos_theta * cos_theta;
    return sqrt(delta) * sigma / ((w * w - a * a * delta * sin_theta * sin_theta) * sin_theta);
}

/* dOmega/dr = -(3 r^2/2 - 2 q^2 r)/(s (r^2 + a s)^2), with s^2 = r - q^2. */
double kd_kerr_shear(const struct kd_hole *hole, double r)
{
    const double q2 = hole->q * hole->q, s = sqrt(r - q2), under = r * r + hole->a * s;
    return -(1.5 * r * r - 2 * q2 * r) / (s * under * under);
}
