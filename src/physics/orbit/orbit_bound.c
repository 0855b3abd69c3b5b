#include "physics/orbit/orbit_bound.h"

#include "physics/math/carlson.h"
#include "physics/math/elliptic.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* A phase between 0 and K, by sn, cn^2 and dn^2, each without cancellation. */
struct phase { double s, c2, d2; };

/* Integral of sn^2 from 0 to a phase. The next function: integral of sn^2/(1 - n sn^2). rest: 1 - n sn^2 at the phase.
 */
static double integral_s2(struct phase at)
{
    return at.s == 0 ? 0 : at.s * at.s * at.s * kd_carlson_rd(at.c2, at.d2, 1) / 3;
}

static double integral_pole(struct phase at, double rest)
{
    return at.s == 0 ? 0 : at.s * at.s * at.s * kd_carlson_rj(at.c2, at.d2, 1, rest) / 3;
}

/* Int du/Delta, from the integral of du/(r - r-). It is the divided difference, over r+ - r-, of the integral `j_plus`
 * below. The divided difference D of a product is D(f g) = f(r+) D(g) + g(r-) D(f). beyond: r2 - r+ and r2 - r-; s2:
 * sn^2 at the end. */
static double between_poles(const struct kd_orbit_bound *b, double u, struct phase at, const double beyond[2])
{
    const double s2 = at.s * at.s, fall = b->h * (b->r[1] - b->r[2]), both = beyond[0] * beyond[1],
                 plus = 1 - b->h_plus * s2, minus = 1 - b->h_minus * s2, third = at.s * s2 / 3;
    if (at.s == 0)
        return u / both;
    const struct kd_carlson_arg arg = { sqrt(at.c2), sqrt(at.d2) + 1, sqrt(at.d2) };
    const double slope = third * kd_carlson_rj_slope(arg, plus, minus) * s2 * fall / both,
                 pole = third * kd_carlson_rj(at.c2, at.d2, 1, minus);
    return u / both - fall * (slope / (beyond[0] * beyond[0]) + pole * (beyond[0] + beyond[1]) / (both * both));
}

/* Radial part of the integrals from periastron to the phase u, whose functions are `at`. With s = sn^2,
 *
 *   r = r2 + (r2 - r3) h s/(1 - h s)      1/(r - r5) = (1 - h (r2 - r3)/(r2 - r5) s/(1 - h5 s))/(r2 - r5)
 *
 * where h = (r1 - r2)/(r1 - r3) and h5 = h (r3 - r5)/(r2 - r5) [Fujita & Hikida eqs 27 to 32]. The integral of r^2
 * follows from d/du [sn cn dn/(1 - h s)]. With S and T the integrals of s and of s/(1 - h s), and q = k_r/h, which
 * stays finite,
 *
 *   Int r^2 = r2^2 u + 2 r2 (r2 - r3) h T - (r1 - r3)(r2 - r4) h/2 [sn cn dn/(1 - h s) - u - (3h - 2 - 2k + q) T +
 *     q S] */
static struct kd_orbit_sums radial_sums(const struct kd_orbit_bound *b, double u, struct phase at)
{
    const struct kd_orbit *o = &b->orbit;
    double a = o->hole.a, plus = o->hole.outer, minus = o->hole.inner, gap = plus - minus;
    double r1 = b->r[0], r2 = b->r[1], r3 = b->r[2], r4 = b->r[3], s2 = at.s * at.s, h1 = (r2 - r3) / (r1 - r3);
    if (o->circular)
        h1 = 1;
    double rest = b->h == 0 ? 1 : at.c2 + h1 * s2; /* 1 - h s */
    double q = (r3 - r4) / (r2 - r4);
    double sum_s = integral_s2(at), pole = integral_pole(at, rest);
    double bracket = at.s * sqrt(at.c2 * at.d2) / rest - u - (3 * b->h - 2 - 2 * b->k_r + q) * pole + q * sum_s;
    double i1 = r2 * u + (r2 - r3) * b->h * pole;
    double i2 = r2 * r2 * u + 2 * r2 * (r2 - r3) * b->h * pole - 0.5 * (r1 - r3) * (r2 - r4) * b->h * bracket;
    const double *beyond = b->beyond;
    double at_plus = b->h * (r2 - r3) / beyond[0] * integral_pole(at, 1 - b->h_plus * s2);
    double at_minus = b->h * (r2 - r3) / beyond[1] * integral_pole(at, 1 - b->h_minus * s2);
    double j_plus = (u - at_plus) / beyond[0], j_minus = (u - at_minus) / beyond[1];
    double flat = 4 * a * a * o->energy + o->nearer;
    double poles_t = ((o->near * plus - flat) * j_plus - (o->near * minus - flat) * j_minus) / gap;
    double twice = 2 * o->energy, back = o->drag;
    double poles_phi = ((twice * plus - back) * j_plus - (twice * minus - back) * j_minus) / gap;
    /* splits each numerator into a multiple of r - 1, which is the mean of both poles, and a remainder */
    if (kd_hole_is_close(&o->hole)) {
        double mean = 0.5 * (j_plus + j_minus), both = between_poles(b, u, at, beyond);
        poles_t = o->near * mean + (o->near - flat) * both;
        poles_phi = twice * mean + (twice - back) * both;
    }
    return (struct kd_orbit_sums) {
        .proper = i2 / b->unit_r,
        .t = (o->energy * (i2 + 2 * i1 + o->four * u) + poles_t) / b->unit_r,
        .phi = a * poles_phi / b->unit_r,
    };
}

