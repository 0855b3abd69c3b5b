#include "physics/math/carlson.h"

#include <math.h>
#include <stdbool.h>

/* Squared relative spread below which the seventh-degree series is accurate to 1e-17: the first omitted term is of
 * the eighth degree with a coefficient below 1/20, and 0.0095^8 / 20 = 3e-18. */
static const double spread2 = 9e-5;

/* Limit of the number of duplications. Each one brings the arguments four times closer; arguments 1e300 apart take some
 * 12. */
enum { STEPS = 64 };

static struct kd_carlson_arg arg_of(double x, double y, double z)
{
    double ry = sqrt(y), rz = sqrt(z);
    return (struct kd_carlson_arg) { sqrt(x), ry + rz, ry * rz };
}

/* Duplicates the arguments for the next step; returns x + lambda. */
static double duplicate(struct kd_carlson_arg *s)
{
    double g = s->first * (s->first + s->sum) + s->root, h = sqrt(g);
    s->root = 0.25 * s->sum * h;
    s->sum = 0.5 * sqrt(s->sum * (s->sum + 2 * (s->first + h)));
    s->first = 0.5 * h;
    return g;
}

/* The arguments x, y and z as x, y + z and y z, because only symmetric functions of y and z occur. */
struct plain { double x, sum, product; };

static struct plain plain_of(const struct kd_carlson_arg *s)
{
    return (struct plain) { s->first * s->first, s->sum * s->sum - 2 * s->root, s->root * s->root };
}

static bool converged(double x, double yz) { return x * x + 2 * fabs(yz) < spread2; }

double kd_carlson_rf_arg(struct kd_carlson_arg s)
{
    if (!(s.first >= 0 && s.sum > 0 && s.root >= 0))
        return NAN;
    if (s.first == 0 && s.root == 0)
        return INFINITY;
    double mean = 1, x = 0, yz = 0;
    for (int i = 0; i < STEPS; i++) {
        struct plain v = plain_of(&s);
        mean = (v.x + v.sum) / 3;
        x = 1 - v.x / mean;
        yz = 1 - v.sum / mean + v.product / (mean * mean);
        if (converged(x, yz))
            break;
        duplicate(&s);
    }
    double e2 = yz - x * x, e3 = x * yz;
    double series = 1 + e2 * (-1.0 / 10 + e2 * (1.0 / 24 - e2 * (5.0 / 208)) + e3 * (-3.0 / 44 + e2 / 16)) +
                    e3 * (1.0 / 14 + e3 * (3.0 / 104));
    return series / sqrt(mean);
}

/* R_C(1, 1 + e) for e > -1. */
static double rc_unit(double e)
{
    if (fabs(e) < 0.02) { /* near e = 0: the series, which is the sum of (-e)^k / (2k + 1) */
        double sum = 0;
        for (int k = 9; k >= 0; k--)
            sum = 1.0 / (2 * k + 1) - e * sum;
        return sum;
    }
    double root = sqrt(fabs(e));
    return e > 0 ? atan(root) / root : atanh(root) / root;
}

double kd_carlson_rc(double x, double y)
{
    if (!(x >= 0) || isnan(y))
        return NAN;
    if (y == 0)
        return INFINITY;
    if (y < 0)
        return sqrt(x / (x - y)) * kd_carlson_rc(x - y, -y);
    double e = (y - x) / x;
    if (fabs(e) < 0.5)
        return rc_unit(e) / sqrt(x);
    double root = sqrt(fabs(y - x));
    return y > x ? atan2(root, sqrt(x)) / root : log((sqrt(x) + root) / sqrt(y)) / root;
}

/* The series of R_J and R_D in the elementary symmetric functions (DLMF 19.36.2). */
static double series_j(double e2, double e3, double e4, double e5)
{
    return 1 + e2 * (-3.0 / 14 + e2 * (9.0 / 88 - e2 / 16) + e3 * (-9.0 / 52 + e2 * (45.0 / 272)) + e4 * (3.0 / 20)) +
           e3 * (1.0 / 6 + e3 * (3.0 / 40)) - e4 * (3.0 / 22) + e5 * (3.0 / 26) - (9.0 / 68) * (e3 * e4 + e2 * e5);
}

