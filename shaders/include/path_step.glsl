/* A step of the ray with all that a crossing is judged by: w, u, and the variation v of w with the strength of its start,
 *   w'' = A w + 3K w^2 - 2D w^3,   u'' = A u - 2 e u^3,   v'' = (A + 6K w - 6D w^2) v,   v(0) = 0, v'(0) = 1.
 * Albrecht's method, as in radial_step.glsl. */
#ifndef KD_PATH_STEP_GLSL
#define KD_PATH_STEP_GLSL

struct kd_full { vec3 y, dy; }; /* (w, u, v) */

vec3 kd_full_pull(kd_motion m, vec3 y)
{
    float w = y.x, u = y.y;
    return vec3(w * (m.a2 + w * (3.0 * m.k - 2.0 * m.d * w)), u * (m.a2 - 2.0 * m.energy2 * u * u),
                y.z * (m.a2 + w * (6.0 * m.k - 6.0 * m.d * w)));
}

kd_full kd_full_step(kd_motion m, kd_full p, float h)
{
    float h2 = h * h;
    vec3 hv = h * p.dy;
    vec3 k1 = kd_full_pull(m, p.y);
    vec3 k2 = kd_full_pull(m, p.y + 0.25 * hv + h2 * (1.0 / 32.0) * k1);
    vec3 k3 = kd_full_pull(m, p.y + 0.5 * hv + h2 * (1.0 / 24.0) * (4.0 * k2 - k1));
    vec3 k4 = kd_full_pull(m, p.y + 0.75 * hv + h2 * (1.0 / 32.0) * (3.0 * k1 + 4.0 * k2 + 2.0 * k3));
    vec3 k5 = kd_full_pull(m, p.y + hv + h2 * (1.0 / 14.0) * (6.0 * k2 - k3 + 2.0 * k4));
    kd_full o;
    o.y = p.y + (hv + h2 * (1.0 / 90.0) * (7.0 * k1 + 24.0 * k2 + 6.0 * k3 + 8.0 * k4));
    o.dy = p.dy + h * (1.0 / 90.0) * (7.0 * (k1 + k5) + 32.0 * (k2 + k4) + 12.0 * k3);
    return o;
}

#endif