/* True if L = 0 and the motion reaches the axis. The motion then passes the axis at each turning point of theta, where
 * the azimuth jumps by pi. */
static bool through_axis(const struct kd_orbit *o) { return o->momentum == 0 && o->axis_gap == 0; }

/* Polar part of the integrals from the equator to the phase u, whose functions are `at`. */
static struct kd_orbit_sums polar_sums(const struct kd_orbit_bound *b, double u, struct phase at)
{
    const struct kd_orbit *o = &b->orbit;
    double a2 = o->hole.a * o->hole.a, u2 = a2 * o->z * integral_s2(at) / b->pace_z, azimuth = 0;
    if (o->momentum != 0)
        azimuth = o->momentum * (u + o->z * integral_pole(at, at.c2 + o->axis_gap * at.s * at.s)) / b->pace_z;
    return (struct kd_orbit_sums) { .proper = u2, .t = o->energy * u2, .phi = azimuth };
}

static struct kd_orbit_sums combine(double n, struct kd_orbit_sums half, double sign, struct kd_orbit_sums rest)
{
    return (struct kd_orbit_sums) { n * half.proper + sign * rest.proper, n * half.t + sign * rest.t,
                                    n * half.phi + sign * rest.phi };
}

/* A phase reduced to a quarter period. halves: number of phases of 2K that were removed. */
struct reduced {
    double halves, sign, rest;
    struct phase at;
};

static struct reduced reduce(double u, double quarter, double k, double k1)
{
    struct reduced r = { .halves = nearbyint(u / (2 * quarter)) };
    double rest = u - 2 * quarter * r.halves;
    r.sign = rest < 0 ? -1 : 1;
    r.rest = fmin(fabs(rest), quarter);
    struct kd_jacobi j = kd_jacobi(r.rest, k, k1);
    r.at = (struct phase) { j.sn, j.cn * j.cn, j.dn * j.dn };
    return r;
}

static struct kd_orbit_sums radial_until(const struct kd_orbit_bound *b, double u, struct reduced *r)
{
    if (b->orbit.circular) {
        *r = (struct reduced) { 0, 1, u, { 0, 1, 1 } };
        return radial_sums(b, u, r->at);
    }
    *r = reduce(u, b->quarter_r, b->k_r, b->k1_r);
    return combine(2 * r->halves, b->half_r, r->sign, radial_sums(b, r->rest, r->at));
}

static struct kd_orbit_sums polar_until(const struct kd_orbit_bound *b, double u, struct reduced *r)
{
    *r = reduce(u, b->quarter_z, b->k_z, b->k1_z);
    struct kd_orbit_sums sum = combine(2 * r->halves, b->half_z, r->sign, polar_sums(b, r->rest, r->at));
    if (through_axis(&b->orbit))
        sum.phi = M_PI * r->halves;
    return sum;
}