double kd_carlson_rj_arg(struct kd_carlson_arg s, double p)
{
    if (!(s.first >= 0 && s.sum > 0 && s.root >= 0 && p >= 0))
        return NAN;
    if (p == 0 || (s.first == 0 && s.root == 0))
        return INFINITY;
    struct plain v = plain_of(&s);
    double delta = (p - v.x) * (p * (p - v.sum) + v.product), scale = 1, sum = 0, mean = 1, x = 0, yz = 0, y_z = 0;
    for (int i = 0; i < STEPS; i++) {
        mean = 0.2 * (v.x + v.sum + 2 * p);
        x = 1 - v.x / mean;
        y_z = 2 - v.sum / mean;
        yz = 1 - v.sum / mean + v.product / (mean * mean);
        if (converged(x, yz) && y_z * y_z < spread2)
            break;
        double rp = sqrt(p), d = (rp + s.first) * (p + rp * s.sum + s.root);
        /* fmax is needed because rounding must not make this product of positive terms negative */
        sum += scale / d * rc_unit(fmax(delta / (d * d), -1 + 1e-16));
        p = 0.25 * (p + s.first * s.sum + s.root);
        duplicate(&s);
        v = plain_of(&s);
        delta /= 64;
        scale *= 0.25;
    }
    double q = -0.5 * (x + y_z), q2 = q * q, xyz = x * yz;
    double e2 = x * y_z + yz - 3 * q2, e3 = xyz + 2 * q * (e2 + 2 * q2);
    double e4 = (2 * xyz + q * (e2 + 3 * q2)) * q, e5 = xyz * q2;
    return scale * series_j(e2, e3, e4, e5) / (mean * sqrt(mean)) + 6 * sum;
}

/* atanh(x)/x, from x and rest = 1 - x^2. */
static double atanh_over(double x, double rest)
{
    double size = fabs(x);
    return size == 0 ? 1 : size < 0.5 ? atanh(x) / x : log((1 + size) / sqrt(rest)) / size;
}

/* With s = sqrt(|p - 1|) and t = sqrt(|q - 1|), R_C(1, p) is atan(s)/s for p > 1 and artanh(s)/s for p < 1, and R_C(1,
 * q) likewise with t. The difference of the two arcs is the arc (atan or artanh) of x = (s - t)/(1 +- s t). */
double kd_carlson_rc_slope(double p, double q)
{
    enum { TERMS = 24 }; /* the first omitted term is 0.25^24/49 = 7e-17 */
    if (!(p > 0 && q > 0))
        return NAN;
    double a = p - 1, b = q - 1, s = sqrt(fabs(a)), t = sqrt(fabs(b)), st = s * t;
    if (fabs(a) < 0.25 && fabs(b) < 0.25) {
        /* sum: the series in a; slope: its divided difference. The divided difference of a f is f(a) + b f' */
        double sum = 0, slope = 0;
        for (int k = TERMS; k >= 0; k--) {
            slope = sum + b * slope;
            sum = (k % 2 ? -1.0 : 1.0) / (2 * k + 1) + a * sum;
        }
        return slope;
    }
    if (a > 0 && b > 0) {
        double x = (s - t) / (1 + st);
        return ((x == 0 ? 1 : atan(x) / x) / ((1 + st) * s) - atan(t) / st) / (s + t);
    }
    if (a < 0 && b < 0) {
        double less = (p + q - p * q) / (1 + st) /* 1 - s t */, x = (q - p) / ((s + t) * less);
        double arc = atanh_over(x, p * q / (less * less)), at_q = atanh_over(t, q);
        return (at_q / s - arc / (less * s)) / (s + t);
    }
    return (kd_carlson_rc(1, p) - kd_carlson_rc(1, q)) / (p - q);
}

/* R_{-5/2}(1/2, 1/2, 1/2, 1, 1; x, y, z, p, q) mean^(5/2) by the series DLMF 19.19.7. The arguments are deviations from
 * the mean; y_z is y + z, and yz is y z. */
