/* Kernel: finds the end points of listed rays by integration in Mino time. It is written in single precision, and
 * shaders/to_double.py converts it to double.
 *
 * As in lens_map.comp, each half period is STEPS steps that end on the crossing. Here u is integrated together with w,
 * because the smooth parts of azimuth and delay need u. A second integration of w with half the steps gives the error
 * of the steps. The variation of w with its start gives the error of rounding. An embedded pair would be cheaper, but
 * its estimate is a hundred times looser (docs/rays.md).
 *
 * The azimuth is psi + chi. psi' = L/(1 - u^2) has a peak near the axis, which polar_azimuth.glsl integrates exactly.
 * The rest of psi' is L e / (sqrt(c) (sqrt(y) + sqrt(c))), with y = b + e u^2 and c = b + e.
 *
 * The delay t has the derivative t' = E/w^2 + 2E/w + [E (4 + a^2 - 2a^2 w + a^4 w^2 - q^2 (1 + 2w)) - a L (1 + a^2
 * w^2)] / Delta_w + a (L - a E (1 - u^2)), Delta_w = 1 - 2w + (a^2 + q^2) w^2. The first two terms grow without bound
 * towards infinity, at both ends of the ray. They can be written as derivatives and smooth terms:
 *
 *   E^2/w^2 = (-w'/w)' + K w - D w^2   and   E/w = -(ln((E + w')/w))' + w^2 (K - D w)/(E + w'),
 *
 * The remaining integrand is smooth. For an observer at infinity, r_o + 2 ln r_o is subtracted exactly.
 *
 * t' has a pole at the horizon. A ray that falls in therefore uses ingoing time: with D = Delta_w and W as in
 * radial_step.glsl
 *
 *   t' = (1 + a^2 w^2) (w'/(w^2 D) + K/(W + w')) + a (L - a E (1 - u^2)),
 *
 * The part of the first term with w' is d/dtau of -1/w + ln(w^2/D) + (2 - q^2) kd_fall, and the rest has no pole. A ray
 * that comes from next to the horizon uses outgoing time, in which -w' replaces w'. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_RAYS(KD_SPEC_U_, KD_SPEC_B_)
const bool INGOING = false; /* the kernel is only for observers outside the horizon */

#define KD_NYSTROEM_ORDER METHOD
#include "ray/kerr_ray.glsl"
#define KD_POLAR_LISTED
#include "ray/polar.glsl"
#include "ray/radial_step.glsl"
#include "ray/path_step.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;

layout(push_constant) uniform Push { uint first, count; }
push;
layout(set = 0, binding = 0) readonly buffer Rays
{
    /* parameters of the hole and of the observer; epsilon: unit roundoff */
    float spin, u, s, horizon, root, w0, epsilon;
#define F(name) float name;
    KD_HOLE_MORE_FIELDS_(F)
#undef F
    float list[]; /* three numbers for each ray: alpha, beta, and the direction (1:
                   * inwards, -1: outwards) */
}
cam;
layout(set = 0, binding = 1) writeonly buffer Ends { float ends[]; };
#include "ray/trace.glsl"
#include "ray/escape.glsl"

struct kd_rates { float psi, chi, delay; };

kd_state radial(kd_full p)
{
    kd_state y;
    y.w = p.y.x;
    y.dw = p.dy.x;
    return y;
}

/* E + w' for E = 1, computed without cancellation where the ray goes outwards (w' < 0). */
float energy_and_fall(kd_geodesic m, float w, float dw)
{
    return dw > 0.0 ? 1.0 + dw : max(-w * w * (m.a2 + w * (2.0 * m.k - m.d * w)), 1e-30) / (1.0 - dw);
}

kd_rates rates(kd_geodesic m, kd_full p, float b, float way)
{
    float w = p.y.x, u = p.y.y, dw = p.dy.x, a = cam.spin, c = sqrt(b + m.energy2), lost = 1.0 - u * u;
    kd_state y = radial(p);
    kd_rates o;
    o.psi = m.momentum * m.energy2 / (c * (sqrt(b + m.energy2 * u * u) + c));
    o.chi = kd_drag(m, y, 1.0, a, cam.root, way);
    float a2w2 = a * a * w * w;
    o.delay = a * (m.momentum - a * lost);
    if (way != 0.0)
        o.delay += (1.0 + a2w2) * m.k / kd_one_way(m, y, 1.0, a, way);
    else
        o.delay += kd_time_over(KD_HOLE_OF(cam), w, m.momentum) / kd_horizons(w, cam.root) +
                   w * (m.k - m.d * w) * (1.0 + 2.0 * w / energy_and_fall(m, w, dw));
    return o;
}

