/* The Hamiltonian flow of kerr_schild.h, for the files that implement it. The including file must define `real`, the
 * type of all numbers, and these bounds of a step's relative error. Below KS_FINE the extrapolation ends. Above
 * KS_ACCEPT the step is rejected. Below KS_GROW the next step is twice as long. KS_LAND bounds the distance from the
 * plane in which a step ends. */
#ifndef KD_TESTS_KERR_SCHILD_FLOW_H
#define KD_TESTS_KERR_SCHILD_FLOW_H

#include "kerr_schild.h"

#include <string.h>
#include <tgmath.h>

struct system { real a, energy, q; };
typedef real state[7]; /* x, y, z, p_x, p_y, p_z, t */

static real radius(real a, const real *x)
{
    real rho2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - a * a;
    real root = sqrt(rho2 * rho2 + 4 * a * a * x[2] * x[2]);
    /* each form avoids cancellation for one sign */
    return sqrt(rho2 > 0 ? 0.5 * (rho2 + root) : 2 * a * a * x[2] * x[2] / (root - rho2));
}

/* H = (p.p - E^2 - f (E + l.p)^2)/2, f = r^2 (2r - q^2)/(r^4 + a^2 z^2), l = ((rx + ay)/(r^2 + a^2), (ry - ax)/(r^2 +
 * a^2), z/r). */
static void derivative(const struct system *s, const real *y, real *d)
{
    real a = s->a, x = y[0], yy = y[1], z = y[2], px = y[3], py = y[4], pz = y[5];
    const real charge2 = s->q * s->q;
    real r = radius(a, y), r2 = r * r, q = r2 + a * a, den = r2 * r2 + a * a * z * z;
    real rho2 = x * x + yy * yy + z * z - a * a, k = 1 / (2 * r2 * r - rho2 * r);
    real dr[3] = { r2 * x * k, r2 * yy * k, (r2 + a * a) * z * k };
    real f = r2 * (2 * r - charge2) / den;
    real l[3] = { (r * x + a * yy) / q, (r * yy - a * x) / q, z / r };
    real along = l[0] * px + l[1] * py + l[2] * pz, sum = s->energy + along;
    real in_plane = x * px + yy * py;
    for (int i = 0; i < 3; i++) {
        real df = ((6 * r2 - 2 * charge2 * r) * dr[i] - f * (4 * r2 * r * dr[i] + (i == 2 ? 2 * a * a * z : 0))) / den;
        real dl = dr[i] * in_plane / q - (l[0] * px + l[1] * py) * 2 * r * dr[i] / q - z * pz / r2 * dr[i];
        dl += i == 0 ? (r * px - a * py) / q : i == 1 ? (r * py + a * px) / q : pz / r;
        d[i] = y[3 + i] - f * sum * l[i];
        d[3 + i] = 0.5 * sum * sum * df + f * sum * dl;
    }
    d[6] = s->energy + f * sum;
}

static void midpoint(const struct system *s, const real *y, real h, int n, real *out)
{
    state a, b, d;
    real step = h / n;
    derivative(s, y, d);
    memcpy(a, y, sizeof a);
    for (int i = 0; i < 7; i++)
        b[i] = y[i] + step * d[i];
    for (int k = 1; k < n; k++) {
        derivative(s, b, d);
        for (int i = 0; i < 7; i++) {
            real t = a[i] + 2 * step * d[i];
            a[i] = b[i];
            b[i] = t;
        }
    }
    derivative(s, b, d);
    for (int i = 0; i < 7; i++)
        out[i] = 0.5 * (a[i] + b[i] + step * d[i]);
}