static double series_slope(double x, double y_z, double yz, double p, double q)
{
    /* c1 to c3: symmetric functions of x, y, z. The next ones: symmetric functions of p, p, q, q */
    double c1 = x + y_z, c2 = x * y_z + yz, c3 = x * yz;
    double g = p + q, h = p * q, d1 = 2 * g, d2 = g * g + 2 * h, d3 = 2 * g * h, d4 = h * h;
    double e2 = c2 + c1 * d1 + d2, e3 = c3 + c2 * d1 + c1 * d2 + d3, e4 = c3 * d1 + c2 * d2 + c1 * d3 + d4,
           e5 = c3 * d2 + c2 * d3 + c1 * d4, e6 = c3 * d3 + c2 * d4, e7 = c3 * d4;
    return 1 - e2 * (5.0 / 18) + e3 * (5.0 / 22) + (5.0 / 13) * (0.375 * e2 * e2 - 0.5 * e4) +
           (1.0 / 3) * (0.5 * e5 - 0.75 * e2 * e3) +
           (5.0 / 17) * (0.375 * e3 * e3 - 0.3125 * e2 * e2 * e2 + 0.75 * e2 * e4 - 0.5 * e6) +
           (5.0 / 19) * (0.9375 * e2 * e2 * e3 - 0.75 * (e2 * e5 + e3 * e4) + 0.5 * e7);
}

/* A step of duplication of R_J adds 6 scale R_C(1, 1 + e)/d for p. Here it adds the divided difference of this term
 * between p and q. That difference follows from the divided differences of d, of delta = (p - x)(p - y)(p - z) and of e
 * = delta/d^2.
 */
double kd_carlson_rj_slope(struct kd_carlson_arg s, double p, double q)
{
    if (p < q) /* exchanges p and q, because e would be a difference of large numbers if p were far smaller */
        return kd_carlson_rj_slope(s, q, p);
    if (!(s.first >= 0 && s.sum > 0 && s.root >= 0 && p > 0 && q > 0) || (s.first == 0 && s.root == 0))
        return NAN;
    struct plain v = plain_of(&s);
    double at_p = p * (p - v.sum) + v.product, at_q = q * (q - v.sum) + v.product, delta_p = (p - v.x) * at_p,
           delta_q = (q - v.x) * at_q, delta = at_p + (q - v.x) * (p + q - v.sum);
    double scale = 1, sum = 0, mean = 1, x = 0, yz = 0, y_z = 0;
    for (int i = 0; i < STEPS; i++) {
        mean = (v.x + v.sum + 2 * (p + q)) / 7;
        x = 1 - v.x / mean;
        y_z = 2 - v.sum / mean;
        yz = 1 - v.sum / mean + v.product / (mean * mean);
        double far_p = 1 - p / mean, far_q = 1 - q / mean;
        if (converged(x, yz) && y_z * y_z < spread2 && far_p * far_p < spread2 && far_q * far_q < spread2)
            break;
        double rp = sqrt(p), rq = sqrt(q), root = 1 / (rp + rq), more_p = p + rp * s.sum + s.root,
               d_p = (rp + s.first) * more_p, d_q = (rq + s.first) * (q + rq * s.sum + s.root),
               d = root * more_p + (rq + s.first) * (1 + root * s.sum);
        double e_p = fmax(delta_p / (d_p * d_p), -1 + 1e-16), e_q = fmax(delta_q / (d_q * d_q), -1 + 1e-16),
               e = (delta - e_q * d * (d_p + d_q)) / (d_p * d_p);
        sum += scale * (kd_carlson_rc_slope(1 + e_p, 1 + e_q) * e - rc_unit(e_q) * d / d_q) / d_p;
        double lambda = s.first * s.sum + s.root;
        p = 0.25 * (p + lambda);
        q = 0.25 * (q + lambda);
        duplicate(&s);
        v = plain_of(&s);
        delta_p /= 64;
        delta_q /= 64;
        delta /= 16;
        scale /= 16;
    }
    return 6 * sum - 0.6 * scale * series_slope(x, y_z, yz, 1 - p / mean, 1 - q / mean) / (mean * mean * sqrt(mean));
}

double kd_carlson_rd_arg(struct kd_carlson_arg s)
{
    if (!(s.first >= 0 && s.sum > 0 && s.root >= 0))
        return NAN;
    if (s.first == 0)
        return INFINITY;
    double scale = 1, sum = 0, mean = 1, z = 0, xy = 0;
    for (int i = 0; i < STEPS; i++) {
        struct plain v = plain_of(&s);
        mean = 0.2 * (3 * v.x + v.sum);
        z = 1 - v.x / mean;
        xy = 1 - v.sum / mean + v.product / (mean * mean);
        if (converged(3 * z, xy))
            break;
        double first = s.first;
        sum += scale / (first * duplicate(&s));
        scale *= 0.25;
    }
    double z2 = z * z;
    return scale * series_j(xy - 6 * z2, (3 * xy - 8 * z2) * z, 3 * (xy - z2) * z2, xy * z2 * z) / (mean * sqrt(mean)) +
           3 * sum;
}

