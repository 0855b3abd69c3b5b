#include "physics/null/null_radial.h"

#include "physics/math/carlson.h"
#include "physics/math/elliptic.h"
#include "physics/math/quadrature.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* Arguments of Int (r - r1)/(r - r5) dr/sqrt(R) for a pole r5, which is (2/3) (d12 d13 d14/d15) R_J(..., u2) + 2
 * R_C(s^2, q2) by DLMF 19.29.8. */
struct pole { double u2, s, q2; };

/* The arguments of DLMF 19.29 for the path from r to the reference. */
struct span {
    struct kd_carlson_arg arg; /* U12, U13 + U14 and U13 U14 */
    struct pole plus, minus;   /* arguments of the pole integrals for r+ and for r- */
    struct pole slope;         /* for close horizons: differences of both poles' arguments, over r+ - r- */
    double far;                /* U25^2 with the pole r5 at infinity */
    double log;                /* elementary part of the integral of (r - r2) dr/sqrt(R) */
    double ratio;              /* X1 Y1/(X2 Y2 U12)                                                      */
    double edge;               /* difference of sqrt(R)/(r - r2) between the ends of the path */
};

enum kd_null_region kd_null_region_of(const struct kd_null_roots *roots, double radius)
{
    if (roots->kind != KD_NULL_FOUR_REAL || radius >= roots->r4)
        return KD_NULL_OUTER;
    if (radius <= roots->r3)
        return KD_NULL_INNER;
    /* Rounding may move a start at a turning point slightly off it. */
    if (radius >= roots->r4 * (1 - 1e-15))
        return KD_NULL_OUTER;
    return radius <= roots->r3 * (1 + 1e-15) ? KD_NULL_INNER : KD_NULL_FORBIDDEN;
}

struct kd_null_radius kd_null_radius_of(const struct kd_null_radial *q, double r)
{
    const struct kd_null_roots *o = &q->roots;
    struct kd_null_radius at = { .r = r, .d1 = r - o->r1, .d2 = r - o->r2 };
    if (o->kind == KD_NULL_FOUR_REAL) {
        at.d3 = q->inner ? fmax(o->r3 - r, 0) : fmin(o->r3 - r, 0);
        at.d4 = q->inner ? fmax(o->r4 - r, 0) : fmin(o->r4 - r, 0);
        at.both = sqrt(fabs(at.d3)) + sqrt(fabs(at.d4));
        at.pair = sqrt(at.d3 * at.d4);
        return at;
    }
    double x = r - o->mean, y2 = -o->pair;
    at.pair = sqrt(x * x + y2);
    at.both = sqrt(2 * (x > 0 ? at.pair + x : y2 / (at.pair - x)));
    return at;
}

static struct pole pole_outer(const struct kd_null_radial *q, const struct kd_null_radius *at, double r5)
{
    const struct kd_null_roots *o = &q->roots;
    double y1 = sqrt(at->d1), y2 = sqrt(at->d2), e = r5 - o->r1, d5 = kd_hole_past(&q->motion.hole, at->r, r5);
    struct pole p;
    p.u2 = 2 * at->d1 * (at->r + o->r1) + 2 * y1 * y2 * at->pair + o->p1 * o->r21 / e;
    p.s = d5 + y2 * at->pair / y1;
    p.q2 = d5 * p.u2 / at->d1;
    return p;
}

static double slope_u2(const struct kd_null_radial *q)
{
    const struct kd_null_roots *o = &q->roots;
    return -o->p1 * o->r21 / ((q->r_plus - o->r1) * (q->r_minus - o->r1));
}

static struct kd_carlson_arg arg_outer(const struct kd_null_radius *at)
{
    double y1 = sqrt(at->d1), y2 = sqrt(at->d2), p = at->pair;
    return (struct kd_carlson_arg) { y1 * y2 + p, (y1 + y2) * at->both,
                                     p * (at->d1 + at->d2) + y1 * y2 * (at->both * at->both - 2 * p) };
}

