#include "physics/null/null_polar.h"

#include "physics/math/carlson.h"
#include "physics/math/elliptic.h"

#include <math.h>

/* A point of the motion: sin^2 x, cos^2 x and 1 - kappa sin^2 x, each without cancellation. */
struct phase { double s2, c2, d2; };

/* Integrals from the turning point, where u^2 = z, to the point `at`. The azimuth's elementary part with the poles is
 * left out. */
static struct kd_null_polar_sum from_turn(const struct kd_null_polar *p, struct phase at)
{
    struct kd_null_polar_sum sum = { 0 };
    double sine = sqrt(at.s2), root = sqrt(p->s);
    if (sine == 0)
        return sum;
    double f = kd_carlson_rf(at.c2, at.d2, 1);
    sum.tau = sine * f / root;
    if (p->parts == KD_NULL_TAU)
        return sum;
    sum.u2 = p->z * sine * (f - at.s2 * kd_carlson_rd(at.c2, at.d2, 1) / 3) / root;
    if (p->nu > 0) { /* integral of sin^2 x / (1 - nu cos^2 x) */
        double rest = 1 - p->nu;
        double j = kd_carlson_rj(at.c2, at.d2, 1, 1 + p->nu / rest * at.s2);
        sum.phi = p->a * p->a * p->cc * sine * at.s2 * j / (3 * rest * root);
    }
    return sum;
}

/* Mino time from the plane to |u|, for an observer almost in the plane. */
static double from_plane(const struct kd_null_polar *p, double eta, double gap, double weight)
{
    return p->u * kd_carlson_rf(p->z * weight, p->n * gap, eta);
}

/* Computes gap and weight. Their product, (s beta)^2, and their difference are known. */
void kd_null_polar_gap(const struct kd_null_motion *m, double *disc, double *gap, double *weight)
{
    double a2 = m->hole.a * m->hole.a, s2 = m->s * m->s;
    double d = a2 * s2 - m->alpha * m->alpha - m->beta * m->beta; /* the difference a^2 gap - weight */
    double speed2 = s2 * m->beta * m->beta;
    *disc = hypot(d, 2 * m->hole.a * m->s * m->beta);
    *weight = d > 0 ? 2 * a2 * speed2 / (*disc + d) : 0.5 * (*disc - d);
    *gap = d < 0 ? 2 * speed2 / (*disc - d) : a2 > 0 ? 0.5 * (*disc + d) / a2 : 0;
}

static void set_start(struct kd_null_polar *p, const struct kd_null_motion *m, double gap, double weight)
{
    struct phase at = { gap / p->z, p->u * p->u / p->z, weight / p->s };
    p->start = from_turn(p, at);
    /* The angle atan2(sqrt(gap), cc u sqrt(weight)). sqrt(gap weight) = s |beta| is used, and s, which may vanish, is
     * divided out. */
    double down = fabs(m->alpha) * p->u * weight, flat = fabs(m->beta) * (p->n + p->a * p->a);
    double angle = weight > 0 ? atan2(flat, down) : 0.5 * M_PI;
    p->start.phi += angle;
    /* true if the ray moves towards the plane, by du/dtau = s beta */
    bool toward = m->beta * p->side < 0 || (m->beta == 0 && weight > 0);
    if (p->u == 0) /* a start in the plane does not count: it is the crossing before crossing 0 */
        toward = false;
    if (!toward) {
        p->start.tau = -p->start.tau, p->start.phi = -p->start.phi, p->start.u2 = -p->start.u2;
    }
    if (!p->crosses)
        return;
    p->first = toward ? from_plane(p, m->eta, gap, weight) : p->quarter.tau - p->start.tau;
    p->first_phi = p->quarter.phi - p->start.phi;
}

struct kd_null_polar kd_null_polar_of(const struct kd_null_motion *m, enum kd_null_parts parts)
{
    struct kd_null_polar p = {
        .a = m->hole.a, .u = fabs(m->c), .side = m->c < 0 || (m->c == 0 && m->beta < 0) ? -1 : 1, .parts = parts
    };
    double disc, gap, weight, a2 = m->hole.a * m->hole.a;
    kd_null_polar_gap(m, &disc, &gap, &weight);
    p.sense = m->alpha <= 0 ? 1 : -1;
    p.s = disc;
    p.z = p.u * p.u + gap;
    p.vortical = m->eta < 0;
    /* Principal null rays have s = 0. A ray in the plane has eta = 0 and u = 0, and N does not matter. */
    p.fixed = !(p.s > 0) || !(p.z > 0) || (m->eta == 0 && p.u == 0);
    if (p.fixed)
        return p;
    p.n = m->eta / p.z;
    p.kappa = a2 * p.z / p.s;
    p.crosses = m->eta > 0;
    p.cc = fabs(m->lambda) / (weight + a2 * m->s * m->s); /* cc, from N + a^2 without cancellation */
    if (m->s == 0)
        p.cc = 0;
    p.nu = a2 * p.cc * p.cc;
    struct phase quarter = { 1, 0, p.n / p.s };
    if (p.vortical)
        quarter = (struct phase) { p.s / (a2 * p.z), -p.n / (a2 * p.z), 0 };
    if (m->eta != 0)
        p.quarter = from_turn(&p, quarter);
    else
        /* the ray takes infinite time to reach the plane */
        p.quarter = (struct kd_null_polar_sum) { INFINITY, 0, 0 };
    p.quarter.phi += 0.5 * M_PI;
    set_start(&p, m, gap, weight);
    return p;
}