static void set_radial(struct kd_orbit_bound *b)
{
    const struct kd_orbit *o = &b->orbit;
    double g[3], *r = b->r;
    kd_orbit_factor(o, g); /* the other two roots are those of g0 r^2 + g1 r + g2 */
    r[0] = 1 / o->w_low, r[1] = 1 / o->w_high;
    r[2] = (sqrt(fmax(g[1] * g[1] - 4 * g[0] * g[2], 0)) - g[1]) / (2 * g[0]);
    r[3] = g[2] / (g[0] * r[2]);
    r[2] = fmin(r[2], r[1]);
    double wide = r[0] - r[2], deep = r[1] - r[3];
    b->h = o->circular ? 0 : (r[0] - r[1]) / wide;
    b->k_r = b->h * (r[2] - r[3]) / deep;
    b->k1_r = o->circular ? 1 : (r[0] - r[3]) * (r[1] - r[2]) / (wide * deep);
    b->pace_r = 0.5 * sqrt(o->binding * wide * deep);
    b->beyond[0] = kd_hole_past(&o->hole, r[1], o->hole.outer);
    b->beyond[1] = kd_hole_past(&o->hole, r[1], o->hole.inner);
    b->h_plus = b->h * (r[2] - o->hole.outer) / b->beyond[0];
    b->h_minus = b->h * (r[2] - o->hole.inner) / b->beyond[1];
    b->unit_r = o->circular ? 1 : b->pace_r;
    b->quarter_r = o->circular ? 1 : kd_carlson_rf(0, b->k1_r, 1);
    b->half_r =
        radial_sums(b, b->quarter_r, o->circular ? (struct phase) { 0, 1, 1 } : (struct phase) { 1, 0, b->k1_r });
}

static void set_polar(struct kd_orbit_bound *b)
{
    const struct kd_orbit *o = &b->orbit;
    b->pace_z = sqrt(o->n);
    b->k_z = o->n > 0 ? o->hole.a * o->hole.a * o->binding * o->z / o->n : 0;
    b->k1_z = 1 - b->k_z;
    b->quarter_z = kd_carlson_rf(0, b->k1_z, 1);
    b->half_z = polar_sums(b, b->quarter_z, (struct phase) { 1, 0, b->k1_z });
    if (through_axis(o))
        b->half_z.phi = 0.5 * M_PI;
}

/* Radial phase since periastron, between -K and K. */
static double radial_phase(const struct kd_orbit_bound *b, const struct kd_orbit_state *start)
{
    const double *r = b->r;
    double at = 1 / start->w;
    if (b->orbit.circular || at <= r[1])
        return 0;
    if (at >= r[0])
        return b->quarter_r;
    double s2 = (r[0] - r[2]) * (at - r[1]) / ((r[0] - r[1]) * (at - r[2]));
    double c2 = (r[1] - r[2]) * (r[0] - at) / ((r[0] - r[1]) * (at - r[2]));
    double u = sqrt(s2) * kd_carlson_rf(c2, c2 + b->k1_r * s2, 1);
    return start->w_rate > 0 ? -u : u;
}

static double polar_phase(const struct kd_orbit_bound *b, const struct kd_orbit_state *start)
{
    double z = b->orbit.z;
    if (!(z > 0))
        return 0;
    double s2 = fmin(start->u * start->u / z, 1);
    double phase = copysign(sqrt(s2) * kd_carlson_rf(1 - s2, 1 - b->k_z * s2, 1), start->u);
    return start->u_rate < 0 ? 2 * b->quarter_z - phase : phase;
}

struct kd_orbit_bound kd_orbit_bound_of(const struct kd_orbit *orbit, const struct kd_orbit_state *start)
{
    struct kd_orbit_bound b = { .orbit = *orbit };
    struct reduced r;
    set_radial(&b);
    set_polar(&b);
    b.phase_r = radial_phase(&b, start);
    b.phase_z = polar_phase(&b, start);
    b.start_r = radial_until(&b, b.phase_r, &r);
    b.start_z = polar_until(&b, b.phase_z, &r);
    return b;
}

