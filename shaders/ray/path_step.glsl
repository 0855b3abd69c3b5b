/* A step of the ray with all values that decide whether a crossing is certain: w, u, and the variation v, which is the
 * derivative of w by its slope at the start:
 *   w'' = A w + 3K w^2 - 2D w^3,   u'' = A u - 2 e u^3,   v'' = (A + 6K w - 6D w^2) v,   v(0) = 0, v'(0) = 1. */
#ifndef KD_PATH_STEP_GLSL
#define KD_PATH_STEP_GLSL

#include "ray/nystroem.glsl"

struct kd_full { vec3 y, dy; }; /* y is (w, u, v), and dy its derivative */

vec3 kd_full_pull(kd_geodesic m, vec3 y)
{
    float w = y.x, u = y.y;
    return vec3(w * (m.a2 + w * (3.0 * m.k - 2.0 * m.d * w)), u * (m.a2 - 2.0 * m.energy2 * u * u),
                y.z * (m.a2 + w * (6.0 * m.k - 6.0 * m.d * w)));
}

kd_full kd_full_step(kd_geodesic m, kd_full p, float h)
{
    kd_full o;
    KD_NYSTROEM_STEP(vec3, kd_full_pull, m, p.y, p.dy, h, o.y, o.dy)
    return o;
}

#endif
