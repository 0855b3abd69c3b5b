/* Finds the first body that a ray meets (emit/bodies.glsl). Composes its light with everything before it: crossings of
 * the lens map, and volumes by the march.
 *
 * The ray is traced by the steps of ray/escape.glsl. A point of the ray is X = n/w, with n the direction from the hole
 * (in Boyer-Lindquist azimuths) and w = 1/r. For a fixed point c, X - c is parallel to Z = n - w c, and the ray's
 * direction X' is parallel to e = n' w - n w'. e stays finite at infinity and is almost constant where space is flat.
 * So the ray is nearest to c where Z.e changes sign, which happens at most once a step.
 *
 * lavapipe skips work only by leaving a loop. The inner loops take steps, and descend the tree of balls, until each ray
 * of a group is near a body or has no more steps. The outer loop then tests the body closely. This file needs
 * light/march.glsl. */
#ifndef KD_MEET_GLSL
#define KD_MEET_GLSL

/* A body is tested closely if the ray's distance from its ball is less than this times r, plus 0.1 of the ball's radius
 */
#define KD_MEET_SLACK 0.02
#define KD_MEET_FAR 1e30

/* One end of a step. p: (n, w). d: derivative of (n, w), times the length of the step. */
struct kd_met_end { vec4 p, d; };

kd_met_end kd_met_end_of(kd_geodesic m, kd_ray ray, kd_path p, float h, float chi)
{
    kd_phasor t = kd_cos_sin(chi);
    float rate = kd_drag(m, kd_state(p.y.w, p.v.w), ray.e, cam.spin, cam.root, 0.0);
    vec2 n = vec2(p.y.x * t.c - p.y.y * t.s, p.y.x * t.s + p.y.y * t.c),
         v = vec2(p.v.x * t.c - p.v.y * t.s, p.v.x * t.s + p.v.y * t.c);
    return kd_met_end(vec4(n, p.y.zw), h * vec4(v + rate * vec2(-n.y, n.x), p.v.zw));
}

/* A point within the step: the cubic with the values and slopes at both ends. */
kd_met_end kd_met_between(kd_met_end a, kd_met_end b, float t)
{
    vec4 dy = b.p - a.p, c2 = 3.0 * dy - 2.0 * a.d - b.d, c3 = a.d + b.d - 2.0 * dy;
    return kd_met_end(a.p + t * (a.d + t * (c2 + t * c3)), a.d + t * (2.0 * c2 + 3.0 * t * c3));
}

/* True if a step enters a ball. */
bool kd_met_near(kd_met_end a, kd_met_end b, vec4 ball)
{
    vec3 z0 = a.p.xyz - a.p.w * ball.xyz, z1 = b.p.xyz - b.p.w * ball.xyz;
    float in0 = a.p.w * ball.w, in1 = max(b.p.w, 0.0) * ball.w;
    float g0 = dot(z0, a.d.xyz * a.p.w - a.p.xyz * a.d.w), g1 = dot(z1, b.d.xyz * b.p.w - b.p.xyz * b.d.w);
    vec4 p = kd_met_between(a, b, clamp(g0 / min(g0 - g1, -1e-30), 0.0, 1.0)).p;
    vec3 z = p.xyz - p.w * ball.xyz;
    float reach = 1.1 * ball.w * max(p.w, 0.0) + KD_MEET_SLACK;
    return (g0 < 0.0 && g1 >= 0.0 && dot(z, z) < reach * reach) || dot(z0, z0) < in0 * in0 || dot(z1, z1) < in1 * in1;
}

/* A point of a ray in the frame of a body, at the time t' and the distance b. ahead: t' w. off2: (b w)^2. rate: Mino
 * time, in units of the step, per unit of t'. */
struct kd_met_sight { float ahead, off2, rate; };

kd_met_sight kd_met_sight_of(kd_met_end e, vec4 a, vec4 b, vec4 c, vec4 v, float turn)
{
    vec4 p = vec4(e.p.xyz, e.p.w), d = e.d;
    vec3 y = vec3(dot(a, p), dot(b, p), dot(c, p)), f = p.w * vec3(dot(a, d), dot(b, d), dot(c, d)) - d.w * y;
    /* In rotating coordinates light moves along n + turn e_phi. Its length long_ is such that n is a unit vector. */
    float f2 = max(dot(f, f), 1e-36),
          long_ = (-turn * f.z + sqrt(max(turn * turn * f.z * f.z + (1.0 - turn * turn) * f2, 0.0))) / f2;
    vec3 n = -long_ * f;
    n.z -= turn;
    float t = dot(n, y) / max(1.0 + turn * n.z, 1e-3);
    y.z -= turn * t;
    float slow = max(1.0 - dot(v.xyz, n), 1e-6);
    return kd_met_sight(v.w * (t - dot(v.xyz, y)), max(dot(y, y) - t * t, 0.0), long_ * p.w * p.w / (v.w * slow));
}

