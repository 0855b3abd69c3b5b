#include "physics/null/null_plane.h"

#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdbool.h>

enum { ORDER = 19, STEPS = 2000 };

/* Taylor series of w and u about the present position. */
struct series { double w[ORDER + 1], u[ORDER + 1]; };

struct ray {
    double a2, k3, c2, e2; /* A, 3K, -2D and 2 a^2 E^2 */
    double horizon;        /* 1/r+ */
    bool ours;             /* true unless the ray comes from another exterior region through the horizon */
    double w, dw, u, du;
};

static struct ray ray_of(const struct kd_vantage *at, const struct kd_covector *p)
{
    const double a = at->hole.a, ae = a * p->energy, l = p->momentum * at->s, u2 = at->u * at->u,
                 r_plus = at->hole.outer;
    const double q = p->polar * p->polar + u2 * (p->momentum * p->momentum - ae * ae), k = q + (l - ae) * (l - ae);
    return (struct ray) {
        .a2 = ae * ae - q - l * l,
        .k3 = 3 * k,
        .c2 = -2 * kd_hole_quartic(&at->hole, q, k),
        .e2 = 2 * ae * ae,
        .horizon = 1 / r_plus,
        .ours = at->r > r_plus || (r_plus * r_plus + a * a) * p->energy - a * l > 0,
        .w = 1 / at->r,
        .dw = p->radial / (at->r * at->r),
        .u = at->u,
        .du = at->s * p->polar,
    };
}

/* Coefficient n of the product of two series. */
static double product(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i <= n; i++)
        sum += x[i] * y[n - i];
    return sum;
}

static struct series series_of(const struct ray *o)
{
    struct series s = { { o->w, o->dw }, { o->u, o->du } };
    double w2[ORDER + 1], u2[ORDER + 1];
    for (int n = 0; n + 2 <= ORDER; n++) {
        w2[n] = product(s.w, s.w, n);
        u2[n] = product(s.u, s.u, n);
        const double ww = o->a2 * s.w[n] + o->k3 * w2[n] + o->c2 * product(w2, s.w, n),
                     uu = o->a2 * s.u[n] - o->e2 * product(u2, s.u, n);
        s.w[n + 2] = ww / ((n + 1) * (n + 2));
        s.u[n + 2] = uu / ((n + 1) * (n + 2));
    }
    return s;
}

/* The largest step at which the error of a series is at most a rounding of `size`. */
static double reach(const double *c, double size)
{
    const double last = pow(size / fabs(c[ORDER]), 1.0 / ORDER),
                 before = pow(size / fabs(c[ORDER - 1]), 1.0 / (ORDER - 1));
    return fmin(last, before) * exp(-2);
}

static double value(const double *c, double h)
{
    double sum = c[ORDER];
    for (int n = ORDER - 1; n >= 0; n--)
        sum = sum * h + c[n];
    return sum;
}

static double slope(const double *c, double h)
{
    double sum = ORDER * c[ORDER];
    for (int n = ORDER - 1; n >= 1; n--)
        sum = sum * h + n * c[n];
    return sum;
}

/* The root of u in (0, h], by Newton's method within this bracket. u must have different signs at both ends. */
static double crossing(const double *c, double h)
{
    double low = 0, high = h, at = h * c[0] / (c[0] - value(c, h));
    for (int i = 0; i < 80; i++) {
        const double f = value(c, at);
        *((f < 0) == (c[0] < 0) ? &low : &high) = at;
        double next = at - f / slope(c, at);
        next = next > low && next < high ? next : 0.5 * (low + high);
        if (fabs(next - at) <= 1e-16 * h)
            break;
        at = next;
    }
    return at;
}

/* True if the ray has reached the past horizon, or the past horizon of another exterior region. */
static bool is_dark(const struct ray *o, double w, double dw) { return w >= o->horizon ? dw >= 0 : !o->ours; }

double kd_null_plane_radius(const struct kd_vantage *at, const struct kd_covector *photon, int n)
{
    struct ray o = ray_of(at, photon);
    const double far = o.ours ? INFINITY : -INFINITY;
    int crossings = 0;
    for (int i = 0; i < STEPS && !is_dark(&o, o.w, o.dw); i++) {
        const struct series s = series_of(&o);
        const double h = fmin(reach(s.w, fabs(o.w) + 1e-12), reach(s.u, 1)), u = value(s.u, h);
        if (!isfinite(h))
            break;
        if (o.u != 0 && (u == 0 || (u < 0) != (o.u < 0))) {
            const double t = crossing(s.u, h), w = value(s.w, t);
            if (w <= 0)
                return far;
            if (is_dark(&o, w, slope(s.w, t)))
                return -INFINITY;
            if (crossings++ == n)
                return 1 / w;
        }
        const double w = value(s.w, h), dw = slope(s.w, h), du = slope(s.u, h);
        if (w <= 0)
            return far;
        o.w = w, o.dw = dw, o.u = u, o.du = du;
    }
    return is_dark(&o, o.w, o.dw) ? -INFINITY : INFINITY;
}
