#include "physics/null/null_quartic.h"

#include "physics/spacetime/hole.h"

#include <float.h>
#include <math.h>

struct kd_null_motion kd_null_motion_of(const struct kd_hole *hole, double cos_theta, double sin_theta, double alpha,
                                        double beta)
{
    const double a = hole->a;
    struct kd_null_motion m = { .hole = *hole, .c = cos_theta, .alpha = alpha, .beta = beta };
    m.s = sin_theta > 0 ? sin_theta : sqrt((1 - cos_theta) * (1 + cos_theta));
    m.lambda = -alpha * m.s;
    m.eta = (alpha - a) * (alpha + a) * m.c * m.c + beta * beta;
    m.quadratic = a * a * (1 + m.c * m.c) - alpha * alpha - beta * beta;
    m.k = (alpha + a * m.s) * (alpha + a * m.s) + beta * beta;
    m.constant = -kd_hole_quartic(hole, m.eta, m.k);
    return m;
}

double kd_null_radial_potential(const struct kd_null_motion *m, double r)
{
    return r * (r * (r * r + m->quadratic) + 2 * m->k) + m->constant;
}

/* A root by Newton's method, of x^3 + b x^2 + c x + d or of the quartic x^4 + c x^2 + d x + e. The iteration starts
 * from `x`, and stops when x no longer moves. From a suitable start x is monotone in exact arithmetic. A reversal
 * therefore means that x is within rounding of the root. */
static double newton(const double *k, int degree, double x)
{
    double direction = 0;
    for (int i = 0; i < 200; i++) {
        double f = 1, df = 0;
        for (int j = 0; j < degree; j++) {
            df = df * x + f;
            f = f * x + k[j];
        }
        double step = df != 0 ? -f / df : 0, next = x + step;
        if (next == x || step * direction < 0)
            return next;
        direction = step;
        x = next;
    }
    return x;
}

/* The real root r2 of (r - r2)(r - r3)(r - r4) = r^3 + k0 r^2 + k1 r + k2 with k0 < 0 < k1 and k2 <= 0. r2 is the least
 * of three real roots, or the only real root. A cubic that rises from a negative value is concave below its inflection
 * point and convex above. */
static double least_root(const double *k)
{
    double inflection = -k[0] / 3, bend = inflection * inflection - k[1] / 3;
    /* top: r of the cubic's local maximum, if there is one */
    double top = bend > 0 ? inflection - sqrt(bend) : inflection;
    double f = ((top + k[0]) * top + k[1]) * top + k[2];
    if (f >= 0)
        return newton(k, 3, 0);
    return newton(k, 3, inflection - k[0] + cbrt(-k[2])); /* starts beyond every root */
}

static void finish(struct kd_null_roots *r, double product)
{
    /* a ray with pair = 0 would wind for ever; this value makes it wind for some 25 radians */
    if (r->pair == 0)
        r->pair = -1e-22 * r->mean * r->mean;
    r->kind = r->pair >= 0 ? KD_NULL_FOUR_REAL : KD_NULL_TWO_REAL;
    /* mean >= 0 because K >= 0. So r4 is computed without cancellation, and r3 follows from the product r3 r4 */
    if (r->pair >= 0) {
        r->r4 = r->mean + sqrt(r->pair);
        r->r3 = r->r4 > 0 ? product / r->r4 : 0;
    }
    r->r21 = r->r2 - r->r1;
    r->p1 = (r->mean - r->r1) * (r->mean - r->r1) - r->pair;
    r->p2 = (r->mean - r->r2) * (r->mean - r->r2) - r->pair;
    r->margin = r->mean > 0 ? fabs(r->pair) / (r->mean * r->mean) : 1;
}

/* Computes the roots r3 and r4 from r1 and r2, by the sum of all roots, which is 0, and by division of the quartic. */
static void divide(struct kd_null_roots *r, double k)
{
    double sum = r->r1 + r->r2, product = r->r1 * r->r2 - 2 * k / sum;
    r->mean = -0.5 * sum;
    r->pair = r->mean * r->mean - product;
    finish(r, product);
}

/* Finds two conjugate pairs, the roots of (r^2 - p r + m)(r^2 + p r + g) with p = -2 mean. p^2 is the positive root of
 * the resolvent cubic. */
