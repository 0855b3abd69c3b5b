/* Computes the end of a ray that escapes: the time at which w vanishes, and the direction of the ray at that time. */
#ifndef KD_ARC_ESCAPE_GLSL
#define KD_ARC_ESCAPE_GLSL

#include "ray/arc.glsl"
#include "ray/polar_azimuth.glsl"

/* g for the time from a point to w = 0, by Biermann's formula with v = 0 at the other end. The result is large if the
 * ray moves inwards at the point. */
float kd_arc_to_infinity(kd_state y, float e) { return y.dw < 0.0 ? 2.0 * y.w * y.w / (e * (e - y.dw)) : 1e30; }

/* The time that belongs to a value of g, to second order in g. */
float kd_arc_time(kd_lattice l, float g)
{
    return sqrt(g) * (1.0 + g * (l.a * (-1.0 / 24.0) + g * (l.a * l.a * (3.0 / 640.0) - l.d * (1.0 / 40.0))));
}

/* Scaled time from `last` to infinity, for a ray that reaches infinity before `next`. z: time from `last` to `next`;
 * middle: the arc of z/2. The function first uses the closest of three points to infinity (`last`, the middle, `next`),
 * which gives the time to 1e-3. Then the value of w at that time gives the correction. A linear correction is enough,
 * because w'' = 0 at w = 0. */
float kd_arc_escape_time(kd_arcs a, kd_centre last, kd_arc middle, kd_state next, float z, float e)
{
    /* points later than this are beyond infinity, and have no meaning */
    float most = last.dv < 0.0 ? 4.0 * last.v / min(e, -last.dv) : 1e30;
    kd_state y, half_ = kd_ahead(a, last, middle);
    y.w = last.v;
    y.dw = last.dv;
    float g = kd_arc_to_infinity(y, e), t = 0.0;
    float gh = kd_arc_to_infinity(half_, e), gn = kd_arc_to_infinity(next, e);
    if (gh < g && 0.5 * z < most) {
        g = gh;
        t = 0.5 * z;
        y = half_;
    }
    if (gn < g && z < most) {
        g = gn;
        t = z;
        y = next;
    }
    float way = kd_arc_time(a.l, g);
    way = y.w < 0.0 ? -way : way;
    kd_centre c = kd_centre_of(a, y);
    float left = kd_around(c, kd_arc_short(a.l, way)).x;
    return t + (way + left / e);
}

struct kd_direction { float u, psi; };

/* Direction of a ray at the time `time` after it crossed the plane upwards. psi counts from the crossing. */
kd_direction kd_arc_direction(kd_geodesic m, kd_arcs a, kd_azimuth azimuth, float time)
{
    kd_direction o;
    float unit2 = a.unit * a.unit, d = m.energy2 * unit2 * (max(m.q, 0.0) * unit2);
    /* lattice of the polar motion, u'^2 = Q + A u^2 - e u^4 */
    kd_lattice l = kd_lattice_of(a.l.a, d, 0.25 * a.l.a * d);
    kd_arc z = kd_arc_twice(l, kd_arc_short(l, 0.5 * time * a.scale));
    /* rise, du: u and u' divided by sqrt(Q), because Q may be 0. */
    float inv = 1.0 / (1.0 + 0.25 * d * z.g * z.g), rise = 0.5 * z.dg * inv;
    float u = rise * a.unit, du = (0.5 * kd_arc_bend(l, z.g) - 0.5 * rise * d * z.g * z.dg) * inv;
    float root_q = sqrt(max(m.q, 0.0));
    o.u = clamp(u * root_q, -1.0, 1.0);
    float root = sqrt(azimuth.b + m.energy2 * o.u * o.u);
    du /= root;
    u = max(u, 0.0);
    float ty = u * abs(m.momentum) / azimuth.root_c;
    o.psi = kd_azimuth_part(azimuth, u, du, du, ty);
    if (azimuth.uneven)
        o.psi = azimuth.side * kd_angle_upper(du, ty) + kd_azimuth_smooth(m, azimuth.b, 0.0, root_q, time);
    return o;
}

vec3 kd_direction_pull(kd_geodesic m, vec3 n)
{
    vec3 f = -(m.q + m.momentum * m.momentum + 2.0 * m.energy2 * n.z * n.z) * n;
    f.z += m.energy2 * n.z;
    return f;
}

/* Direction of a ray that escapes soon after its start, with psi counted from the start. The function takes four steps
 * of the vector equation of escape.glsl. The error of a step of a quarter radian is below the rounding of a float. The
 * function is also used for rays with an impact parameter below a that never meet the plane: such rays escape soon if
 * they start outside the photon orbits. */
kd_direction kd_arc_direction_soon(kd_geodesic m, kd_ray ray, float u, float s, float time)
{
    vec3 n = vec3(s, 0.0, u), v = vec3(-u * ray.p, ray.l, s * ray.p);
    float h = 0.25 * time;
    for (int k = 0; k < 4; k++) {
        vec3 next, dnext;
        KD_NYSTROEM_STEP(vec3, kd_direction_pull, m, n, v, h, next, dnext)
        n = next;
        v = dnext;
    }
    kd_direction o;
    o.u = n.z * inversesqrt(dot(n, n));
    o.psi = kd_atan2(n.y, n.x);
    return o;
}

#endif
