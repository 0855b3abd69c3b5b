/* Functions of the metric at a place, for kernels of light. `cam` holds the parameters of the hole. */
#ifndef KD_METRIC_GLSL
#define KD_METRIC_GLSL

#include "ray/hole.glsl"

/* Numbers of the metric at a place. aw2: a^2 w^2. delta: Delta/r^2, at least 1e-30. area: A/r^4. sigma: Sigma/r^2.
 * omega: angular velocity of an observer of zero angular momentum (Bardeen, Press & Teukolsky 1972, with 2r - q^2 for
 * 2r). The square of that observer's lapse is sigma delta / area. In the functions, u is the cosine of the polar angle,
 * and s2 the square of its sine. */
struct kd_place { float aw2, delta, area, sigma, omega; };
kd_place kd_place_at(float w, float u, float s2)
{
    float a = cam.spin, aw2 = a * a * w * w, b = 1.0 + aw2, delta = kd_horizons(w, cam.root);
    float area = b * b - aw2 * delta * s2, drag = 2.0 * a * w * w * w;
    if (BEYOND_KERR)
        drag -= a * cam.charge2 * w * w * w * w;
    return kd_place(aw2, delta, area, 1.0 + aw2 * u * u, drag / area);
}

/* kd_mass: the mass term of the metric, 2r - q^2. The next function: this term divided by r^2. */
float kd_mass(float r)
{
    float mass = 2.0 * r;
    if (BEYOND_KERR)
        mass -= cam.charge2;
    return mass;
}
float kd_mass_term(float w)
{
    float term = 2.0 * w;
    if (BEYOND_KERR)
        term -= cam.charge2 * w * w;
    return term;
}

/* Integral from 0 to w of (2 - q^2) dw/D, with D = Delta/r^2: the term of the time that grows without bound at the
 * horizon. */
float kd_late(float w)
{
    float part = 2.0;
    if (BEYOND_KERR)
        part -= cam.charge2;
    return part * kd_fall(w, cam.root);
}

/* Coefficient of r^2 in (Sigma u^r)^2 of a body of unit mass. moving: this coefficient in the Kerr metric, a^2 (E^2 -
 * 1) - L^2 - Q. A charge q of the hole subtracts q^2 from it. */
float kd_body_quadratic(float moving)
{
    float c2 = moving;
    if (BEYOND_KERR)
        c2 -= cam.charge2;
    return c2;
}

/* The circular orbit at w = 1/r. all: 1/Omega of the orbit. rest: P^2 r^(1/2)/s^2. From both, 1/u^t is r^(3/4)
 * sqrt(rest) / all (orbit.glsl). one_minus_a: 1 - a in full precision.
 *
 * With x = sqrt(r), 1 - 3/r + 2a r^-3/2 = ((x - 1)^2 (x + 2) - 2 (1 - a)) / x^3. The right-hand side is used, because
 * the left-hand side loses all digits near the ISCO of a hole that spins fast. */
struct kd_circle { float all, rest; };
kd_circle kd_circle_at(float w, float one_minus_a)
{
    float r = 1.0 / w, x = sqrt(r), x3 = r * x, d = (1.0 - w) / (w * (x + 1.0)), all = x3 + cam.spin;
    precise float rest = d * d * (x + 2.0) - 2.0 * one_minus_a;
    if (BEYOND_KERR) {
        float n = cam.root * cam.root, y = (1.0 - w) / w, s = sqrt(r - cam.charge2),
              sigma = cam.spin > 0.0 ? (y + n) / (s + cam.spin) : s - cam.spin, v = sigma * w;
        all = r * r / s + cam.spin;
        rest = (kd_delta(w, cam.root) - v * v) * r * r * x / (s * s);
    }
    return kd_circle(all, rest);
}

/* sqrt(r - q^2), on which the velocities of circular orbits depend (src/physics/spacetime/kerr.h). */
float kd_circle_root(float w) { return BEYOND_KERR ? sqrt(1.0 / w - cam.charge2) : inversesqrt(w); }

/* 1/Omega of the circular orbit at r, which is beyond the ISCO (src/physics/spacetime/kerr.h). */
float kd_circle_time(float r)
{
    float time = r * sqrt(r) + cam.spin;
    if (BEYOND_KERR)
        time = r * r * inversesqrt(r - cam.charge2) + cam.spin;
    return time;
}

#endif