static struct span span_outer(const struct kd_null_radial *q, const struct kd_null_radius *at)
{
    const struct kd_null_roots *o = &q->roots;
    double y1 = sqrt(at->d1), y2 = sqrt(at->d2), p = at->pair;
    struct span s = { .arg = arg_outer(at) };
    s.plus = pole_outer(q, at, q->r_plus);
    s.minus = pole_outer(q, at, q->r_minus);
    if (kd_hole_is_close(&q->motion.hole)) {
        s.slope.u2 = slope_u2(q);
        s.slope.s = -1;
        s.slope.q2 = ((at->r - q->r_minus) * s.slope.u2 - s.plus.u2) / at->d1;
    }
    s.far = 2 * y2 * (y2 * (at->r + o->r2) + y1 * p);
    s.log = log(4 * at->d2 / s.far);
    s.ratio = y1 / (y2 * s.arg.first);
    s.edge = o->r2 - y1 * p / y2;
    return s;
}

static struct pole pole_inner(const struct kd_null_radial *q, const struct kd_null_radius *at, double r5)
{
    const struct kd_null_roots *o = &q->roots;
    double e = r5 - o->r1, x1 = o->r3 - o->r1, x2 = o->r3 - o->r2, x5 = kd_hole_past(&q->motion.hole, o->r3, r5),
           steep = at->d4 / at->d3;
    struct pole p;
    p.u2 = x1 * (x2 * steep - (o->r4 - o->r1) * (r5 - o->r2) / e);
    p.s = sqrt(at->d2 / at->d1 * steep) * x5;
    p.q2 = x5 * kd_hole_past(&q->motion.hole, at->r, r5) * p.u2 / (x1 * at->d1);
    return p;
}

static struct kd_carlson_arg arg_inner(const struct kd_null_roots *o, const struct kd_null_radius *at)
{
    double x1 = o->r3 - o->r1, x2 = o->r3 - o->r2, r43 = 2 * sqrt(o->pair);
    return (struct kd_carlson_arg) { sqrt(x1 * x2 * (at->d4 / at->d3)),
                                     (sqrt(x1 * at->d2) + sqrt(x2 * at->d1)) * sqrt(r43 / at->d3),
                                     sqrt(x1 * x2 * at->d1 * at->d2) * r43 / at->d3 };
}

static struct span span_inner(const struct kd_null_radial *q, const struct kd_null_radius *at)
{
    const struct kd_null_roots *o = &q->roots;
    double x1 = o->r3 - o->r1, x2 = o->r3 - o->r2, r42 = o->r4 - o->r2, steep = at->d4 / at->d3;
    struct span s = { .arg = arg_inner(o, at) };
    s.plus = pole_inner(q, at, q->r_plus);
    s.minus = pole_inner(q, at, q->r_minus);
    if (kd_hole_is_close(&q->motion.hole)) {
        s.slope.u2 = slope_u2(q);
        s.slope.s = -sqrt(at->d2 / at->d1 * steep);
        s.slope.q2 = ((o->r3 - q->r_minus) * ((at->r - q->r_minus) * s.slope.u2 - s.plus.u2) -
                      kd_hole_past(&q->motion.hole, at->r, q->r_plus) * s.plus.u2) /
                     (x1 * at->d1);
    }
    s.far = x2 * (x1 * steep - r42);
    s.log = 2 * kd_carlson_rc(at->d1 / at->d2 * steep, s.far / (x2 * at->d2));
    s.ratio = sqrt(x1 * at->d1 / (x2 * at->d2)) / s.arg.first;
    s.edge = -sqrt(at->d1 / at->d2) * at->pair;
    return s;
}

/* Int dr/((r - r5) sqrt(R)), from the integral of (r - r1)/(r - r5) dr/sqrt(R). */
static double at_pole(const struct kd_null_roots *o, const struct span *s, const struct pole *p, double r5, double tau)
{
    double e = r5 - o->r1;
    double j = kd_carlson_rj_arg(s->arg, p->u2), c = kd_carlson_rc(p->s * p->s, p->q2);
    return ((2.0 / 3) * o->r21 * o->p1 / e * j + 2 * c - tau) / e;
}

/* Int dr/(Delta sqrt(R)). minus: the integral at_pole for r-. The result is the divided difference (at_pole(r+) -
 * at_pole(r-))/(r+ - r-). The divided difference D of a product is D(f g) = f(r+) D(g) + g(r-) D(f). */
