/* Coefficients of polarised synchrotron light in CGS, as in the papers, for I, V and Q. Q is positive along the
 * electric field, perpendicular to the magnetic field. s and c: sine and cosine of the angle to the field; turn: the
 * gyrofrequency. */
#ifndef KD_TESTS_SYNCHROTRON_CGS_H
#define KD_TESTS_SYNCHROTRON_CGS_H

#include "cgs.h"

#include <math.h>

/* K_n(x) exp(x), by the trapezoidal rule, which converges exponentially for such decay. */
static inline double bessel(double n, double x)
{
    enum { POINTS = 200 };
    double sum = 0;
    const double most = acosh(1 + 60 / x), h = most / POINTS;
    for (int i = 0; i <= POINTS; i++)
        sum += (i ? 1 : 0.5) * exp(-x * (cosh(i * h) - 1)) * cosh(n * i * h);
    return sum * h;
}

/* j and alpha of I, Q and V, and rho of Q and V. */
struct coefficients { double j[3], a[3], rho[2]; };

static inline void hold(double *p)
{
    const double size = hypot(p[1], p[2]), most = 0.99 * p[0];
    for (int i = 1; i < 3 && size > most; i++)
        p[i] *= most / size;
}

static inline struct coefficients thermal(double n, double theta, double turn, double s, double c, double nu)
{
    struct coefficients o = { 0 };
    const double x = nu / (2.0 / 9 * turn * theta * theta * s), t = pow(theta, 0.96), k = pow(2, 11.0 / 12),
                 lead = n * E2 * turn / C * sqrt(2) * M_PI / 27 * s * exp(-cbrt(x));
    const double planck = 2 * H * nu * nu * nu / (C * C) / expm1(H * nu / (theta * ME * C * C));
    const double y = nu / (1.5 * turn * s * theta * theta), y3 = 1 / cbrt(y);
    o.j[0] = lead * pow(sqrt(x) + k * pow(x, 1.0 / 6), 2);
    o.j[1] = lead * pow(sqrt(x) + (7 * t + 35) / (10 * t + 75) * k * pow(x, 1.0 / 6), 2);
    /* Dexter 2016, A1 to A18: the ratio of V to I, each by his fits */
    const double ii = 2.5651 * (1 + 1.92 * y3 + 0.9977 * y3 * y3),
                 iv = 1.81348 / y + 3.42319 * pow(y, -2.0 / 3) + 0.0292545 / sqrt(y) + 2.03773 * y3;
    o.j[2] = o.j[0] * (2 * c / s / (3 * sqrt(3) * theta) * iv) / (ii / (2 * sqrt(3)));
    hold(o.j);
    for (int i = 0; i < 3; i++)
        o.a[i] = o.j[i] / planck;
    const double omega = 2 * M_PI * turn, plasma = 4 * M_PI * n * E2 / ME, w = 2 * M_PI * nu, k0 = bessel(0, 1 / theta),
                 k1 = bessel(1, 1 / theta), k2 = bessel(2, 1 / theta);
    const double f = theta * sqrt(sqrt(2) * s * 1000 * turn / nu), tail = 0.011 * exp(-f / 47.2);
    const double modified = 2.011 * exp(-pow(f, 1.035) / 4.7) - cos(f / 2) * exp(-pow(f, 1.2) / 2.73) - tail +
                            (tail - pow(2, -1.0 / 3) / pow(3, 23.0 / 6) * 1e4 * M_PI * pow(f + 1e-16, -8.0 / 3)) * 0.5 *
                                (1 + tanh(10 * log(f / 120)));
    o.rho[0] = w / (2 * C) * plasma * omega * omega / pow(w, 4) * modified * (k1 / k2 + 6 * theta) * s * s;
    o.rho[1] = w / C * plasma * omega / pow(w, 3) * k0 / k2 * (1 - 0.11 * log(1 + 0.035 * f)) * c;
    return o;
}

/* rho_V of L. Huang & R. V. Shcherbakov 2011, as given by Dexter 2016: B14 and B15. */
static inline double rotation_of_dexter(double n, double theta, double turn, double s, double c, double nu)
{
    const double omega = 2 * M_PI * turn, plasma = 4 * M_PI * n * E2 / ME, w = 2 * M_PI * nu,
                 f = theta * sqrt(sqrt(2) * s * 1000 * turn / nu);
    return w / C * plasma * omega / pow(w, 3) *
           (bessel(0, 1 / theta) - 0.43793091 * log(1 + 0.00185777 * pow(f, 1.50316886))) / bessel(2, 1 / theta) * c;
}