/* Time within the step at which the ray reaches the surface of a body; above 1 if the ray does not reach it. */
float kd_met_time(kd_met_end a, kd_met_end b, uint body, out float cosine)
{
    vec4 r0 = kd_body_row(body, 0u), r1 = kd_body_row(body, 1u), r2 = kd_body_row(body, 2u), v = kd_body_row(body, 3u),
         own = kd_body_row(body, 4u);
    float size = own.y;
    kd_met_sight s0 = kd_met_sight_of(a, r0, r1, r2, v, own.x), s1 = kd_met_sight_of(b, r0, r1, r2, v, own.x);
    float in0 = size * a.p.w, in1 = size * max(b.p.w, 0.0);
    bool within = s0.ahead * s0.ahead + s0.off2 < in0 * in0, ends_within = s1.ahead * s1.ahead + s1.off2 < in1 * in1;
    bool passes = s0.ahead > 0.0 && (s1.ahead <= 0.0 || b.p.w <= 0.0);
    /* Time at which t' = 0, where the ray is nearest to the centre in the body's frame. */
    float t = passes ? clamp(s0.ahead / max(s0.ahead - s1.ahead, 1e-30), 0.0, 1.0) : 1.0, enters = 2.0, off = 1.0;
    for (int k = 0; k < 3; k++) {
        kd_met_end e = kd_met_between(a, b, t);
        kd_met_sight s = kd_met_sight_of(e, r0, r1, r2, v, own.x);
        float w = max(e.p.w, 1e-12), next = t + s.ahead / w * s.rate;
        off = s.off2 / (w * w * size * size);
        if (k < 2)
            t = passes ? clamp(next, 0.0, 1.0) : t;
        else
            enters = next - size * sqrt(max(1.0 - off, 0.0)) * s.rate;
    }
    bool meets = (passes || ends_within) && off < 1.0 && enters <= 1.0;
    /* One more iteration from the surface just found, because the ray's position and direction there differ from those
     * assumed. */
    t = clamp(enters, 0.0, 1.0);
    kd_met_end e = kd_met_between(a, b, t);
    kd_met_sight s = kd_met_sight_of(e, r0, r1, r2, v, own.x);
    float w = max(e.p.w, 1e-12), off1 = s.off2 / (w * w * size * size);
    t = clamp(t + (s.ahead / w - size * sqrt(max(1.0 - off1, 0.0))) * s.rate, 0.0, 1.0);
    cosine = within ? 1.0 : sqrt(max(1.0 - off, 0.0));
    return within ? 0.0 : meets ? t : 2.0;
}

kd_met kd_met_nothing() { return kd_met(KD_MEET_FAR, KD_NOBODY, ORDERS, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0); }

/* The node that follows the subtree of `node`. The search continues there if the ray is far from `node`. 0 if there is
 * none. */
uint kd_met_next(uint node)
{
    uint next = (node + 1u) >> uint(findLSB(node + 1u));
    return next == 1u ? 0u : next;
}

/* True if the search of this ray is incomplete, because a driver ended a loop early. Thousands of overlapping bodies
 * exceed lavapipe's limit. */
bool kd_meet_lost = false;

/* A step covers at most half the way to the horizon, where azimuths diverge, until 1/r is this fraction of the
 * horizon's 1/r */
#define KD_MEET_CLOSE 0.995