double kd_carlson_rf(double x, double y, double z)
{
    if (!(x >= 0 && y >= 0 && z >= 0))
        return NAN;
    if ((x == 0) + (y == 0) + (z == 0) > 1)
        return INFINITY;
    return kd_carlson_rf_arg(arg_of(x, y, z));
}

double kd_carlson_rd(double x, double y, double z)
{
    if (!(x >= 0 && y >= 0 && z >= 0))
        return NAN;
    if (z == 0 || (x == 0 && y == 0))
        return INFINITY;
    return kd_carlson_rd_arg(arg_of(z, x, y));
}

static void sort(double *a, double *b)
{
    double lo = fmin(*a, *b), hi = fmax(*a, *b);
    *a = lo, *b = hi;
}

double kd_carlson_rj(double x, double y, double z, double p)
{
    if (!(x >= 0 && y >= 0 && z >= 0) || isnan(p))
        return NAN;
    if (p == 0 || (x == 0) + (y == 0) + (z == 0) > 1)
        return INFINITY;
    sort(&x, &y), sort(&y, &z), sort(&x, &y);
    if (p > 0)
        return kd_carlson_rj_arg(arg_of(z, x, y), p);
    /* Uses DLMF 19.20.14, with y the middle argument so that the new p is positive. */
    double q = -p, shift = (z - y) * (y - x) / (y + q), up = y + shift, xz = x * z;
    double third = x == 0 ? 0 : 3 * sqrt(xz * y / (xz + up * q)) * kd_carlson_rc(xz + up * q, up * q);
    double first = shift == 0 ? 0 : shift * kd_carlson_rj_arg(arg_of(z, x, y), up);
    return (first - 3 * kd_carlson_rf(x, y, z) + third) / (y + q);
}

static double complex rc_unit_complex(double complex e)
{
    if (cabs(e) < 0.02) {
        double complex sum = 0;
        for (int k = 9; k >= 0; k--)
            sum = 1.0 / (2 * k + 1) - e * sum;
        return sum;
    }
    double complex root = csqrt(e);
    return catan(root) / root;
}

double complex kd_carlson_rc_complex(double complex s, double complex q2)
{
    return rc_unit_complex(q2 / (s * s) - 1) / s;
}

double complex kd_carlson_rj_complex(struct kd_carlson_arg s, double complex p)
{
    if (!(s.first >= 0 && s.sum > 0 && s.root >= 0 && creal(p) > 0))
        return NAN;
    struct plain v = plain_of(&s);
    double complex delta = (p - v.x) * (p * (p - v.sum) + v.product), sum = 0, mean = 1, x = 0, yz = 0, y_z = 0;
    double scale = 1;
    for (int i = 0; i < STEPS; i++) {
        mean = 0.2 * (v.x + v.sum + 2 * p);
        x = 1 - v.x / mean;
        y_z = 2 - v.sum / mean;
        yz = 1 - v.sum / mean + v.product / (mean * mean);
        if (converged(cabs(x), cabs(yz)) && cabs(y_z * y_z) < spread2)
            break;
        double complex rp = csqrt(p), d = (rp + s.first) * (p + rp * s.sum + s.root);
        sum += scale / d * rc_unit_complex(delta / (d * d));
        p = 0.25 * (p + s.first * s.sum + s.root);
        duplicate(&s);
        v = plain_of(&s);
        delta /= 64;
        scale *= 0.25;
    }
    double complex q = -0.5 * (x + y_z), q2 = q * q, xyz = x * yz;
    double complex e2 = x * y_z + yz - 3 * q2, e3 = xyz + 2 * q * (e2 + 2 * q2);
    double complex e4 = (2 * xyz + q * (e2 + 3 * q2)) * q, e5 = xyz * q2;
    double complex series =
        1 + e2 * (-3.0 / 14 + e2 * (9.0 / 88 - e2 / 16) + e3 * (-9.0 / 52 + e2 * (45.0 / 272)) + e4 * (3.0 / 20)) +
        e3 * (1.0 / 6 + e3 * (3.0 / 40)) - e4 * (3.0 / 22) + e5 * (3.0 / 26) - (9.0 / 68) * (e3 * e4 + e2 * e5);
    return scale * series / (mean * csqrt(mean)) + 6 * sum;
}
