/* This is what azimuth and time of a ray that falls grow by without bound at the horizon. */
#ifndef KD_FALL_GLSL
#define KD_FALL_GLSL

#include "shared/math.glsl"

/* This is Delta/r^2 = 1 - 2w + a^2 w^2 from root = sqrt(1 - a^2): 1 - w is exact near the horizon of a fast hole,
 * and the two factors keep their digits where the horizons all but meet. Precise: multiplied out, as a driver may,
 * they would have lost them. */
float kd_delta(float w, float root)
{
    precise float d = 1.0 - w, h = root * w, delta = (d - h) * (d + h);
    return delta;
}

/* This is Delta/r^2, with a floor so that it can be divided by. */
float kd_horizons(float w, float root) { return max(kd_delta(w, root), 1e-30); }

/* This is the integral from 0 to w of dw / D = 1/(2 root) log(1 + x), x = 2 root w / (1 - r+ w); by its series where
 * x is small, as for a hole that is nearly extremal. */
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
