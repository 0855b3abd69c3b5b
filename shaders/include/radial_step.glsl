/* The radial motion w'' = A w + 3K w^2 - 2D w^3, a step at a time, and the azimuth by which the hole drags a ray. */
#ifndef KD_RADIAL_STEP_GLSL
#define KD_RADIAL_STEP_GLSL

#include "math.glsl"
#include "nystroem.glsl"

struct kd_state { float w, dw; };

float kd_pull(kd_motion m, float w) { return w * (m.a2 + w * (3.0 * m.k - 2.0 * m.d * w)); }

kd_state kd_radial_step(kd_motion m, kd_state y, float h)
{
    kd_state o;
    KD_NYSTROEM_STEP(float, kd_pull, m, y.w, y.dw, h, o.w, o.dw)
    return o;
}

/* The azimuth chi by which the hole drags a ray, chi' = a (2 E w - a L w^2) / ((1 - r+ w)(1 - r- w)).
 *
 * On the way into the horizon chi' diverges as 1/(1 - r+ w), and its quadrature with it. What a falling ray leaves regular is
 * the azimuth of ingoing Kerr-Schild coordinates: less a w' over the same denominator, whose integral is elementary and
 * is put back by kd_drag_fall. falling: 1 for a ray that goes straight in, else 0. */
float kd_drag(kd_motion m, kd_state y, float e, float a, float r_plus, float r_minus, float falling)
{
    return a * (y.w * (2.0 * e - a * m.momentum * y.w) - falling * y.dw) /
           ((1.0 - r_plus * y.w) * (1.0 - r_minus * y.w));
}

/* Integral from 0 to w of a dw / ((1 - r+ w)(1 - r- w)) = a/(r+ - r-) log(1 + x), x = (r+ - r-) w / (1 - r+ w); by its
 * series where x is small, as for a hole that is nearly extremal. */
float kd_drag_fall(float w, float a, float r_plus, float r_minus)
{
    float first = w / (1.0 - r_plus * w), x = (r_plus - r_minus) * first, y = x / (2.0 + x), y2 = y * y;
    float series = 2.0 * (1.0 + y2 * ((1.0 / 3.0) + y2 * ((1.0 / 5.0) + y2 * (1.0 / 7.0)))) / (2.0 + x);
    return a * first * (x < 0.25 ? series : kd_log(1.0 + x) / x);
}

/* Whether a ray at w, falling (dw > 0), meets no turning point before the horizon: radial_closed.glsl has the argument. */
bool kd_falls_in(kd_motion m, kd_state y, float e, float horizon)
{
    float disc = sqrt(max(9.0 * m.k * m.k + 8.0 * m.d * m.a2, 0.0));
    float wm = -2.0 * m.a2 / (3.0 * m.k + disc);
    float rm = e * e + wm * wm * (m.a2 + wm * (2.0 * m.k - m.d * wm));
    return y.dw > 0.0 && (m.a2 >= 0.0 || wm >= horizon || y.w > wm || rm > 0.0);
}

#endif