static inline struct coefficients power_law(double p, double least, double most, double n, double turn, double s,
                                            double c, double nu)
{
    struct coefficients o;
    const double share = (p - 1) / (pow(least, 1 - p) - pow(most, 1 - p)), x = nu / (turn * s);
    o.j[0] = n * E2 * turn / C * share * pow(3, p / 2) * s / (2 * (p + 1)) * tgamma((3 * p - 1) / 12) *
             tgamma((3 * p + 19) / 12) * pow(x, -(p - 1) / 2);
    o.j[1] = o.j[0] * (p + 1) / (p + 7.0 / 3);
    o.j[2] = o.j[0] * 171.0 / 250 * pow(p, 0.49) * c / s / sqrt(x / 3);
    hold(o.j);
    o.a[0] = n * E2 / (nu * ME * C) * share * pow(3, (p + 1) / 2) / 4 * tgamma((3 * p + 2) / 12) *
             tgamma((3 * p + 22) / 12) * pow(x, -(p + 2) / 2);
    o.a[1] = o.a[0] * pow(17.0 / 500 * p - 43.0 / 1250, 43.0 / 500);
    o.a[2] = o.a[0] * pow(71.0 / 100 * p + 22.0 / 625, 197.0 / 500) * pow(3.1 * pow(s, -48.0 / 25) - 3.1, 64.0 / 125) /
             sqrt(x) * (c > 0 ? 1 : -1);
    hold(o.a);
    const double across = n * E2 / (ME * C * turn * s) * share, y = least * least / x;
    o.rho[0] = across * pow(x, -3) * pow(least, 2 - p) * (1 - pow(y, p / 2 - 1)) / (p / 2 - 1);
    o.rho[1] = 2 * (p + 2) / (p + 1) * across / (x * x) * pow(least, -(p + 1)) * log(least) * c / s;
    return o;
}

/* Rotativities of A. Marszewski et al. 2021 (ApJ 921, 17) for the kappas of that paper. */
static inline void marszewski(double kappa, double w, double x, double rho[2])
{
    const double r = sqrt(w), e = r * exp(-5 * w);
    if (kappa == 3.5) {
        rho[0] = (17 * w - 3 * r + 7 * e) * (1 - exp(-pow(x, 0.84) / 30) - sin(x / 10) * exp(-3 * pow(x, 0.471) / 2));
        rho[1] = (w * w + 2 * w + 1) / (25.0 / 8 * w * w + 4 * w + 1) * (1 - 0.17 * log(1 + 0.447 / sqrt(x)));
    } else if (kappa == 4) {
        rho[0] = (46.0 / 3 * w - 5.0 / 3 * r + 17.0 / 3 * e) *
                 (1 - exp(-pow(x, 0.84) / 18) - sin(x / 6) * exp(-7.0 / 4 * sqrt(x)));
        rho[1] = (w * w + 54 * w + 50) / (30.0 / 11 * w * w + 134 * w + 50) * (1 - 0.17 * log(1 + 0.391 / sqrt(x)));
    } else if (kappa == 4.5) {
        rho[0] = (14 * w - 13.0 / 8 * r + 9.0 / 2 * e) *
                 (1 - exp(-pow(x, 0.84) / 12) - sin(x / 4) * exp(-2 * pow(x, 0.525)));
        rho[1] = (w * w + 43 * w + 38) / (7.0 / 3 * w * w + 185.0 / 2 * w + 38) * (1 - 0.17 * log(1 + 0.348 / sqrt(x)));
    } else {
        rho[0] =
            (25.0 / 2 * w - r + 5 * e) * (1 - exp(-pow(x, 0.84) / 8) - sin(3 * x / 8) * exp(-9.0 / 4 * pow(x, 0.541)));
        rho[1] = (w + 13.0 / 14) / (2 * w + 13.0 / 14) * (1 - 0.17 * log(1 + 0.313 / sqrt(x)));
    }
    rho[1] *= bessel(0, 1 / w) / bessel(2, 1 / w);
}

/* Joins the coefficients of two laws. */
static inline double least_of(double low, double high, double s) { return pow(pow(low, -s) + pow(high, -s), -1 / s); }

