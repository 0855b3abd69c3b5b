#include "render/rays/start.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* The ray in Mino time. y: n = (sin theta cos psi, sin theta sin psi, cos theta) and w = 1/r. v: derivatives of n and
 * w. chi: Boyer-Lindquist azimuth minus psi. The equations are those of shaders/ray/escape.glsl. */
struct motion {
    const struct kd_hole *hole;
    double a, l, q, k, d; /* d: the sum a^2 Q + q^2 K */
};
struct point { double y[4], v[4], chi; };

static void pull(const struct motion *m, const double y[4], double f[4])
{
    double a2 = m->a * m->a, u = y[2], w = y[3], turning = m->q + m->l * m->l + 2 * a2 * u * u;
    for (int i = 0; i < 3; i++)
        f[i] = -turning * y[i];
    f[2] += a2 * u;
    f[3] = w * (a2 - m->l * m->l - m->q + w * (3 * m->k - 2 * m->d * w));
}

static double drag(const struct motion *m, double w)
{
    return m->a * w * (2 - kd_hole_rates_of(m->hole, 1, m->l).drag * w) / kd_hole_delta_w(m->hole, w);
}

/* A step of Nystroem's method of order 4, as in nystroem.glsl. Frame dragging is integrated by Simpson's rule, with the
 * midpoint from the cubic through both ends. */
static struct point step(const struct motion *m, const struct point *p, double h)
{
    double k1[4], k2[4], k3[4], y[4];
    struct point o;
    pull(m, p->y, k1);
    for (int i = 0; i < 4; i++)
        y[i] = p->y[i] + h * (p->v[i] / 2 + h / 8 * k1[i]);
    pull(m, y, k2);
    for (int i = 0; i < 4; i++)
        y[i] = p->y[i] + h * (p->v[i] + h / 2 * k2[i]);
    pull(m, y, k3);
    for (int i = 0; i < 4; i++) {
        o.y[i] = p->y[i] + h * (p->v[i] + h / 6 * (k1[i] + 2 * k2[i]));
        o.v[i] = p->v[i] + h / 6 * (k1[i] + 4 * k2[i] + k3[i]);
    }
    double middle = (p->y[3] + o.y[3]) / 2 + h / 8 * (p->v[3] - o.v[3]);
    o.chi = p->chi + h / 6 * (drag(m, p->y[3]) + 4 * drag(m, middle) + drag(m, o.y[3]));
    return o;
}

/* Fraction of a step at which the cubic through both ends crosses the plane, by Newton's method. */
static double share(const struct point *p, const struct point *q, double h)
{
    double y0 = p->y[2], dy = q->y[2] - y0, d0 = h * p->v[2], d1 = h * q->v[2];
    double c2 = 3 * dy - 2 * d0 - d1, c3 = d0 + d1 - 2 * dy, s = y0 / (y0 - q->y[2]);
    for (int k = 0; k < 4; k++)
        s -= (y0 + s * (d0 + s * (c2 + s * c3))) / (d0 + s * (2 * c2 + 3 * s * c3));
    return s;
}

/* Follows a ray from infinity to Mino time t. t is at most an eighth of the reciprocal impact parameter, which is
 * less than a half turn. */
static struct point approach(const struct motion *m, struct point p, double t, struct kd_rays_origin *out)
{
    enum { STEPS = 32 }; /* each step turns by at most 1/256 rad, so the result is accurate to 1e-13 */
    double h = t / STEPS;
    for (int i = 0; i < STEPS; i++) {
        struct point q = step(m, &p, h);
        if (p.y[2] != 0 && (p.y[2] > 0) != (q.y[2] > 0)) {
            struct point c = step(m, &p, h * share(&p, &q, h));
            out->w = c.y[3];
            out->phi = -(atan2(c.y[1], c.y[0]) + c.chi);
        }
        p = q;
    }
    return p;
}

/* Converts to Cartesian coordinates: x + iy = (r + ia)(n_x + i n_y), z = r n_z, with n rotated to the Kerr-Schild
 * azimuth. The momentum is p_r dr + n'.dn: n' has the components p_theta and L/sin(theta) along the unit vectors of
 * the sphere, so it is regular on the axis. */
static void cartesian(const struct motion *m, const struct point *p, bool outward, struct kd_rays_origin *out)
{
    double a = m->a, r = 1 / p->y[3], q = r * r + a * a, turn = p->chi - kd_kerr_twist(m->hole, r), c = cos(turn),
           s = sin(turn);
    double n[3] = { c * p->y[0] - s * p->y[1], s * p->y[0] + c * p->y[1], p->y[2] };
    double v[3] = { c * p->v[0] - s * p->v[1], s * p->v[0] + c * p->v[1], p->v[2] };
    double x[3] = { r * n[0] - a * n[1], r * n[1] + a * n[0], r * n[2] }, k = r / (r * r * r * r + a * a * x[2] * x[2]);
    double dr[3] = { r * r * x[0] * k, r * r * x[1] * k, q * x[2] * k };
    /* p_r = (2r - q^2 - aL -+ sqrt(R))/Delta, R = W^2 - Delta K, W = r^2 + a^2 - aL. For inward rays it is computed in
     * a form without cancellation. */
    double big = q - a * m->l, delta = kd_hole_delta(m->hole, r), radial = sqrt(fmax(big * big - delta * m->k, 0));
    double p_r = (outward ? (big + radial) / delta : m->k / (big + radial)) - 1;
    p_r += (v[0] * (x[0] - 2 * r * n[0]) + v[1] * (x[1] - 2 * r * n[1])) / q - v[2] * n[2] / r;
    const double along[3] = { (r * v[0] - a * v[1]) / q, (r * v[1] + a * v[0]) / q, v[2] / r };
    for (int i = 0; i < 3; i++) {
        out->x[i] = x[i];
        out->p[i] = p_r * dr[i] + along[i];
    }
}

void kd_rays_start(const struct kd_hole *hole, double r, double u, double s, double alpha, double beta, bool outward,
                   double far, struct kd_rays_origin *out)
{
    const double a = hole->a;
    struct motion m = { .hole = hole, .a = a, .l = -alpha * s, .q = (alpha * alpha - a * a) * u * u + beta * beta };
    m.k = m.q + (m.l - a) * (m.l - a);
    m.d = kd_hole_quartic(hole, m.q, m.k);
    struct point p = { { s, 0, u, isinf(r) ? 0 : 1 / r }, { -u * beta, -alpha, s * beta, 1 }, 0 };
    out->w = out->phi = 0;
    if (isinf(r)) /* at infinity w' = 1, so Mino time equals w */
        p = approach(&m, p, 1 / fmax(far, 8 * hypot(alpha, beta)), out);
    cartesian(&m, &p, outward, out);
}