/* One extrapolated step (Neville's table in h^2); returns the estimated relative error. */
static real extrapolate(const struct system *s, const real *y, real h, real *out)
{
    enum { ROWS = 9 };
    real table[ROWS][ROWS][7], error = INFINITY;
    real x_scale = fabs(y[0]) + fabs(y[1]) + fabs(y[2]), p_scale = fabs(y[3]) + fabs(y[4]) + fabs(y[5]);
    for (int k = 0; k < ROWS && !(error < 1e-15); k++) {
        midpoint(s, y, h, 2 * (k + 1), table[k][0]);
        for (int j = 1; j <= k; j++) {
            real ratio = (real)(k + 1) / (k + 1 - j), weight = 1 / (ratio * ratio - 1);
            for (int i = 0; i < 7; i++)
                table[k][j][i] = table[k][j - 1][i] + weight * (table[k][j - 1][i] - table[k - 1][j - 1][i]);
        }
        error = k ? 0 : INFINITY;
        for (int i = 0; i < 7 && k; i++)
            error = fmax(error, fabs(table[k][k][i] - table[k][k - 1][i]) / (i < 3 || i == 6 ? x_scale : p_scale));
        memcpy(out, table[k][k], sizeof(state));
    }
    return error;
}

/* sqrt(1 - a^2 - q^2) */
static real half_gap(real a, real q)
{
    const long double spin = a, charge = q;
    return (real)sqrt((1 - spin) * (1 + spin) - charge * charge);
}

/* Integral of a/Delta from r to infinity: Boyer-Lindquist minus Kerr-Schild azimuth. */
static real twist(real a, real q, real r)
{
    real root = half_gap(a, q);
    return root > 0 ? a / (2 * root) * log1p(2 * root / (r - 1 - root)) : a / (r - 1);
}

static real azimuth(real a, real q, const real *y)
{
    real r = radius(a, y);
    return atan2(y[1], y[0]) - atan2(a, r) + twist(a, q, r);
}

/* Kerr-Schild minus Boyer-Lindquist time at r: integral of (2r - q^2)/Delta, up to a constant. */
static real slow(real a, real q, real r)
{
    real root = half_gap(a, q), plus = 1 + root, minus = 1 - root, half = 0.5 * q * q;
    if (root == 0)
        return 2 * log(r - 1) - (2 - q * q) / (r - 1);
    return ((plus - half) * log(r - plus) - (minus - half) * log(r - minus)) / root;
}

/* From spherical coordinates and covariant components p_r, p_theta, p_phi to Cartesian ones. */
static void place(real a, real r, real s, real u, real phi, const real p[3], real *y)
{
    real c = cos(phi), d = sin(phi);
    real x = (r * c - a * d) * s, yy = (r * d + a * c) * s;
    /* p_i dx^i over (dr, dtheta, dphi): three equations for the Cartesian components. */
    real m[3][4] = {
        { s * c, s * d, u, p[0] },
        { (r * c - a * d) * u, (r * d + a * c) * u, -r * s, p[1] },
        { -yy, x, 0, p[2] },
    };
    if (s == 0) /* On the axis any azimuth is valid, and the third row vanishes. Instead, e_phi by the azimuth `phi`
                 * determines the momentum along it. */
        m[2][0] = -d, m[2][1] = c, m[2][3] = 0;
    for (int i = 0; i < 3; i++) {
        int pivot = i;
        for (int k = i + 1; k < 3; k++)
            if (fabs(m[k][i]) > fabs(m[pivot][i]))
                pivot = k;
        for (int j = 0; j < 4; j++) {
            real t = m[i][j];
            m[i][j] = m[pivot][j];
            m[pivot][j] = t;
        }
        for (int k = 0; k < 3; k++)
            for (int j = 3; k != i && j >= i; j--)
                m[k][j] -= m[k][i] / m[i][i] * m[i][j];
    }
    y[0] = x, y[1] = yy, y[2] = r * u;
    for (int i = 0; i < 3; i++)
        y[3 + i] = m[i][3] / m[i][i];
}