static double between_poles(const struct kd_null_radial *q, const struct span *s, double minus)
{
    const struct kd_null_roots *o = &q->roots;
    const struct pole *p = &s->plus, *m = &s->minus, *slope = &s->slope;
    double e_plus = q->r_plus - o->r1, e_minus = q->r_minus - o->r1;
    double j = kd_carlson_rj_slope(s->arg, p->u2, m->u2) * slope->u2 - kd_carlson_rj_arg(s->arg, m->u2) / e_minus;
    double y_plus = p->q2 / (p->s * p->s), y_minus = m->q2 / (m->s * m->s),
           y = (slope->q2 - y_minus * slope->s * (p->s + m->s)) / (p->s * p->s);
    double c = (kd_carlson_rc_slope(y_plus, y_minus) * y - kd_carlson_rc(1, y_minus) * slope->s / m->s) / p->s;
    return ((2.0 / 3) * o->r21 * o->p1 / e_plus * j + 2 * c - minus) / e_plus;
}

/* Int (r^2 + 2r + 4 - q^2) dr/sqrt(R). The integral of r^2 follows from d(sqrt(R)/(r - r2)) = (r^2 - r2^2 - r21 p2/(2(r
 * - r2))) dr/sqrt(R). */
static double powers(const struct kd_null_roots *o, const struct span *s, double four, double tau)
{
    double first = (2.0 / 3) * o->r21 * o->p2 * kd_carlson_rj_arg(s->arg, s->far) + s->log + o->r2 * tau;
    double second = (2.0 / 3) * o->p1 * kd_carlson_rd_arg(s->arg) + 2 * s->ratio - tau;
    return s->edge + o->r2 * o->r2 * tau + 0.5 * o->p2 * second + 2 * first + four * tau;
}

/* Numerators of the terms of phi' and t' that have the divisor Delta: a (2r + twist) in phi', and slope r + rest in t'.
 */
struct numerators { double four, twist, slope, rest; };

static struct numerators numerators_of(const struct kd_null_motion *m)
{
    const struct kd_hole_rates n = kd_hole_rates_of(&m->hole, 1, m->lambda);
    return (struct numerators) { n.four, -n.drag, n.near, -n.nearer - 4 * m->hole.a * m->hole.a };
}

struct kd_null_radial_sum kd_null_radial_rates(const struct kd_null_motion *m, double r)
{
    const struct numerators n = numerators_of(m);
    double delta = kd_hole_delta(&m->hole, r);
    return (struct kd_null_radial_sum) { 1, m->hole.a * (2 * r + n.twist) / delta,
                                         r * r + 2 * r + n.four + (n.slope * r + n.rest) / delta };
}

static double tau_from(const struct kd_null_radial *q, const struct kd_null_radius *at)
{
    return 2 * kd_carlson_rf_arg(q->inner ? arg_inner(&q->roots, at) : arg_outer(at));
}

struct kd_null_radial_sum kd_null_radial_integrals(const struct kd_null_radial *q, const struct kd_null_radius *at)
{
    const struct kd_null_roots *o = &q->roots;
    struct kd_null_radial_sum sum = { 0 };
    bool time = q->parts == KD_NULL_TAU_PHI_T;
    if (isinf(at->r) || (q->inner && at->d3 == 0))
        return sum;
    sum.tau = tau_from(q, at);
    if (q->parts == KD_NULL_TAU)
        return sum;
    struct span s = q->inner ? span_inner(q, at) : span_outer(q, at);
    const struct numerators n = numerators_of(&q->motion);
    double a = q->motion.hole.a, gap = q->r_plus - q->r_minus;
    double plus = at_pole(o, &s, &s.plus, q->r_plus, sum.tau), minus = at_pole(o, &s, &s.minus, q->r_minus, sum.tau);
    /* splits each numerator into a multiple of r - 1, which is the mean of both poles, and a remainder */
    if (kd_hole_is_close(&q->motion.hole)) {
        double both = between_poles(q, &s, minus), mean = 0.5 * (plus + minus);
        sum.phi = a * (2 * mean + (2 + n.twist) * both);
        if (time)
            sum.t = powers(o, &s, n.four, sum.tau) + n.slope * mean + (n.slope + n.rest) * both;
        return sum;
    }
    sum.phi = a * ((2 * q->r_plus + n.twist) * plus - (2 * q->r_minus + n.twist) * minus) / gap;
    if (time)
        sum.t = powers(o, &s, n.four, sum.tau) +
                ((n.slope * q->r_plus + n.rest) * plus - (n.slope * q->r_minus + n.rest) * minus) / gap;
    return sum;
}

/* Jacobi's functions for four real roots: sn^2 = r31 (r - r4)/(r41 (r - r3)) or, for INNER motion, r42 (r3 - r)/(r32
 * (r4 - r)). */
