/* Follows a ray from a known point of its path to infinity or to the horizon, with the direction as a unit vector n =
 * (sin theta cos psi, sin theta sin psi, cos theta), which is regular at the poles:
 *   n'' = e u z - (Q + L^2 + 2 e u^2) n,   n.n = 1,   |n'|^2 = Q + L^2 + e u^2,   (n x n')_z = L,   e = a^2 E^2.
 * Needs camera.glsl and the specialisation constants STEPS and INGOING. */
#ifndef KD_ESCAPE_GLSL
#define KD_ESCAPE_GLSL

#include "shared/math.glsl"
#include "ray/nystroem.glsl"
#include "ray/trace.glsl"

struct kd_path {
    vec4 y, v; /* (n, w) and its derivative */
    float chi;
};

struct kd_escape { float u, phi, fate; }; /* end of a ray: u = cos(theta), azimuth phi = psi + chi, and fate */

kd_path kd_path_start(kd_ray ray, float u, float s)
{
    kd_path o;
    o.y = vec4(s, 0.0, u, ray.w);
    o.v = vec4(-u * ray.p, ray.l, s * ray.p, ray.dw); /* L / sin(theta), which is l, is finite on the axis */
    o.chi = 0.0;
    return o;
}

/* The path that starts on the plane with |u'| = sqrt(Q). side: 1 if the ray leaves the plane upwards, -1 if downwards.
 */
kd_path kd_path_crossing(kd_geodesic m, kd_state y, float psi, float chi, float side)
{
    kd_path o;
    kd_phasor t = kd_cos_sin(psi);
    o.y = vec4(t.c, t.s, 0.0, y.w);
    o.v = vec4(-m.momentum * t.s, m.momentum * t.c, side * sqrt(max(m.q, 0.0)), y.dw);
    o.chi = chi;
    return o;
}

vec4 kd_path_pull(kd_geodesic m, vec4 y)
{
    float e = m.energy2, u = y.z, w = y.w;
    vec4 f = -(m.q + m.momentum * m.momentum + 2.0 * e * u * u) * y;
    f.z += e * u;
    f.w = w * (m.a2 + w * (3.0 * m.k - 2.0 * m.d * w));
    return f;
}

kd_path kd_path_step(kd_geodesic m, kd_path p, float h)
{
    kd_path o;
    KD_NYSTROEM_STEP(vec4, kd_path_pull, m, p.y, p.v, h, o.y, o.v)
    o.chi = p.chi;
    return o;
}

/* Frame dragging over one step by Simpson's rule. The midpoint comes from the quintic that fits w, w' and w'' at both
 * ends. */
float kd_path_drag(kd_geodesic m, kd_ray ray, kd_path p, kd_path q, float h)
{
    kd_state a, b, c;
    a.w = p.y.w;
    b.w = 0.5 * (p.y.w + q.y.w) + h * (5.0 / 32.0) * (p.v.w - q.v.w) +
          h * h * (1.0 / 64.0) * (kd_path_pull(m, p.y).w + kd_path_pull(m, q.y).w);
    c.w = q.y.w;
    a.dw = p.v.w;
    c.dw = q.v.w;
    b.dw = -sqrt(max(kd_radial_potential(m, b.w, ray.e, cam.spin, cam.root), 0.0));
    /* uses the midpoint, if the ray still moves inwards there */
    if (INGOING && 1.5 * (c.w - a.w) > 0.25 * h * (a.dw + c.dw))
        b.dw = -b.dw;
    if (INGOING) /* for INGOING, the azimuth of an outgoing ray is ingoing from the start and has no pole here */
        return h * (1.0 / 6.0) *
               (kd_drag_ingoing(m, a, ray.e, cam.spin, cam.root, -1.0) +
                4.0 * kd_drag_ingoing(m, b, ray.e, cam.spin, cam.root, -1.0) +
                kd_drag_ingoing(m, c, ray.e, cam.spin, cam.root, -1.0));
    float way = a.dw < 0.0 && c.dw < 0.0 ? -1.0 : 0.0; /* a ray that turns twice does not escape */
    float pole = way * (kd_drag_fall(c.w, cam.spin, cam.root) - kd_drag_fall(a.w, cam.spin, cam.root));
    return pole +
           h * (1.0 / 6.0) *
               (kd_drag(m, a, ray.e, cam.spin, cam.root, way) + 4.0 * kd_drag(m, b, ray.e, cam.spin, cam.root, way) +
                kd_drag(m, c, ray.e, cam.spin, cam.root, way));
}

