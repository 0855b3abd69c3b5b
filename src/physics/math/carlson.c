#include "physics/math/carlson.h"

#include <math.h>
#include <stdbool.h>

/* Squared relative spread below which the seventh-degree series is accurate to 1e-17: the first omitted term is of
 * the eighth degree with a coefficient below 1/20, and 0.0095^8 / 20 = 3e-18. */
static const double spread2 = 9e-5;

/* Each step brings the arguments four times closer; arguments 1e300 apart take some 12 steps. */
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

/* x, y + z and y z. */
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

/* R_C(1, 1 + e), e > -1. */
static double rc_unit(double e)
{
    if (fabs(e) < 0.02) { /* sum of (-e)^k / (2k + 1) */
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
        /* a product of positive terms, which rounding must not make negative */
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
    /* DLMF 19.20.14, with y the middle argument so that the new p is positive. */
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