static void jacobi_four(struct kd_null_radial *q)
{
    const struct kd_null_roots *o = &q->roots;
    double r31 = o->r3 - o->r1, r32 = o->r3 - o->r2, r41 = o->r4 - o->r1, r42 = o->r4 - o->r2;
    double r43 = 2 * sqrt(o->pair);
    q->rate = 0.5 * sqrt(r31 * r42);
    q->k = r32 * r41 / (r31 * r42);
    q->k1 = r43 * o->r21 / (r31 * r42);
    q->s0 = sqrt(r31 / r41);
    q->c0 = sqrt(r43 / r41);
    q->d0 = sqrt(r43 / r42);
}

/* Jacobi's functions for two real roots: cn = (A (r - r1) - B (r - r2))/(A (r - r1) + B (r - r2)) with A = |r3 - r2|
 * and B = |r3 - r1|. At infinity cn is (A - B)/(A + B). */
static void jacobi_two(struct kd_null_radial *q)
{
    const struct kd_null_roots *o = &q->roots;
    double big_a = sqrt(o->p2), big_b = sqrt(o->p1), ab = big_a * big_b;
    double inner = (o->mean - o->r1) * (o->mean - o->r2) - o->pair; /* real part of (r3 - r1)(r4 - r2) */
    double gap = -o->pair * o->r21 * o->r21;                        /* (A B)^2 - inner^2 */
    q->rate = sqrt(ab);
    q->k1 = inner > 0 ? gap / (2 * ab * (ab + inner)) : 0.5 * (1 - inner / ab);
    q->k = inner > 0 ? 0.5 * (1 + inner / ab) : gap / (2 * ab * (ab - inner));
    /* sum: A + B. A - B is A^2 - B^2 = (r1 - r2)(2 mean - r1 - r2) = -2 r21 (-r1 - r2), divided by this sum */
    double sum = big_a + big_b;
    q->c0 = -4 * o->r21 * o->mean / (sum * sum);
    q->s0 = 2 * sqrt(ab) / sum;
    q->d0 = sqrt(q->k1 + q->k * q->c0 * q->c0);
}

/* Computes Jacobi's functions, and determines whether the ray has a radial turning point. */
static struct kd_null_radial without_times(const struct kd_null_motion *m, const struct kd_null_roots *roots,
                                           bool inner, enum kd_null_parts parts)
{
    struct kd_null_radial q = { .motion = *m, .roots = *roots, .inner = inner, .parts = parts };
    q.r_plus = m->hole.outer;
    q.r_minus = m->hole.inner;
    if (roots->kind == KD_NULL_FOUR_REAL)
        jacobi_four(&q);
    else
        jacobi_two(&q);
    q.turns = roots->kind == KD_NULL_FOUR_REAL && (inner || roots->r4 > q.r_plus);
    return q;
}

static struct kd_null_radius at_turn(const struct kd_null_roots *roots)
{
    double r41 = roots->r4 - roots->r1, r42 = roots->r4 - roots->r2, r43 = 2 * sqrt(roots->pair);
    return (struct kd_null_radius) { roots->r4, r41, r42, 0, sqrt(r43), -r43, 0 };
}

struct kd_null_radial kd_null_radial_of(const struct kd_null_motion *m, const struct kd_null_roots *roots, bool inner,
                                        enum kd_null_parts parts)
{
    struct kd_null_radial q = without_times(m, roots, inner, parts);
    if (q.turns && !inner) {
        struct kd_null_radius at = at_turn(roots);
        q.turn = kd_null_radial_integrals(&q, &at);
        return q;
    }
    struct kd_null_radius at = kd_null_radius_of(&q, q.r_plus);
    q.tau_horizon = tau_from(&q, &at);
    return q;
}

/* The Mino time from infinity, or a smaller value that still exceeds `tau`. A lower bound of the time comes from the
 * arguments of R_F alone. Most often this bound exceeds `tau`; a value between the two is then returned, and no
 * integral is needed. The bound is R_F with three equal arguments of the same mean. R_F is never smaller than this,
 * because it is convex, and symmetric in its arguments (DLMF 19.16.1). */