kd_met kd_meet(uvec2 place)
{
    kd_ray ray = kd_camera_ray(place.x, place.y);
    kd_geodesic m = kd_geodesic_of(ray, KD_HOLE_OF(cam), cam.u, cam.s);
    kd_path p = kd_path_start(ray, cam.u, cam.s), q = p;
    float rate2 = max(ray.l * ray.l + ray.p * ray.p, ray.e * ray.e), h = 0.0, begun = 0.0,
          near_horizon = 0.97 * cam.horizon;
    float side = cam.u < 0.0 || (cam.u == 0.0 && ray.p < 0.0) ? -1.0 : 1.0;
    kd_march_drag drag = kd_march_drag_of(m, ray);
    kd_met met = kd_met_nothing();
    kd_met_end a, b;
    vec4 all = vec4(emission.bodies.x, emission.bodies.y, emission.bodies.z, emission.bodies.reach);
    float out_ = emission.bodies.least, out2 = out_ * out_;
    bool goes = (ray.w >= out_ || ray.e * ray.e + out2 * (m.a2 + out_ * (2.0 * m.k - out_ * m.d)) > 0.0) &&
                !(INGOING && !kd_from_outside(m, ray.w, ray.e, cam.spin, cam.horizon)),
         first = true;
    uint crossed = 0u, node = 0u, taken = 0u,
         /* the first child of the root, or the root itself if it is a leaf; the root's ball was tested already */
        top = emission.bodies.leaves > 1u ? 2u : 1u;
    b = kd_met_end_of(m, ray, p, 1.0,
                      INGOING ? drag.chi + drag.fallen + drag.way * kd_drag_fall(p.y.w, cam.spin, cam.root) : drag.chi);
    for (;;) {
        uint leaf = 0u;
        while (leaf == 0u && (goes || node != 0u)) {
            while (goes && node == 0u) { /* takes steps until a step comes near bodies */
                bool passed = q.y.z * side < 0.0;
                side = passed ? -side : side;
                crossed += passed ? 1u : 0u;
                begun += h;
                p = q;
                float was = h;
                h = KD_PI / (float(STEPS) * sqrt(INGOING ? rate2 + 6.0 * m.k * p.y.w : rate2));
                /* azimuths diverge at the horizon, so the ray first steps to a point before it */
                if (p.v.w > 0.0 && p.y.w < near_horizon)
                    h = min(h, max((near_horizon - p.y.w) / p.v.w, 0.2 * h));
                /* then each step covers half the remaining way to the horizon */
                else if (p.v.w > 0.0 && p.y.w < KD_MEET_CLOSE * cam.horizon)
                    h = min(h, 0.5 * (cam.horizon - p.y.w) / p.v.w);
                q = kd_path_step(m, p, h);
                if (INGOING && q.y.w > cam.horizon && q.v.w < 0.0)
                    q.v.w = kd_leaving(m, q.y.w, ray.e);
                kd_stride s = kd_stride_of(m, ray, p, q, h, drag);
                float chi =
                    INGOING ? drag.chi + drag.fallen + drag.way * kd_drag_fall(q.y.w, cam.spin, cam.root) : drag.chi;
                a = kd_met_end(b.p, (first ? h : h / was) * b.d);
                b = kd_met_end_of(m, ray, q, h, chi);
                first = false;
                taken++;
                bool outside = p.y.w < cam.horizon && q.y.w < cam.horizon && kd_is_finite(q.y.w);
                bool falls = q.y.w >= cam.horizon && (!INGOING || q.v.w > 0.0);
                bool gone = q.v.w < 0.0 && q.y.w < out_ && (q.y.w <= 0.0 || kd_path_pull(m, q.y).w <= 0.0);
                goes = !falls && !gone && kd_is_finite(q.y.w) && taken < 16u * STEPS;
                node = outside && kd_met_near(a, b, all) ? top : 0u;
            }
            while (node != 0u && leaf == 0u) {
                bool near = kd_met_near(a, b, kd_bodies_node(node)), one = node >= emission.bodies.leaves;
                leaf = near && one ? node : 0u;
                node = near && !one ? 2u * node : kd_met_next(node);
            }
            /* stops after a body was met, because later steps are behind it */
            goes = goes && !(leaf == 0u && met.body != KD_NOBODY);
        }
        if (leaf == 0u)
            break;
        uint body = leaf - emission.bodies.leaves;
        float cosine, t = kd_met_time(a, b, body, cosine), time = begun + t * h;
        if (t <= 1.0 && time < met.time) {
            kd_met_end e = kd_met_between(a, b, t);
            float per = 1.0 / h;
            met = kd_met(time, body, crossed + (q.y.z * side < 0.0 && e.p.z * side < 0.0 ? 1u : 0u), max(e.p.w, 1e-12),
                         e.p.z, -kd_atan2(e.p.y, e.p.x), per * e.d.w, per * e.d.z, ray.e, m.momentum, cosine);
        }
        if (node == 0u && met.body != KD_NOBODY) /* stops after a body was met, because later steps are behind it */
            break;
    }
    kd_meet_lost = node != 0u || (goes && met.body == KD_NOBODY);
    return met;
}

/* Follows one ray, without light from its end. */
void kd_follow(inout kd_beam beam, uvec2 place, uint at)
{
    kd_met met = kd_met_nothing();
    if (KD_MEETS)
        met = kd_meet(place);
    if (KD_MEETS && kd_meet_lost) {
        KD_MARCH_GIVEN_UP(beam);
        beam.through = 0.0;
        return;
    }
    if (KD_MARCHES)
        kd_march_follow(beam, place, at, met.time, met.crossed);
    if (KD_MARCH_WAITS)
        return;
    for (uint n = 0u; !KD_MARCHES && KD_GLOWS && n < min(ORDERS, met.crossed) && beam.through > 0.0; n++) {
        float w = lens[at + n * slice.stride];
        if (w == 0.0)
            break;
        KD_MARCH_MEET(beam, w, n, place, at);
    }
    if (KD_MEETS && met.body != KD_NOBODY)
        kd_beam_met(beam, met);
}

#endif