struct kd_orbit_place kd_orbit_bound_at(const struct kd_orbit_bound *b, double mino)
{
    struct reduced radial, polar;
    struct kd_orbit_sums r = radial_until(b, b->phase_r + b->unit_r * mino, &radial);
    struct kd_orbit_sums z = polar_until(b, b->phase_z + b->pace_z * mino, &polar);
    double s2 = radial.at.s * radial.at.s, odd = fmod(polar.halves, 2) != 0 ? -1 : 1;
    double c2 = radial.at.c2, rest = b->orbit.circular ? 1 : c2 + (b->r[1] - b->r[2]) / (b->r[0] - b->r[2]) * s2;
    return (struct kd_orbit_place) {
        .mino = mino,
        .proper = r.proper - b->start_r.proper + z.proper - b->start_z.proper,
        .t = r.t - b->start_r.t + z.t - b->start_z.t,
        .r = b->r[1] + (b->r[1] - b->r[2]) * b->h * s2 / rest,
        .theta = acos(odd * polar.sign * sqrt(b->orbit.z) * polar.at.s),
        .phi = r.phi - b->start_r.phi + z.phi - b->start_z.phi,
    };
}

struct kd_orbit_frequencies kd_orbit_frequencies_of(const struct kd_orbit_bound *b)
{
    double half_r = b->quarter_r / b->unit_r, quarter_z = b->quarter_z / b->pace_z;
    struct kd_orbit_frequencies f = {
        .mino_r = b->orbit.circular ? 2 * b->pace_r : M_PI / half_r,
        .mino_theta = 0.5 * M_PI / quarter_z,
        .mino_phi = b->half_r.phi / half_r + b->half_z.phi / quarter_z,
        .mino_t = b->half_r.t / half_r + b->half_z.t / quarter_z,
        .mino_proper = b->half_r.proper / half_r + b->half_z.proper / quarter_z,
    };
    f.r = f.mino_r / f.mino_t;
    f.theta = f.mino_theta / f.mino_t;
    f.phi = f.mino_phi / f.mino_t;
    return f;
}

/* 2 K(k)/pi - 1 by the arithmetic-geometric mean. Each number of the mean is stored as its difference from 1. */
static double complete_excess(double k)
{
    double x = 0, y = k / (1 + sqrt(1 - k));
    for (int i = 0; i < 8; i++) { /* eight steps suffice for k = 1 - 1e-16, because convergence is quadratic */
        double both = x + y - x * y;
        x = 0.5 * (x + y);
        y = both / (1 + sqrt(1 - both));
    }
    return x / (1 - x);
}

/* Advance of the periastron about a hole without spin: 4 K(k)/sqrt(1 - less) - 2 pi, with 1 - less = b (r1 - r3)(r2 -
 * r4)/l^2. Without charge r4 = 0, less = (6 - 2e)/p and k = 4e/(p - 6 + 2e) (C. Darwin 1961, Proc. R. Soc. A 263, 39).
 * With charge less follows from the coefficient of w^2 in W, without cancellation: W = (w - w_low)(w_high - w)(g0 + g1
 * w + g2 w^2), whose last factor, times r^2, is g0 (r - r3)(r - r4). */
static double advance_in_a_plane(const struct kd_orbit_bound *b)
{
    const struct kd_orbit *o = &b->orbit;
    double less = 2 * o->w_high + 4 * o->w_low, apart = 2;
    double g[3];
    kd_orbit_factor(o, g);
    if (g[2] != 0) { /* the case r4 > 0 */
        double third = g[0] * b->r[2], fourth = g[0] * b->r[3];
        less = (third * (2 * o->w_low + o->w_high) + fourth * (o->w_low + 2 * o->w_high) +
                kd_hole_own_quadratic(&o->hole)) /
               o->total;
        apart = (third - fourth) / o->total;
    }
    double pace = expm1(-0.5 * log1p(-less)), excess = complete_excess(apart * (o->w_high - o->w_low) / (1 - less));
    return 2 * M_PI * (pace + excess + pace * excess);
}

double kd_orbit_periastron_advance(const struct kd_orbit_bound *b)
{
    if (b->orbit.hole.a == 0)
        return advance_in_a_plane(b);
    struct kd_orbit_frequencies f = kd_orbit_frequencies_of(b);
    return 2 * M_PI * (fabs(f.mino_phi) / f.mino_r - 1);
}

double kd_orbit_nodal_advance(const struct kd_orbit_bound *b)
{
    if (b->orbit.hole.a == 0) /* no precession, because the orbital plane is fixed */
        return 0;
    struct kd_orbit_frequencies f = kd_orbit_frequencies_of(b);
    return 2 * M_PI * (fabs(f.mino_phi) / f.mino_theta - 1);
}