/* The terms of the delay that are integrated in closed form, at one point of the ray. Their integral is the difference
 * of these values at both ends. At infinity they are 0. */
float delay_edge(kd_geodesic m, kd_state y, float way)
{
    if (!(y.w > 0.0))
        return 0.0;
    if (way != 0.0)
        return way * (kd_late_of(KD_HOLE_OF(cam), y.w, cam.root) - 1.0 / y.w +
                      kd_log(y.w * y.w / kd_horizons(y.w, cam.root)));
    return -y.dw / y.w - 2.0 * kd_log(0.5 * energy_and_fall(m, y.w, y.dw) / y.w);
}

/* Estimated error of w, from the violation of the first integral w'^2 = W^2 - D K w^2. The violation is taken as an
 * error of the velocity w' that acts for the time of a half period. */
float drifted(kd_geodesic m, kd_state y, float time)
{
    float off = abs(y.dw * y.dw - kd_radial_potential(m, y.w, 1.0, cam.spin, cam.root));
    return time * off / max(abs(y.dw), sqrt(off) + 1e-30);
}

/* Factor for the error of the steps. For a method of order p, the results with all steps and with half the steps differ
 * by 2^p - 1 times the remaining error: 15 or 63 times. LEFT times this difference is about thirty times the remaining
 * error. The margin makes it a bound even if the steps are so coarse that this relation fails. lost_in_a_turn: error of
 * steps of length h over a half turn, for rays that have no crossing to show it. */
const float LEFT = METHOD == 4 ? 2.0 : 0.5;
float lost_in_a_turn(float h) { return METHOD == 4 ? 0.1 * h * h * h * h : 0.1 * h * h * h * h * h * h; }