static double time_from_infinity(const struct kd_null_radius *at, double tau)
{
    struct kd_carlson_arg arg = arg_outer(at);
    double least = 2 / sqrt((arg.first * arg.first + arg.sum * arg.sum - 2 * arg.root) / 3);
    return tau < least ? least : 2 * kd_carlson_rf_arg(arg);
}

static struct kd_null_radius four_outer(const struct kd_null_radial *q, double tau)
{
    const struct kd_null_roots *o = &q->roots;
    double r31 = o->r3 - o->r1, r41 = o->r4 - o->r1, r42 = o->r4 - o->r2, r43 = 2 * sqrt(o->pair);
    struct kd_jacobi j = kd_jacobi(q->rate * tau, q->k, q->k1);
    /* u = u0 - v by the addition theorems. The denominator r31 - r41 sn^2 u is r41 (sn^2 u0 - sn^2 u), which is
     * proportional to sn v. */
    double cross = q->d0 * q->d0 + q->k * q->s0 * q->s0 * j.cn * j.cn; /* 1 - k s0^2 sn^2 */
    double s = (q->s0 * j.cn * j.dn - q->c0 * q->d0 * j.sn) / cross;
    double c = (q->c0 * j.cn + q->s0 * q->d0 * j.sn * j.dn) / cross;
    double d = (q->d0 * j.dn + q->k * q->s0 * q->c0 * j.sn * j.cn) / cross;
    double den = r41 * j.sn * (q->s0 * c * d + s * q->c0 * q->d0);
    struct kd_null_radius at = { 0 };
    at.d4 = -r43 * r41 * s * s / den;
    at.d3 = -r43 * r31 / den;
    at.d2 = r31 * r42 * d * d / den;
    at.d1 = r31 * r41 * c * c / den;
    at.r = o->r4 - at.d4;
    at.pair = sqrt(at.d3 * at.d4);
    at.both = sqrt(-at.d3) + sqrt(-at.d4);
    return at;
}

static struct kd_null_radius four_inner(const struct kd_null_radial *q, double tau)
{
    const struct kd_null_roots *o = &q->roots;
    double r31 = o->r3 - o->r1, r32 = o->r3 - o->r2, r42 = o->r4 - o->r2, r43 = 2 * sqrt(o->pair);
    struct kd_jacobi j = kd_jacobi(q->rate * tau, q->k, q->k1);
    double den = r43 + r32 * j.cn * j.cn; /* r42 - r32 sn^2 */
    struct kd_null_radius at = { 0 };
    at.d3 = r43 * r32 * j.sn * j.sn / den;
    at.d4 = r43 * r42 / den;
    at.d2 = r32 * r42 * j.cn * j.cn / den;
    at.d1 = r31 * r42 * j.dn * j.dn / den;
    at.r = o->r3 - at.d3;
    at.pair = sqrt(at.d3 * at.d4);
    at.both = sqrt(at.d3) + sqrt(at.d4);
    return at;
}

static struct kd_null_radius two_real(const struct kd_null_radial *q, double tau)
{
    const struct kd_null_roots *o = &q->roots;
    double big_a = sqrt(o->p2), big_b = sqrt(o->p1);
    /* With x = x0 - 2h and m = x0 - h, cn x - cn x0 is 2 sn m dn m sn h dn h/(1 - k sn^2 m sn^2 h). */
    struct kd_jacobi h = kd_jacobi(0.5 * q->rate * tau, q->k, q->k1);
    double cross = q->d0 * q->d0 + q->k * q->s0 * q->s0 * h.cn * h.cn; /* 1 - k s0^2 sn^2 h */
    double s = (q->s0 * h.cn * h.dn - q->c0 * q->d0 * h.sn) / cross;
    double c = (q->c0 * h.cn + q->s0 * q->d0 * h.sn * h.dn) / cross;
    double d = (q->d0 * h.dn + q->k * q->s0 * q->c0 * h.sn * h.cn) / cross;
    double twist = s * d * h.sn * h.dn, second = d * d + q->k * s * s * h.cn * h.cn;
    double cn = (c * h.cn + twist) / second, den = (big_a + big_b) * 2 * twist / second;
    return kd_null_radius_of(q, o->r2 + big_a * o->r21 * (1 - cn) / den);
}

struct kd_null_radius kd_null_radius_at(const struct kd_null_radial *q, double tau)
{
    if (q->roots.kind == KD_NULL_TWO_REAL)
        return two_real(q, tau);
    if (q->inner)
        return four_inner(q, tau);
    return four_outer(q, q->turns && tau > q->turn.tau ? 2 * q->turn.tau - tau : tau);
}