/* w' of an outgoing ray, from the first integral. Inside the horizon w' may be large. An integrated w' would carry its
 * rounding error from there to the outside. */
float kd_leaving(kd_geodesic m, float w, float e) { return -sqrt(kd_radial_potential(m, w, e, cam.spin, cam.root)); }

kd_escape kd_path_escape(kd_geodesic m, kd_ray ray, kd_path p)
{
    kd_escape o;
    o.fate = KD_FATE_UNDECIDED;
    o.u = 0.0;
    o.phi = 0.0;
    /* Steps are as short as between crossings. They are also limited to 1/E, for a ray that is nearly radial, and to
     * 1/sqrt(6K w), for a ray deep inside the hole. */
    float rate2 = max(ray.l * ray.l + ray.p * ray.p, ray.e * ray.e);
    float h = KD_PI / (float(STEPS) * sqrt(rate2));
    /* The loop covers twelve half periods. Rays that circle longer are within 1e-13 of the critical curve.
     */
    for (uint i = 0; i < 12 * STEPS; i++) {
        if (INGOING)
            h = KD_PI / (float(STEPS) * sqrt(rate2 + 6.0 * m.k * p.y.w));
        kd_path q = kd_path_step(m, p, h);
        if (INGOING && q.y.w > cam.horizon && q.v.w < 0.0)
            q.v.w = kd_leaving(m, q.y.w, ray.e);
        if ((q.y.w >= cam.horizon && (!INGOING || q.v.w > 0.0)) || !kd_is_finite(q.y.w)) {
            o.fate = KD_FATE_CAPTURED;
            KD_TRACE_STEP(KD_TRACE_END, h, q.y, q.v, p.chi);
            break;
        }
        if (q.y.w < 0.0) {
            /* Newton's method finds the zero of the cubic through both ends of the step. Then one step goes to that
             * zero. */
            float s = p.y.w / (p.y.w - q.y.w), d0 = h * p.v.w, d1 = h * q.v.w, dy = q.y.w - p.y.w;
            float c2 = 3.0 * dy - 2.0 * d0 - d1, c3 = d0 + d1 - 2.0 * dy;
            for (int k = 0; k < 4; k++) {
                float f = p.y.w + s * (d0 + s * (c2 + s * c3)), df = d0 + s * (2.0 * c2 + 3.0 * s * c3);
                s = clamp(s - f / (df < 0.0 ? df : -1.0), 0.0, 1.0);
            }
            q = kd_path_step(m, p, s * h);
            vec3 n = q.y.xyz - q.v.xyz * (q.y.w / q.v.w);
            o.phi = kd_atan2(n.y, n.x) + p.chi + kd_path_drag(m, ray, p, q, s * h);
            /* the step ends near w = 0, not exactly at w = 0, so the ingoing azimuth still differs from its value at
             * infinity */
            if (INGOING)
                o.phi -= kd_drag_fall(q.y.w, cam.spin, cam.root);
            o.u = n.z * inversesqrt(dot(n, n));
            o.fate = KD_FATE_ESCAPED;
            KD_TRACE_STEP(KD_TRACE_END, s * h, q.y, q.v, p.chi);
            break;
        }
        q.chi = p.chi + kd_path_drag(m, ray, p, q, h);
        p = q;
        KD_TRACE_STEP(KD_TRACE_END, h, p.y, p.v, p.chi);
    }
    return o;
}

#endif
