/* Closed form of the motion v'^2 = f(v) = e^2 + A v^2 + 2K v^3 - D v^4 from any point of a path, forwards and
 * backwards.
 *
 * With g(z) = 1/(wp(z) - A/12), where wp is Weierstrass's function with the invariants of f,
 *
 *   g'^2 = 4g + A g^2 + e^2 D g^3 + G g^4,    G = e^2 (K^2 + A D)/4,    g = z^2 + ...,
 *
 * Biermann's formula (Whittaker & Watson 20.6) gives v at the time z after or before a point with the known values v
 * and v':
 *
 *   v(+-z) = v + (g (F P/2 + c g) +- v' g'/2) / (P^2 + v'^2 D g^2/4),
 *   F = v'' = v (A + 3K v - 2D v^2),  s = v (K - D v)/2,  P = 1 - g s,  c = v'^2 (K/4 - D v/2).
 *
 * g has a pole where z is the time from v = 0 to v = K/D, a place inside the horizon. No stretch outside the horizon
 * lasts so long. No root of f is needed. The pair (g, g') is the same for all points of a path: one pair serves the
 * same time before and after each crossing. The pair comes from the Laurent series of wp (Abramowitz & Stegun 18.5) up
 * to z sqrt|A| = pi/2. For larger z it comes from the duplication formula from z to 2z.
 *
 * The unit of time is a power of two, so that scaling causes no rounding. It is chosen such that 1 <= |A| < 4. A half
 * period then lasts from pi/2 to pi. Rays with b below about 1 have a smaller A. Their half periods are longer, but
 * these rays are captured or escape long before one ends. */
#ifndef KD_ARC_GLSL
#define KD_ARC_GLSL

#include "ray/radial_step.glsl"

struct kd_lattice {
    float a, d, g;                    /* coefficients of g'^2: a is A, d is e^2 D, g is G */
    float c2, c3, c4, c5, c6, c7, c8; /* coefficients of the series z^2/g = 1 - A z^2/12 + c2 z^4 + c3 z^6 + ... */
};

/* Constants of a scaled path: the time is z = scale tau, and v = scale w. */
struct kd_arcs {
    float scale, unit; /* scale, and 1/scale */
    float k, d;        /* K and D of the scaled f */
    kd_lattice l;
};

kd_lattice kd_lattice_of(float a, float d, float g)
{
    kd_lattice o;
    o.a = a;
    o.d = d;
    o.g = g;
    float g2 = a * a * (1.0 / 12.0) - d, g3 = a * (a * a * (1.0 / 432.0) - g2 * (1.0 / 12.0)) - g;
    o.c2 = g2 * (1.0 / 20.0);
    o.c3 = g3 * (1.0 / 28.0);
    float c22 = o.c2 * o.c2, c23 = o.c2 * o.c3;
    o.c4 = c22 * (1.0 / 3.0);
    o.c5 = c23 * (3.0 / 11.0);
    o.c6 = (c22 * o.c2 * (2.0 / 3.0) + o.c3 * o.c3) * (1.0 / 13.0);
    o.c7 = c22 * o.c3 * (2.0 / 33.0);
    o.c8 = o.c2 * (c22 * o.c2 * (55.0 / 7293.0) + o.c3 * o.c3 * (180.0 / 7293.0));
    return o;
}

kd_arcs kd_arcs_of(kd_geodesic m, float e)
{
    kd_arcs o;
    o.scale = uintBitsToFloat(floatBitsToUint(sqrt(max(abs(m.a2), 1.0))) & 0x7f800000u);
    o.unit = 1.0 / o.scale;
    float unit2 = o.unit * o.unit, a = m.a2 * unit2, e2 = e * e;
    o.k = m.k * unit2 * o.unit;
    o.d = m.d * unit2 * unit2;
    o.l = kd_lattice_of(a, e2 * o.d, 0.25 * e2 * (o.k * o.k + a * o.d));
    return o;
}

struct kd_arc { float g, dg; };

