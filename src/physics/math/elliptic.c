#include "physics/math/elliptic.h"

#include "physics/math/carlson.h"

#include <math.h>

/* An angle phi = turns pi + rest, with |rest| <= pi/2. s, c: sine and cosine of `rest`. */
struct reduced { double turns, s, c; };

static struct reduced reduce(double phi)
{
    if (fabs(phi) <= 0.5 * M_PI)
        return (struct reduced) { 0, sin(phi), cos(phi) };
    double turns = nearbyint(phi / M_PI), even = fmod(turns, 2) == 0 ? 1 : -1;
    return (struct reduced) { turns, even * sin(phi), even * cos(phi) };
}

double kd_elliptic_f(double phi, double m)
{
    struct reduced r = reduce(phi);
    double f = r.s * kd_carlson_rf(r.c * r.c, 1 - m * r.s * r.s, 1);
    return r.turns == 0 ? f : f + 2 * r.turns * kd_elliptic_k(m);
}

double kd_elliptic_e(double phi, double m)
{
    struct reduced r = reduce(phi);
    double c2 = r.c * r.c, d2 = 1 - m * r.s * r.s;
    double e = r.s * (kd_carlson_rf(c2, d2, 1) - m * r.s * r.s * kd_carlson_rd(c2, d2, 1) / 3);
    return r.turns == 0 ? e : e + 2 * r.turns * kd_elliptic_e_complete(m);
}

double kd_elliptic_pi(double n, double phi, double m)
{
    struct reduced r = reduce(phi);
    double s2 = r.s * r.s, c2 = r.c * r.c, d2 = 1 - m * s2;
    double rest = n == 0 ? 0 : n * s2 * kd_carlson_rj(c2, d2, 1, 1 - n * s2) / 3;
    double p = r.s * (kd_carlson_rf(c2, d2, 1) + rest);
    return r.turns == 0 ? p : p + 2 * r.turns * kd_elliptic_pi_complete(n, m);
}

double kd_elliptic_k(double m) { return kd_carlson_rf(0, 1 - m, 1); }

/* E(m) by DLMF 19.25.1, in the form without cancellation near m = 1. */
double kd_elliptic_e_complete(double m)
{
    if (m == 1)
        return 1;
    double m1 = 1 - m;
    return m1 * (kd_carlson_rd(0, m1, 1) + kd_carlson_rd(0, 1, m1)) / 3;
}

double kd_elliptic_pi_complete(double n, double m)
{
    return kd_carlson_rf(0, 1 - m, 1) + (n == 0 ? 0 : n * kd_carlson_rj(0, 1 - m, 1, 1 - n) / 3);
}

/* A level n of the arithmetic-geometric mean has the numbers a_n and b_n, from which the modulus of the next level is
 * k_{n+1} = (a_n - b_n)/(a_n + b_n). With c = cn/sn, the descending transformation (DLMF 22.7.2-4) from level n + 1
 * back to level n is
 *
 *   c_n = c_{n+1} dn_{n+1} a_{n+1}/a_n        dn_n = (b_n + a_{n+1} c_{n+1}^2)/(a_n + a_{n+1} c_{n+1}^2)
 *
 * Nothing is subtracted. So cn and dn keep all digits near m = 1, where the usual recursion on the amplitude loses half
 * of them. */
struct kd_jacobi kd_jacobi(double u, double m, double m1)
{
    if (!(m >= 0 && m1 >= 0))
        return (struct kd_jacobi) { NAN, NAN, NAN };
    if (m1 == 0)
        return (struct kd_jacobi) { tanh(u), 1 / cosh(u), 1 / cosh(u) };
    if (u == 0)
        return (struct kd_jacobi) { u, 1, 1 };
    double a[16], b[16];
    int n = 0;
    a[0] = 1, b[0] = sqrt(m1);
    /* The mean converges quadratically: after a relative difference of 1e-8, the difference at the next level is 1e-17.
     * 15 levels suffice for m1 = 1e-300. */
    for (; n < 15 && fabs(a[n] - b[n]) > 1e-8 * a[n]; n++) {
        a[n + 1] = 0.5 * (a[n] + b[n]);
        b[n + 1] = sqrt(a[n] * b[n]);
    }
    double last = 0.5 * (a[n] + b[n]), s = sin(last * u), c = cos(last * u) / s, dn = 1, above = last;
    for (; n >= 0; n--) {
        double c2 = above * c * c, ratio = above / a[n];
        c *= dn * ratio;
        dn = (b[n] + c2) / (a[n] + c2);
        above = a[n];
    }
    double sn = copysign(1 / sqrt(1 + c * c), s);
    return (struct kd_jacobi) { sn, c * sn, dn };
}

double kd_jacobi_am(double u, double m, double m1)
{
    struct kd_jacobi j = kd_jacobi(u, m, m1);
    return atan2(j.sn, j.cn);
}
