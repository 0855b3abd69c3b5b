/* Functions of the hole, as in src/physics/spacetime/hole.h: Delta, the mass term, the numbers in the equations of
 * light, and the terms of azimuth and time that grow without bound at the horizon for a ray that falls in. Kernels that
 * have `cam` find further functions in ray/metric.glsl. */
#ifndef KD_HOLE_GLSL
#define KD_HOLE_GLSL

#include "shared/math.glsl"

/* The numbers of the hole on which the equations of light depend, taken from a block that has them. */
struct kd_hole_numbers { float spin, charge2; };
#define KD_HOLE_OF(block) kd_hole_numbers(block.spin, block.charge2)

/* Delta/r^2 = 1 - 2w + (a^2 + q^2) w^2, computed as a product of two factors with root = sqrt(1 - a^2 - q^2). Near the
 * horizon of a hole that spins fast, 1 - w is exact. So the factors keep their precision where the horizons almost
 * coincide. `precise` stops a driver from multiplying the product out, which would lose that precision. */
float kd_delta(float w, float root)
{
    precise float d = 1.0 - w, h = root * w, delta = (d - h) * (d + h);
    return delta;
}

/* Delta/r^2 with a positive lower bound, for use as a divisor. */
float kd_horizons(float w, float root) { return max(kd_delta(w, root), 1e-30); }

/* The numerator of the part of dt/dtau that has the divisor D (rays.comp), for E = 1. */
float kd_time_over(kd_hole_numbers hole, float w, float momentum)
{
    float a = hole.spin, a2w2 = a * a * w * w;
    return 4.0 + a * a * (1.0 - 2.0 * w + a2w2) - a * momentum * (1.0 + a2w2) - hole.charge2 * (1.0 + 2.0 * w);
}

/* Numbers that depend on the charge. kd_quartic_of: D = a^2 Q + q^2 K, of the radial quartic. kd_drag_of: a L + q^2 E,
 * of the rate of azimuth (kerr_ray.glsl). */
float kd_quartic_of(kd_hole_numbers hole, float carter, float k)
{
    return hole.spin * hole.spin * carter + hole.charge2 * k;
}
float kd_drag_of(kd_hole_numbers hole, float momentum, float energy)
{
    return hole.spin * momentum + hole.charge2 * energy;
}

/* Integral from 0 to w of dw/D. It is log(1 + x)/(2 root) with x = 2 root w / (1 - r+ w). A series replaces the
 * logarithm where x is small, as for a nearly extremal hole. */
float kd_fall(float w, float root)
{
    precise float gap = 1.0 - w - root * w;
    float first = w / max(gap, 1e-30), x = 2.0 * root * first, y = x / (2.0 + x), y2 = y * y;
#ifdef KD_DOUBLE
    float series = 0.0;
    for (int k = 8; k >= 0; k--)
        series = series * y2 + 1.0 / float(2 * k + 1);
#else
    float series = 1.0 + y2 * ((1.0 / 3.0) + y2 * ((1.0 / 5.0) + y2 * (1.0 / 7.0)));
#endif
    return first * (x < 0.25 ? 2.0 * series / (2.0 + x) : kd_log(1.0 + x) / x);
}

/* Integral from 0 to w of (2 - q^2) dw/D: the term of the time that grows without bound at the horizon. */
float kd_late_of(kd_hole_numbers hole, float w, float root) { return (2.0 - hole.charge2) * kd_fall(w, root); }

#endif