static void two_pairs(struct kd_null_roots *r, const struct kd_null_motion *m)
{
    double b = 2 * m->k, q = m->quadratic, c = m->constant;
    double k[3] = { 2 * q, q * q - 4 * c, -b * b };
    double p2 = newton(k, 3, fabs(k[0]) + sqrt(fabs(k[1])) + cbrt(b * b)), p = sqrt(fmax(p2, 0));
    double skew = p > 0 ? b / p : sqrt(fmax(q * q - 4 * c, 0)), g = 0.5 * (q + p2 + skew);
    r->kind = KD_NULL_NO_REAL;
    r->mean = 0.5 * p;
    r->pair = r->mean * r->mean - g; /* the roots r3 and r4, from r^2 - p r + g with p > 0 */
    r->pair_left = r->mean * r->mean - c / g;
    r->margin = 1;
}

struct kd_null_roots kd_null_roots_of(const struct kd_null_motion *m)
{
    struct kd_null_roots r = { 0 };
    double q = m->quadratic, b = 2 * m->k, c = m->constant;
    if (q == 0 && b == 0 && c == 0) { /* R = r^4 */
        r.kind = KD_NULL_TWO_REAL;
        return r;
    }
    /* The most negative root r1 is -x, where x is the largest root of x^4 + q x^2 - b x + c. This polynomial is convex
     * beyond its largest root, which is below `bound`. */
    double k[4] = { 0, q, -b, c }, bound = sqrt(fmax(-q, 0)) + cbrt(b) + sqrt(sqrt(fmax(-c, 0)));
    if (c > 0) { /* if eta < 0 and q > 0, the quartic is convex everywhere, and R has two negative roots or none */
        double x = newton(k, 4, bound), y = newton(k, 4, 0);
        double f = (x * x + q) * x * x - b * x + c, scale = x * x * x * x + q * x * x + b * x + c;
        if (!(x >= y) || !(y > 0) || fabs(f) > 64 * DBL_EPSILON * scale) {
            two_pairs(&r, m);
            return r;
        }
        r.r1 = -x, r.r2 = -y;
        divide(&r, m->k);
        return r;
    }
    r.r1 = -newton(k, 4, bound);
    double cubic[3] = { r.r1, -(b + c / r.r1) / r.r1, -c / r.r1 };
    r.r2 = cubic[2] == 0 ? 0 : least_root(cubic);
    divide(&r, m->k);
    return r;
}

struct kd_null_displacement kd_null_displacement_of(const struct kd_null_motion *m, double r, double bend,
                                                    double dalpha, double dbeta)
{
    const struct kd_hole *hole = &m->hole;
    /* p: change of alpha^2; q: change of beta^2 */
    double p = dalpha * (2 * m->alpha + dalpha), q = dbeta * (2 * m->beta + dbeta);
    double k = p + q + 2 * hole->a * m->s * dalpha;
    return (struct kd_null_displacement) {
        .r = r, .bend = bend, .quadratic = -(p + q), .k = k, .constant = -kd_hole_quartic(hole, m->c * m->c * p + q, k)
    };
}

/* About r the quartic is x^4 + 4r x^3 + c2 x^2 + c1 x + c0 with small c1 and c0. It splits into x^2 - sum x +
 * product, with both small, and x^2 + (4r + sum) x + g. Comparing coefficients gives an iteration that contracts by
 * about c0/g^2. */
struct kd_null_roots kd_null_roots_beside(const struct kd_null_motion *m, const struct kd_null_displacement *d)
{
    double r = d->r, c2 = d->bend + d->quadratic, c1 = 2 * (r * d->quadratic + d->k);
    double c0 = (d->quadratic * r + 2 * d->k) * r + d->constant, sum = 0, product = 0, g = c2;
    for (int i = 0;; i++) {
        double before = product;
        g = c2 - product + sum * (4 * r + sum);
        product = c0 / g;
        sum = (product * (4 * r + sum) - c1) / g;
        if (fabs(product - before) <= DBL_EPSILON * fabs(product))
            break;
        if (i == 100 || !isfinite(product))
            return kd_null_roots_of(m);
    }
    struct kd_null_roots o = { .mean = r + 0.5 * sum, .pair = 0.25 * sum * sum - product };
    double both = o.mean * o.mean - o.pair; /* r3 r4; r1 and r2 follow from r1 r2 both = C, r1 + r2 = -2 mean */
    o.r1 = -o.mean - sqrt(o.mean * o.mean - m->constant / both);
    o.r2 = m->constant == 0 ? 0 : m->constant / both / o.r1;
    finish(&o, both);
    return o;
}