/* R_F(0, y, 1) by the arithmetic-geometric mean (DLMF 19.22.1), which takes a third as many square roots as
 * duplication. */
static double quarter_of(double y)
{
    double a = 1, b = sqrt(y);
    /* at this difference, the next mean is accurate to 1e-17 */
    for (int i = 0; i < 64 && fabs(a - b) > 1e-8 * a; i++) {
        double mean = 0.5 * (a + b);
        b = sqrt(a * b), a = mean;
    }
    return 0.5 * M_PI / (0.5 * (a + b));
}

double kd_null_polar_first(const struct kd_null_motion *m)
{
    double disc, gap, weight, u = fabs(m->c), side = m->c < 0 || (m->c == 0 && m->beta < 0) ? -1 : 1;
    if (!(m->eta > 0))
        return INFINITY;
    kd_null_polar_gap(m, &disc, &gap, &weight);
    double z = u * u + gap, n = m->eta / z;
    /* true if the ray moves towards the plane, as in set_start */
    bool toward = u > 0 && (m->beta * side < 0 || (m->beta == 0 && weight > 0));
    if (toward)
        return u * kd_carlson_rf(z * weight, n * gap, m->eta);
    double start = gap > 0 ? sqrt(gap / z) * kd_carlson_rf(u * u / z, weight / disc, 1) : 0;
    return (quarter_of(n / disc) + start) / sqrt(disc);
}

double kd_null_polar_half(const struct kd_null_motion *m)
{
    double disc, gap, weight;
    kd_null_polar_gap(m, &disc, &gap, &weight);
    return 2 * quarter_of(m->eta / ((m->c * m->c + gap) * disc)) / sqrt(disc);
}

struct kd_null_polar_sum kd_null_polar_crossing(const struct kd_null_polar *p, int n)
{
    return (struct kd_null_polar_sum) {
        .tau = p->first + 2 * n * p->quarter.tau,
        .phi = p->sense * (p->first_phi + 2 * n * p->quarter.phi),
        .u2 = (2 * n + 1) * p->quarter.u2 - p->start.u2,
    };
}

struct kd_null_polar_place kd_null_polar_at(const struct kd_null_polar *p, const struct kd_null_motion *m, double tau)
{
    if (p->fixed)
        return (struct kd_null_polar_place) { m->c, m->s > 0 ? m->lambda / (m->s * m->s) * tau : 0 };
    double a2 = p->a * p->a, total = p->start.tau + tau, swings = nearbyint(total / (2 * p->quarter.tau));
    double rest = swings == 0 ? total : total - 2 * swings * p->quarter.tau;
    struct phase at;
    double cosine, weight;
    if (p->vortical) { /* for a vortical ray u = sqrt(z) dn, because the ray stays on one side of the plane */
        double least = -p->n / a2, range = p->s / (a2 * p->z);
        struct kd_jacobi j = kd_jacobi(sqrt(a2 * p->z) * rest, range, least / p->z);
        at = (struct phase) { range * j.sn * j.sn, j.dn * j.dn, j.cn * j.cn };
        cosine = j.dn;
        weight = p->s * j.cn * j.cn;
    } else {
        struct kd_jacobi j = kd_jacobi(sqrt(p->s) * rest, p->kappa, p->n / p->s);
        at = (struct phase) { j.sn * j.sn, j.cn * j.cn, j.dn * j.dn };
        cosine = j.cn;
        weight = p->s * at.d2;
    }
    double here = from_turn(p, at).phi + atan2(sqrt(p->z * at.s2), p->cc * sqrt(p->z) * fmax(cosine, 0) * sqrt(weight));
    double phi = 2 * swings * p->quarter.phi + copysign(here, rest) - p->start.phi;
    double sign = p->vortical || fmod(swings, 2) == 0 ? p->side : -p->side;
    return (struct kd_null_polar_place) { sign * sqrt(p->z) * cosine, p->sense * phi };
}