static void start(const struct ks_photon *p, real *y)
{
    real a = p->a, q = p->q, r = p->r, u = p->u, delta = r * r - 2 * r + a * a + q * q;
    real p_r = -p->p_r + ((2 * r - q * q) * p->energy - a * p->momentum) / delta;
    place(a, r, sqrt((1 - u) * (1 + u)), u, -p->phi - twist(a, q, r), (real[]) { p_r, -p->p_theta, p->momentum }, y);
    y[6] = p->delay + slow(a, q, r);
}

/* Makes the step from y that ends on z = 0, if a step of h would cross z = 0. */
static void land(const struct system *s, const real *y, real h, real *out)
{
    real lo = 0, hi = h, z_lo = y[2], t = h;
    state e;
    extrapolate(s, y, h, e);
    real z_hi = e[2];
    for (int i = 0; i < 60; i++) {
        t = lo + (hi - lo) * z_lo / (z_lo - z_hi);
        if (i % 4 == 3)
            t = 0.5 * (lo + hi);
        extrapolate(s, y, t, out);
        if (fabs(out[2]) < KS_LAND * radius(s->a, out) || hi - lo < KS_FINE * h)
            return;
        if ((out[2] > 0) == (z_lo > 0))
            lo = t, z_lo = out[2];
        else
            hi = t, z_hi = out[2];
    }
}

/* Follows the Hamiltonian flow from y. mirrored: azimuth and time are reversed, and the horizon is reached at finite
 * parameter. Otherwise rays end at the past horizon. There these coordinates approach a limit, and momenta grow without
 * bound. The start may then lie within the future horizon. */
static struct ks_path run(const struct system s, state y, bool mirrored, int max_crossings)
{
    struct ks_path path = { .fate = KS_UNDECIDED };
    const real horizon = 1 + half_gap(s.a, s.q), sign = mirrored ? -1 : 1;
    state next;
    real h = 0.05 * radius(s.a, y);
    for (int step = 0; step < 20000; step++) {
        real r = radius(s.a, y), v = sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5]) + 2 * fabs(s.energy) / r;
        h = fmin(h, 0.25 * r / v); /* the step is too short to cross the plane twice */
        real error = extrapolate(&s, y, h, next);
        if (!(error < KS_ACCEPT) && h > 1e-9) {
            h *= 0.5;
            continue;
        }
        if (y[2] != 0 && (y[2] > 0) != (next[2] > 0) && path.crossings < 16) {
            state hit;
            land(&s, y, h, hit);
            real hr = radius(s.a, hit);
            if (mirrored && hr <= horizon)
                break;
            path.r[path.crossings] = hr;
            state way;
            derivative(&s, hit, way);
            path.falls[path.crossings] = hit[0] * way[0] + hit[1] * way[1] > 0;
            path.momentum[path.crossings] = -sign * (hit[0] * hit[4] - hit[1] * hit[3]);
            path.delay[path.crossings] = mirrored ? hit[6] - slow(s.a, s.q, hr) : NAN;
            path.p_z[path.crossings] = fabs(hit[5]);
            path.phi[path.crossings++] = sign * azimuth(s.a, s.q, hit);
        }
        memcpy(y, next, sizeof next);
        r = radius(s.a, y);
        bool falls =
            mirrored ? r < horizon * (1 + 1e-9) : fabs(r / horizon - 1) < 1e-3 && v > 1e6 * (1 + fabs(s.energy));
        if (falls || path.crossings >= max_crossings) {
            path.fate = falls ? KS_CAPTURED : KS_UNDECIDED;
            return path;
        }
        if (r > 1e8 && y[0] * y[3] + y[1] * y[4] + y[2] * y[5] > 0) {
            path.fate = KS_ESCAPED;
            path.u = y[2] / r;
            path.sky_phi = sign * azimuth(s.a, s.q, y);
            return path;
        }
        h *= error < KS_GROW ? 2 : 1;
    }
    if (path.fate == KS_UNDECIDED && radius(s.a, y) < 1.1 * horizon)
        path.fate = KS_CAPTURED;
    return path;
}

#endif