/* g and g' by the series, for |z| up to pi/2. */
kd_arc kd_arc_short(kd_lattice l, float z)
{
    kd_arc o;
    float y = z * z, y2 = y * y;
    float sum = (l.a * (-1.0 / 12.0)) * y +
                y2 * (l.c2 + y * (l.c3 + y * (l.c4 + y * (l.c5 + y * (l.c6 + y * (l.c7 + y * l.c8))))));
    float slope =
        y2 *
        (l.c2 + y * (2.0 * l.c3 +
                     y * (3.0 * l.c4 + y * (4.0 * l.c5 + y * (5.0 * l.c6 + y * (6.0 * l.c7 + y * (7.0 * l.c8)))))));
    float inv = 1.0 / (1.0 + sum), part = sum * inv;
    /* Small corrections to z^2 and 2z, the values that g and g' have where the series is 1. */
    precise float g = y - y * part, turn = z - z * part, dg = turn - turn * (part + slope * inv);
    o.g = g;
    o.dg = 2.0 * dg;
    return o;
}

/* g''. */
float kd_arc_bend(kd_lattice l, float g) { return 2.0 + g * (l.a + g * (1.5 * l.d + g * (2.0 * l.g))); }

/* g and g' at twice the time, by the duplication formula of wp, written for g. */
kd_arc kd_arc_twice(kd_lattice l, kd_arc p)
{
    kd_arc o;
    float m4 = 0.25 * (l.a * l.g - 0.25 * l.d * l.d), g = p.g;
    float m = g * g * (0.5 * l.d + g * (2.0 * l.g + g * m4)), dm = -g * (l.d + g * (6.0 * l.g + g * (4.0 * m4)));
    float part = m / (1.0 - m); /* 1/M - 1, where m = 1 - M */
    precise float square = p.dg * p.dg, twice = square + square * part;
    precise float bend = p.dg * (kd_arc_bend(l, g) - 0.5 * twice * dm), dtwice = bend + bend * part;
    o.g = twice;
    o.dg = dtwice;
    return o;
}

/* A point of the path (a centre): v and v' there, and the numbers for Biermann's formula. */
struct kd_centre {
    float v, dv;
    float f, s, c, d; /* F/2, s, c and v'^2 D/4 */
};

kd_centre kd_centre_of(kd_arcs a, kd_state y)
{
    kd_centre o;
    o.v = y.w;
    o.dv = y.dw;
    float f = y.dw * y.dw;
    o.f = 0.5 * y.w * (a.l.a + y.w * (3.0 * a.k - 2.0 * a.d * y.w));
    o.s = 0.5 * y.w * (a.k - a.d * y.w);
    o.c = f * (0.25 * a.k - 0.5 * a.d * y.w);
    o.d = 0.25 * f * a.d;
    return o;
}

/* v at the time z after the centre, and v at the time z before it. */
vec2 kd_around(kd_centre o, kd_arc z)
{
    float p = 1.0 - z.g * o.s, inv = 1.0 / (p * p + o.d * z.g * z.g);
    float even = z.g * (o.f * p + o.c * z.g), odd = 0.5 * o.dv * z.dg;
    return o.v + vec2(even + odd, even - odd) * inv;
}

/* v and v' at the time z after the centre. */
kd_state kd_ahead(kd_arcs a, kd_centre o, kd_arc z)
{
    kd_state y;
    float p = 1.0 - z.g * o.s, inv = 1.0 / (p * p + o.d * z.g * z.g);
    float step_ = (z.g * (o.f * p + o.c * z.g) + 0.5 * o.dv * z.dg) * inv;
    float rise = 0.5 * o.dv * kd_arc_bend(a.l, z.g) + z.dg * (o.f * (p - z.g * o.s) + 2.0 * o.c * z.g);
    y.w = o.v + step_;
    y.dw = (rise - 2.0 * step_ * z.dg * (o.d * z.g - o.s * p)) * inv;
    return y;
}

#endif