double kd_null_radius_after(const struct kd_null_motion *m, const struct kd_null_roots *roots, double tau)
{
    struct kd_null_radial q = without_times(m, roots, false, KD_NULL_TAU);
    if (q.turns) {
        struct kd_null_radius at = at_turn(roots);
        q.turn.tau = time_from_infinity(&at, tau);
        if (!(tau < 2 * q.turn.tau))
            return INFINITY;
    } else {
        struct kd_null_radius at = kd_null_radius_of(&q, q.r_plus);
        if (!(tau < time_from_infinity(&at, tau)))
            return 0;
    }
    double r = kd_null_radius_at(&q, tau).r;
    return r > q.r_plus ? r : 0;
}

/* The integral of DLMF 19.29 with a complex root r1 singled out: the root of the left pair that is above the real axis.
 * The first argument of R_C has a positive real part, because r - r1 has a positive real part. */
static double complex_pole(const struct kd_null_roots *o, struct kd_carlson_arg arg, double r, double r5, double tau)
{
    double left = sqrt(-o->pair_left);
    double complex r1 = -o->mean + I * left, y1 = csqrt(r - r1), y2 = conj(y1), e = r5 - r1;
    double complex d13_d14 = (o->mean - r1) * (o->mean - r1) - o->pair;
    double p = sqrt((r - o->mean) * (r - o->mean) - o->pair);
    double complex u2 = arg.first * arg.first - d13_d14 * (r5 - conj(r1)) / e;
    double complex s = r - r5 + y2 * p / y1, q2 = (r - r5) * u2 / (r - r1);
    double complex j = kd_carlson_rj_complex(arg, u2), c = kd_carlson_rc_complex(s, q2);
    double complex all = (2.0 / 3) * (-2 * I * left) * d13_d14 / e * j + 2 * c;
    return creal((all - tau) / e);
}

/* The integral of a (2r + twist) dr/(Delta sqrt(R)) from the start to infinity, in the variable x with r - 1 = from/x.
 * x is 1 at the start and 0 at infinity. */
struct azimuth {
    const struct kd_null_roots *roots;
    double from, beyond, root, twist; /* from: r - 1 at the start. beyond: r - r+ at the start */
};

static double azimuth_at(double x, double y, const void *context)
{
    const struct azimuth *z = context;
    double out = z->from + x * (1 - z->roots->mean), out_left = z->from + x * (1 + z->roots->mean), x2 = x * x,
           potential = (out * out - z->roots->pair * x2) * (out_left * out_left - z->roots->pair_left * x2),
           delta = (z->beyond + z->root * y) * (z->from + z->root * x);
    return z->from * x * (2 * (x + z->from) + z->twist * x) / (delta * sqrt(potential));
}

struct kd_null_radial_sum kd_null_radial_complex(const struct kd_null_motion *m, const struct kd_null_roots *o,
                                                 double r)
{
    double x = r - o->mean, xl = r + o->mean, right = -o->pair, left = -o->pair_left;
    double p = sqrt(x * x + right), pl = sqrt(xl * xl + left);
    double both = 2 * (x > 0 ? p + x : right / (p - x)), both_left = 2 * (pl + xl);
    struct kd_carlson_arg arg = { p + pl, sqrt(both * both_left), 0 };
    /* U13 U14 is p (r - r1 + r - r2) + pl (r - r3 + r - r4) */
    arg.root = 2 * (p * xl + pl * x);
    const struct numerators n = numerators_of(m);
    double plus = m->hole.outer, minus = m->hole.inner;
    struct kd_null_radial_sum total = { .tau = 2 * kd_carlson_rf_arg(arg) };
    if (kd_hole_is_close(&m->hole)) { /* The integrand is smooth, because R has no root outside the horizon. */
        const struct azimuth z = { o, r - 1, kd_hole_past(&m->hole, r, plus), m->hole.root, n.twist };
        total.phi = m->hole.a * kd_quadrature(azimuth_at, &z);
        return total;
    }
    double i_plus = complex_pole(o, arg, r, plus, total.tau), i_minus = complex_pole(o, arg, r, minus, total.tau);
    total.phi = m->hole.a * ((2 * plus + n.twist) * i_plus - (2 * minus + n.twist) * i_minus) / (plus - minus);
    return total;
}