/* Pandya et al. 2016, equations 35 to 44, with the hypergeometric function by Euler's integral in ln t. The
 * rotativities are interpolated linearly between the kappas of Marszewski. */
static inline struct coefficients kappa_law(double kappa, double n, double theta, double turn, double s, double c,
                                            double nu)
{
    const double w = theta * (kappa - 3) / kappa, wk = w * kappa, x = nu / (turn * wk * wk * s), a = kappa - 1.0 / 3,
                 b = kappa + 1, all = (kappa - 2) * (kappa - 1) * kappa, way = c > 0 ? 1 : -1;
    enum { PARTS = 200 };
    struct coefficients o;
    double f = 0, down[2], up[2], below = floor(2 * kappa) / 2;
    double low = cbrt(x) * s * 4 * M_PI * tgamma(kappa - 4.0 / 3) / (pow(3, 7.0 / 3) * tgamma(kappa - 2));
    double high = pow(x, -(kappa - 2) / 2) * s * pow(3, (kappa - 1) / 2) * (kappa - 2) * (kappa - 1) / 4 *
                  tgamma(kappa / 4 - 1.0 / 3) * tgamma(kappa / 4 + 4.0 / 3);
    for (int i = 0; i <= PARTS; i++) {
        const double h = 20.0 / PARTS, t = exp(-i * h);
        f += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * h / 3 * a * pow(t, a) * pow(1 + wk * t, -b);
    }
    const double light = n * E2 * turn / C, depth = n * E2 / (nu * ME * C);
    o.j[0] = light * least_of(low, high, 3 * pow(kappa, -1.5));
    o.j[1] = light * least_of(low / 2, high * (16.0 / 25 + kappa / 50), 37.0 / 10 * pow(kappa, -8.0 / 5));
    o.j[2] =
        way * light *
        least_of(low * 9 / 16 * pow(pow(s, -12.0 / 5) - 1, 12.0 / 25) * pow(kappa, -66.0 / 125) / w * pow(x, -7.0 / 20),
                 high * 49 / 64 * pow(pow(s, -5.0 / 2) - 1, 11.0 / 25) * pow(kappa, -11.0 / 25) / w * pow(x, -1.0 / 2),
                 3 * pow(kappa, -1.5));
    hold(o.j);
    low = pow(x, -2.0 / 3) * pow(3, 1.0 / 6) * 10 / 41 * 2 * M_PI / pow(wk, 10.0 / 3 - kappa) * all / (3 * kappa - 1) *
          tgamma(5.0 / 3) * f;
    high = pow(x, -(1 + kappa) / 2) * pow(M_PI, 1.5) / 3 * all / (wk * wk * wk) *
           (2 * tgamma(2 + kappa / 2) / (2 + kappa) - 1);
    o.a[0] =
        depth * least_of(low, high * (pow(3 / kappa, 19.0 / 4) + 3.0 / 5), pow(-7.0 / 4 + 8 * kappa / 5, -43.0 / 50));
    o.a[1] = depth * least_of(low * 25 / 48, high * (21 * 21 * pow(kappa, -144.0 / 25) + 11.0 / 20),
                              7.0 / 5 * pow(kappa, -23.0 / 20));
    o.a[2] = way * depth *
             least_of(low * 77 / (100 * w) * pow(pow(s, -114.0 / 50) - 1, 223.0 / 500) * pow(x, -7.0 / 20) *
                          pow(kappa, -7.0 / 10),
                      high * 143 / 10 * pow(w, -116.0 / 125) * sqrt(pow(s, -41.0 / 20) - 1) / sqrt(x) *
                          (169 * pow(kappa, -8) + 13.0 / 2500 * kappa - 263.0 / 5000 + 47 / (200 * kappa)),
                      61.0 / 50 * pow(kappa, -142.0 / 125) + 7.0 / 1000);
    hold(o.a);
    marszewski(below, w, x, down);
    marszewski(fmin(below + 0.5, 5), w, x, up);
    const double rho = n * E2 * turn / (ME * C * nu * nu), past = 2 * (kappa - below);
    o.rho[0] = rho * turn / nu * s * s * ((1 - past) * down[0] + past * up[0]);
    o.rho[1] = 2 * rho * c * ((1 - past) * down[1] + past * up[1]);
    return o;
}

#endif
