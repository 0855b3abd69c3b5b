/* The terms of azimuth and time that grow without bound at the horizon for a ray that falls in. */
#ifndef KD_FALL_GLSL
#define KD_FALL_GLSL

#include "shared/math.glsl"

/* Delta/r^2 = 1 - 2w + (a^2 + q^2) w^2 from root = sqrt(1 - a^2 - q^2). 1 - w is exact near the horizon of a hole that
 * spins fast, and the two factors keep their precision where the horizons almost coincide. `precise` stops a driver
 * from multiplying the product out, which would lose that precision. */
float kd_delta(float w, float root)
{
    precise float d = 1.0 - w, h = root * w, delta = (d - h) * (d + h);
    return delta;
}

/* Delta/r^2, with a positive lower bound so that it can be divided by. */
float kd_horizons(float w, float root) { return max(kd_delta(w, root), 1e-30); }

/* Integral from 0 to w of dw / D = 1/(2 root) log(1 + x), x = 2 root w / (1 - r+ w). A series is used where x is small,
 * as for a nearly extremal hole. */
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

#endif
