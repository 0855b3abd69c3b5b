#include "physics/null/sky_view.h"

#include <math.h>

enum { EDGE_POINTS = 512 };

/* Energy at infinity of a photon seen in the direction k = (right, up, inwards) with energy 1. */
static double energy(const struct kd_tetrad *f, const double k[3])
{
    return f->t.energy + k[2] * f->r.energy + k[1] * f->theta.energy - k[0] * f->phi.energy;
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void edge_at(const struct kd_critical *edge, double angle, double k[3])
{
    const struct kd_critical_point p = kd_critical_at(edge, angle);
    k[0] = p.right, k[1] = p.up, k[2] = p.inwards;
}

/* Signed angle of the triangle c a b on the unit sphere: tan(A/2) = c (a x b)/(1 + ab + bc + ca) (A. van Oosterom &
 * J. Strackee 1983, IEEE Trans. Biomed. Eng. 30, 125). */
static double triangle(const double c[3], const double a[3], const double b[3])
{
    double volume =
        c[0] * (a[1] * b[2] - a[2] * b[1]) + c[1] * (a[2] * b[0] - a[0] * b[2]) + c[2] * (a[0] * b[1] - a[1] * b[0]);
    return 2 * atan2(volume, 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

static double polygon(const double c[3], double points[EDGE_POINTS][3], int stride)
{
    double sum = 0;
    for (int i = 0; i < EDGE_POINTS; i += stride)
        sum += triangle(c, points[i], points[(i + stride) % EDGE_POINTS]);
    return sum;
}

/* Solid angle enclosed by the edge. It is extrapolated (Romberg) from the areas of three polygons, whose errors are
 * series in the squared step. The triangles of a polygon share one corner, a direction inside the polygon. If most of
 * the edge is closer to the opposite direction, that direction is the shared corner instead, and the sum of the
 * triangles differs only by 4 pi.
 */
static double enclosed(const struct kd_critical *edge, double points[EDGE_POINTS][3])
{
    struct kd_critical_point middle = { .right = sin(edge->centre), .inwards = cos(edge->centre) };
    kd_critical_see(edge, &middle);
    double c[3] = { middle.right, middle.up, middle.inwards }, side = 0;
    for (int i = 0; i < EDGE_POINTS; i++)
        side += dot(c, points[i]);
    for (int i = 0; i < 3 && side < 0; i++)
        c[i] = -c[i];
    double fine = polygon(c, points, 1), half = polygon(c, points, 2), quarter = polygon(c, points, 4);
    double once = fine + (fine - half) / 3, before = half + (half - quarter) / 3, angle = once + (once - before) / 15;
    return angle < 0 ? angle + 4 * M_PI : angle;
}

/* Largest value of sign * E on the edge, by golden section between the neighbours of the highest point. The error of
 * the value is the square of the bracket's width. */
static double extreme(const struct kd_sky_view *v, double points[EDGE_POINTS][3], int sign)
{
    const double golden = 0.5 * (sqrt(5) - 1), step = 2 * M_PI / EDGE_POINTS;
    int best = 0;
    for (int i = 1; i < EDGE_POINTS; i++)
        if (sign * energy(&v->tetrad, points[i]) > sign * energy(&v->tetrad, points[best]))
            best = i;
    double low = (best - 1) * step, high = (best + 1) * step, p[3], q[3];
    while (high - low > 1e-8) {
        double left = high - golden * (high - low), right = low + golden * (high - low);
        edge_at(&v->edge, left, p);
        edge_at(&v->edge, right, q);
        if (sign * energy(&v->tetrad, p) > sign * energy(&v->tetrad, q))
            high = right;
        else
            low = left;
    }
    edge_at(&v->edge, 0.5 * (low + high), p);
    double there = sign * energy(&v->tetrad, p), sample = sign * energy(&v->tetrad, points[best]);
    return sign * fmax(there, sample);
}

/* True if the direction is in the dark disk. The direction is compared with the edge in polar coordinates about the
 * middle of the dark disk, in the frame of the edge, where every angle meets the edge once. */
static bool is_dark(const struct kd_sky_view *v, const double k[3])
{
    double right = k[0], up = k[1], inwards = k[2];
    if (v->edge.is_skew) {
        const struct kd_covector photon = kd_tetrad_covector(&v->tetrad, (double[]) { 1, inwards, up, -right });
        const struct kd_look look = kd_tetrad_look(&v->edge.tetrad, &photon);
        right = look.right, up = look.up, inwards = look.inwards;
    }
    double s = sin(v->edge.centre), c = cos(v->edge.centre), x = right * c - inwards * s, z = inwards * c + right * s;
    return atan2(hypot(x, up), z) <= kd_critical_at(&v->edge, atan2(up, x)).rho;
}

double kd_sky_view_shift(const struct kd_sky_view *v, const double direction[3])
{
    return is_dark(v, direction) ? NAN : 1 / energy(&v->tetrad, direction);
}

struct kd_sky_view kd_sky_view_of(const struct kd_critical_observer *o)
{
    struct kd_sky_view v = { .status = isfinite(o->radius) ? KD_CRITICAL_OK : KD_CRITICAL_BAD_INPUT };
    if (v.status)
        return v;
    v.edge = kd_critical_of(o);
    v.status = v.edge.status;
    if (v.status)
        return v;
    v.tetrad = v.edge.is_skew ? v.edge.skew : v.edge.tetrad;
    double points[EDGE_POINTS][3];
    for (int i = 0; i < EDGE_POINTS; i++)
        edge_at(&v.edge, i * (2 * M_PI / EDGE_POINTS), points[i]);
    v.dark = enclosed(&v.edge, points);
    v.least = 1 / extreme(&v, points, 1);
    v.greatest = 1 / extreme(&v, points, -1);
    const double slope[3] = { -v.tetrad.phi.energy, v.tetrad.theta.energy, v.tetrad.r.energy },
                 size = sqrt(dot(slope, slope));
    for (int sign = -1; sign <= 1 && size > 0; sign += 2) {
        const double pole[3] = { sign * slope[0] / size, sign * slope[1] / size, sign * slope[2] / size };
        double g = kd_sky_view_shift(&v, pole);
        v.least = fmin(v.least, g); /* fmin returns the other argument if one is NaN */
        v.greatest = fmax(v.greatest, g);
    }
    return v;
}