void main()
{
    uint i = push.first + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= push.count)
        return;
    kd_ray ray;
    ray.e = 1.0;
    ray.l = -cam.list[3 * i];
    ray.p = cam.list[3 * i + 1];
    ray.w = cam.w0;
    kd_geodesic m = kd_geodesic_of(ray, KD_HOLE_OF(cam), cam.u, cam.s);
    ray.dw = cam.list[3 * i + 2] * sqrt(max(kd_radial_potential(m, ray.w, 1.0, cam.spin, cam.root), 0.0));
    kd_polar polar = kd_polar_of(m, ray, cam.u, cam.s);

    /* dp: derivative of psi without its smooth part (polar_azimuth.glsl) */
    float dp = cam.u < 0.0 || (cam.u == 0.0 && ray.p < 0.0) ? -ray.p : ray.p;
    float root = sqrt(polar.b + m.energy2 * cam.u * cam.u), side = ray.l < 0.0 ? -1.0 : 1.0;
    float peak = side * kd_angle_upper(-dp / root, abs(cam.u) * abs(ray.l) / sqrt(polar.b + m.energy2));

    kd_full p;
    p.y = vec3(ray.w, cam.u, 0.0);
    p.dy = vec3(ray.dw, cam.s * ray.p, 1.0);
    kd_state half_, start;
    half_.w = start.w = ray.w;
    half_.dw = start.dw = ray.dw;
    const kd_rounding rounding = kd_rounding_of_labels(ray, cam.spin, cam.u, cam.s, cam.horizon, cam.epsilon);
    kd_turning_point barrier = kd_turning_point_of(m, ray, cam.spin, cam.horizon, cam.root, rounding);
    float way = 0.0, started = delay_edge(m, start, 0.0), fallen = 0.0;
    /* Rounding errors at the start, in units of roundoff. size: error of R = w'^2. kick: error of w and w' together. */
    float size = 1.0 + ray.w * ray.w * (ray.l * ray.l + ray.p * ray.p + 2.0 * abs(m.k) * ray.w);
    float kick = 8.0 + (ray.w > 0.0 ? 2.0 * size / max(abs(ray.dw), sqrt(cam.epsilon * size)) : 0.0);
    kd_path last = kd_path_start(ray, cam.u, cam.s);
    KD_TRACE_CONSTANTS(m);
    KD_TRACE_STEP(KD_TRACE_START, 0.0, last.y, last.v, 0.0);
    float above = cam.u < 0.0 || (cam.u == 0.0 && ray.p < 0.0) ? -1.0 : 1.0;
    float h = polar.first / float(STEPS), psi = 0.0, chi = 0.0, delay = 0.0, tau = 0.0, error = 0.0;
    /* values at the last crossing. lost_before: error of w due to the steps. spread: divergence of neighbouring rays */
    float lost_before = 0.0, spread = 1.0;
    bool alive = polar.crosses;
    uint at = 3 * ORDERS + 4, o = at * i;
    for (uint n = 0; n < 3 * ORDERS; n++)
        ends[o + n] = 0.0;

    for (uint n = 0; n < ORDERS && alive; n++) {
        if (way == 0.0) { /* true if the rest of the ray is in ingoing or outgoing coordinates */
            way = kd_direction_of_motion(barrier, radial(p));
            delay += delay_edge(m, radial(p), 0.0) - started;
            started = delay_edge(m, radial(p), way);
            fallen = kd_drag_fall(p.y.x, cam.spin, cam.root);
        }
        kd_rates r = rates(m, p, polar.b, way);
        vec3 sum = 7.0 * vec3(r.psi, r.chi, r.delay);
        float apart = 0.0;
        uint j = 1;
        for (; j <= STEPS; j++) {
            p = kd_full_step(m, p, h);
            KD_TRACE_STEP(float(n), h, vec4(0.0, 0.0, p.y.yx), vec4(0.0, 0.0, p.dy.yx), 0.0);
            /* limited to stay finite: a ray whose error is amplified by more than 1e12 counts as undecided anyway */
            p.y.z = clamp(p.y.z, -1e12, 1e12);
            if (p.y.x < 0.0 || p.y.x >= cam.horizon)
                break;
            r = rates(m, p, polar.b, way);
            float weight = (j & 1u) == 1u ? 32.0 : (j & 3u) == 2u ? 12.0 : j == STEPS ? 7.0 : 14.0;
            sum += weight * vec3(r.psi, r.chi, r.delay);
            if ((j & 1u) == 0u) {
                half_ = kd_radial_step(m, half_, 2.0 * h);
                half_.w = clamp(half_.w, -2.0, 2.0);
                apart = max(apart, abs(p.y.x - half_.w));
            }
        }
        kd_state y = radial(p);
        float w = y.w;
        alive = j > STEPS && w > 0.0;
        tau += h * float(min(j, STEPS));
        float left = h * float(STEPS - min(j, STEPS)), ahead = left * abs(y.dw);
        /* The error of w comes from the steps and from rounding. The error of the steps is the difference of the two
         * integrations, if that is small. Two wrong paths may agree by chance. So the error of the steps is taken to be
         * at least the error at the last crossing, times the growth of the variation since then. Rounding adds about
         * ten unit roundoffs, amplified by the variation. The error of the crossing's time adds as much again, and so
         * does the drift of the first integral. */
        float parted = abs(p.y.z) + left * abs(p.dy.z);
        float lost = max((LEFT + min(apart / max(abs(w), 1e-30), 2.0)) * apart, lost_before * parted / spread);
        float off = lost + drifted(m, y, h * float(STEPS)) +
                    cam.epsilon * ((4.0 + 0.01 * float(STEPS)) * w + kick * abs(p.y.z) + 8.0 * tau * abs(y.dw));
        /* Close to the horizon or to infinity, errors may create or remove a crossing. Only crossings that certainly
         * exist are reported. */
        if (min(abs(w), abs(cam.horizon - w)) + ahead < off) {
            error = max(error, 1.0);
            alive = false;
        }
        if (alive) {
            sum *= h * (2.0 / 45.0);
            psi += sum.x;
            chi += sum.y;
            delay += sum.z;
            float fall = way * (kd_drag_fall(w, cam.spin, cam.root) - fallen);
            float turned = peak + float(n) * side * KD_PI + psi + chi + fall;
            ends[o + 3 * n] = w;
            ends[o + 3 * n + 1] = -turned;
            ends[o + 3 * n + 2] = delay + delay_edge(m, y, way) - started;
            error = max(error, off / w);
            lost_before = lost;
            spread = abs(p.y.z) + polar.half_ * abs(p.dy.z) + 1e-30;
            above = -above;
            last = kd_path_crossing(m, y, turned - chi - fall, chi + fall, above);
            KD_TRACE_STEP(KD_TRACE_CROSSING, 0.0, last.y, last.v, last.chi);
        }
        h = polar.half_ / float(STEPS);
    }

    kd_escape end = kd_path_escape(m, ray, last);
    if (error == 0.0) /* without a crossing nothing amplifies errors */
        error = 1e3 * cam.epsilon + lost_in_a_turn(KD_PI / float(STEPS));
    if (!kd_is_decided(barrier, start, kd_start_noise(m, start, rounding)) ||
        kd_escapes(barrier, start) != (end.fate == KD_FATE_ESCAPED))
        end.fate = KD_FATE_UNDECIDED;
    at = o + 3 * ORDERS;
    ends[at] = end.u;
    ends[at + 1] = -end.phi;
    ends[at + 2] = end.fate;
    ends[at + 3] = error;
}
