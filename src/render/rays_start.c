#include "render/rays_start.h"

#include <math.h>

/* Kerr-Schild less Boyer-Lindquist azimuth at r: integral of a/Delta from infinity. */
static double twist(double a, double r)
{
    double root = sqrt((1 - a) * (1 + a));
    return root > 1e-4 ? a / (2 * root) * log1p(2 * root / (r - 1 - root)) : a / (r - 1);
}

/* Covector p_r dr + p_theta dtheta + p_phi dphi at (r, theta, azimuth), Kerr-Schild components, to Cartesian ones:
 * dr = (r^2 x, r^2 y, (r^2 + a^2) z) r/(r^4 + a^2 z^2), cos theta = z/r, phi = atan2(y, x) - atan2(a, r). */
static void cartesian(double a, double r, double u, double s, double azimuth, double p_r, double p_theta, double p_phi, double *out)
{
    double c = cos(azimuth), d = sin(azimuth), x = (r * c - a * d) * s, y = (r * d + a * c) * s, z = r * u;
    double k = r / (r * r * r * r + a * a * z * z), rho2 = x * x + y * y;
    double dr[3] = { r * r * x * k, r * r * y * k, (r * r + a * a) * z * k };
    double dphi[3] = { -y / rho2, x / rho2, 0 };
    out[0] = x, out[1] = y, out[2] = z;
    for (int i = 0; i < 3; i++) {
        double dtheta = (z * dr[i] / (r * r) - (i == 2 ? 1 / r : 0)) / s;
        out[3 + i] = p_r * dr[i] + p_theta * dtheta + p_phi * (dphi[i] + a / (r * r + a * a) * dr[i]);
    }
}

void kd_rays_start(double a, double r, double u, double s, double alpha, double beta, double far, double out[6])
{
    double l = -alpha * s, q = (alpha * alpha - a * a) * u * u + beta * beta;
    double pull = a * a - l * l - q; /* u'' = pull u - 2 a^2 u^3 */
    double azimuth = 0, towards = beta;
    if (isinf(r)) { /* Mino time from infinity is 1/far */
        double t = 1 / far, start = u;
        r = far;
        azimuth = s == 0 ? atan2(-alpha, -u * beta) : l * t / (s * s) + l * u * beta * t * t / (s * s * s);
        azimuth += a * t * t;
        u = start + s * beta * t + 0.5 * (pull - 2 * a * a * start * start) * start * t * t;
        if (s == 0)
            towards = -start; /* off the axis */
        s = sqrt((1 - u) * (1 + u));
    }
    /* Angular and radial momentum from the first integrals; the ray flies inwards. */
    double theta2 = q + u * u * (a * a - l * l / (s * s)), delta = r * r - 2 * r + a * a, w = r * r + a * a - a * l;
    double radial = sqrt(fmax(w * w - delta * (q + (l - a) * (l - a)), 0));
    double p_r = (2 * r - a * l - radial) / delta;
    cartesian(a, r, u, s, azimuth - twist(a, r), p_r, -copysign(sqrt(fmax(theta2, 0)), towards), l, out);
}
