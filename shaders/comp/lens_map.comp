/* Kernel: makes the lens map by integration, for an observer at any radius. It computes the radii of the crossings. If
 * the scene requires them, it also computes the azimuths and radial slopes of the crossings, a ray's fate, and the
 * direction in which the ray escapes.
 *
 * The times at which a ray crosses the plane are known in closed form (polar.glsl). So steps end exactly on the
 * crossings. Each half period has STEPS equal steps of the radial equation. All rays take the same steps: the kernel
 * needs no search, and its invocations do not diverge. From its last crossing on, a ray that escapes is followed by the
 * full vector equation of the angles.
 *
 * It writes all planes of shared/lens.h except those of the delay and of alpha. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_LENS_MAP(KD_SPEC_U_, KD_SPEC_B_)
#include "ray/planes.glsl"
const bool PHI = (QUANTITIES & KD_LENS_PHI) != 0u, SKY = (QUANTITIES & KD_LENS_FATE) != 0u,
           SLOPE = (QUANTITIES & KD_LENS_SLOPE) != 0u;

#define KD_NYSTROEM_ORDER METHOD
#include "ray/kerr_ray.glsl"
#include "ray/polar.glsl"
#include "ray/polar_azimuth.glsl"
#include "ray/radial_step.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;

layout(set = 0, binding = 0) buffer LensMap { float lens[]; };
#define KD_CAMERA_BINDING 2
#define KD_BY_PLACE_BINDING KD_PLACES_BINDING
#include "ray/camera.glsl"
#include "ray/place.glsl"
#include "ray/open.glsl"
#include "ray/node.glsl"
#include "ray/escape.glsl"

/* Weights of Boole's rule at its five nodes, times 22.5. */
float kd_boole(uint k) { return k == 0 || k == 4 ? 7.0 : k == 2 ? 12.0 : 32.0; }

/* A group of four steps in which a ray turns back to the horizon. */
struct kd_turning {
    kd_state start;
    /* part: number of steps before the turn, 0 to 4. drag: the group's frame dragging by Boole's rule, which the result
     * of kd_drag_about_turn replaces */
    float part, drag;
    float w; /* w of the turning point */
    /* any: true if the ray has such a group. last: true if it is the last group of its half period */
    bool any, last;
};

/* Frame dragging over a group of steps in which the ray turns. The integral has two parts: up to the turn in ingoing
 * coordinates, and after it in outgoing coordinates. In these coordinates the integrand of each part is smooth and has
 * no pole. */
float kd_drag_about_turn(kd_geodesic m, float e, float h, inout kd_turning t)
{
    kd_state z = t.start;
    float sum = 0.0;
    /* this is a loop, because lavapipe skips work only by leaving loops */
    for (uint j = 0; j < (t.any ? 10 : 0); j++) {
        uint k = j < 5 ? j : j - 5;
        float of = j < 5 ? 0.25 * t.part : 1.0 - 0.25 * t.part;
        z = kd_radial_step(m, z, k == 0 ? 0.0 : of * h);
        z.dw = z.w > cam.horizon && z.dw < 0.0 ? kd_leaving(m, z.w, e) : z.dw;
        t.w = j == 5 ? z.w : t.w;
        float beside = INGOING || (k > 0 && k < 4) || k == (j < 5 ? 4 : 0) || (j == 9 && t.last) ? 0.0
                       : j == 0 ? -7.0
                                : 7.0; /* adjacent groups share a node, whose weight is 14 */
        sum += (of * kd_boole(k) + beside) * kd_drag_ingoing(m, z, e, cam.spin, cam.root, j < 5 ? -1.0 : 1.0);
    }
    return sum;
}

void main()
{
    kd_camera_read();
    uvec2 step_;
    uint at;
    if (!kd_this_ray(step_, at))
        return;
    kd_ray ray = kd_camera_ray(step_.x, step_.y);
    kd_geodesic m = kd_geodesic_of(ray, KD_HOLE_OF(cam), cam.u, cam.s);
    kd_polar polar = kd_polar_of(m, ray, cam.u, cam.s);
    kd_azimuth azimuth;
    float psi = 0.0, chi = 0.0;
    if (PHI || SKY) {
        azimuth = kd_azimuth_of(m, ray, polar, cam.u, cam.s);
        psi = azimuth.first;
    }

    kd_state y;
    y.w = ray.w;
    y.dw = ray.dw;
    bool dark = INGOING && !kd_from_outside(m, ray.w, ray.e, cam.spin, cam.horizon);
    const kd_rounding rounding = kd_camera_rounding();
    kd_turning_point barrier = kd_turning_point_of(m, ray, cam.spin, cam.horizon, cam.root, rounding);
    kd_state start = y;
    float way = 0.0, fallen = 0.0;
    bool returns = false;
    if (INGOING)
        barrier = kd_turning_point_beside(m, barrier, y, cam.horizon, rounding);
    if (INGOING && (PHI || SKY)) {
        returns = !kd_escapes(barrier, y);
        way = returns && y.dw > 0.0 ? 1.0 : -1.0;
        fallen = way > 0.0 ? -2.0 * cam.twist : 0.0;
    }
    kd_path last = kd_path_start(ray, cam.u, cam.s);
    float above = cam.u < 0.0 || (cam.u == 0.0 && ray.p < 0.0) ? -1.0 : 1.0;
    bool alive = polar.crosses && !dark;
    uint crossings = 0u;
    const float far = cam.size_e * inversesqrt(max(ray.l * ray.l + ray.p * ray.p, ray.e * ray.e));
    /* lost: rounding error of R. The error of the steps is measured later, at each crossing. */
    float lost = kd_start_noise(m, start, rounding);
    bool open = !dark && !kd_is_decided(barrier, start, lost);
    const float deepest = INGOING ? max(2.0, 1.1 * cam.w0) : 2.0;
    float h = polar.first * (1.0 / float(STEPS));
    /* clears the planes of crossings, which come first */
    for (uint n = 0; n < (PHI ? 2 : 1) * ORDERS + (SLOPE ? ORDERS : 0); n++)
        lens[at + n * slice.stride] = 0.0;

    for (uint n = 0; n < ORDERS && alive; n++) {
        float low = y.w, high = INGOING && y.dw <= 0.0 ? 0.0 : y.w, sum = 0.0;
        kd_turning turn = kd_turning(y, 0.0, 0.0, 0.0, false, false);
        if (!INGOING && (PHI || SKY) && way == 0.0) { /* true if the rest of the ray is in ingoing or outgoing
                                                       * coordinates */
            returns = y.dw < 0.0 && !kd_escapes(barrier, y);
            way = returns ? -1.0 : kd_direction_of_motion(barrier, y);
            fallen = -way * kd_drag_fall(y.w, cam.spin, cam.root);
        }
        if (!INGOING && (PHI || SKY))
            sum = 7.0 * kd_drag(m, y, ray.e, cam.spin, cam.root, way);
        for (uint i = 0; i < STEPS; i += 4) {
            const kd_state before = y;
            const float whole = sum;
            float part = -1.0;
            if (INGOING && (PHI || SKY))
                sum += 7.0 * kd_drag_ingoing(m, y, ray.e, cam.spin, cam.root, way);
            /* Boole's rule on each group of four steps. */
            for (uint j = 0; j < 4; j++) {
                const float speed = y.dw;
                y = kd_radial_step(m, y, h);
                if (speed < 0.0 && y.dw >= 0.0)
                    part = float(j) + speed / (speed - y.dw);
                if (INGOING && y.w > cam.horizon && y.dw < 0.0)
                    y.dw = kd_leaving(m, y.w, ray.e);
                /* Beyond the horizon the values have no meaning, but they must stay finite. */
                y.w = clamp(y.w, -2.0, deepest);
                low = min(low, y.w);
                /* a ray on its way out may be inside the horizon */
                high = max(high, INGOING && y.dw <= 0.0 ? 0.0 : y.w);
                if (INGOING && (PHI || SKY))
                    sum += (j == 3   ? 7.0
                            : j == 1 ? 12.0
                                     : 32.0) *
                           kd_drag_ingoing(m, y, ray.e, cam.spin, cam.root, way);
                if (!INGOING && (PHI || SKY))
                    sum += (j == 3   ? (i + 4 == STEPS ? 7.0 : 14.0)
                            : j == 1 ? 12.0
                                     : 32.0) *
                           kd_drag(m, y, ray.e, cam.spin, cam.root, way);
            }
            /* the rest of the ray is in outgoing coordinates */
            if ((PHI || SKY) && returns && way < 0.0 && part >= 0.0) {
                way = 1.0;
                turn = kd_turning(before, part, sum - whole, 0.0, true, i + 4 == STEPS);
            }
        }
        if (PHI || SKY) {
            float drag = kd_drag_about_turn(m, ray.e, h, turn);
            sum += turn.any ? drag - turn.drag : 0.0;
            fallen -= turn.any ? 2.0 * kd_drag_fall(turn.w, cam.spin, cam.root) : 0.0;
        }
        /* adds the error of the steps up to this crossing, unless w was clamped */
        if (y.w > -cam.horizon && y.w < deepest)
            lost = max(lost, abs(y.dw * y.dw - kd_radial_potential(m, y.w, ray.e, cam.spin, cam.root)));
        float passes = barrier.r < 0.0 ? 2.0 : 1.0; /* a ray that turns passes the turning point twice */
        kd_margins margins = kd_margins_of(barrier, barrier.noise + passes * lost, min(far, cam.horizon), cam.horizon);
        open = open || kd_crossing_is_open(y.w, margins) || !kd_is_finite(y.w + sum);
        alive = low >= 0.0 && high < cam.horizon && y.w > 0.0;
        if (alive) {
            chi += sum * h * (2.0 / 45.0);
            float fall = way * kd_drag_fall(y.w, cam.spin, cam.root) + fallen;
            crossings++;
            lens[at + n * slice.stride] = y.w;
            if (PHI)
                lens[at + (kd_plane(KD_LENS_PHI) + n) * slice.stride] = -(psi + chi + fall);
            if (SLOPE)
                lens[at + (kd_plane(KD_LENS_SLOPE) + n) * slice.stride] = y.dw;
            if (SKY) {
                above = -above;
                last = kd_path_crossing(m, y, psi, INGOING ? chi : chi + fall, above);
            }
        }
        psi += azimuth.half_;
        h = polar.half_ * (1.0 / float(STEPS));
    }

    if (SKY) {
        kd_escape end = kd_path_escape(m, ray, last);
        if (dark)
            end.fate = KD_FATE_CAPTURED;
        else if (open || kd_escapes(barrier, start) != (end.fate == KD_FATE_ESCAPED) || !kd_is_finite(end.u + end.phi))
            end.fate = KD_FATE_UNDECIDED;
        lens[at + kd_plane(KD_LENS_SKY_U) * slice.stride] = end.u;
        lens[at + kd_plane(KD_LENS_SKY_PHI) * slice.stride] = -end.phi;
        lens[at + kd_plane(KD_LENS_FATE) * slice.stride] = end.fate;
        open = end.fate == KD_FATE_UNDECIDED;
    }
    float curve = barrier.r;
    /* multiplies R by W at the horizon, which vanishes where the origin of light changes from inside to outside
     * (kd_from_outside) */
    if (INGOING && start.w >= cam.horizon) {
        curve *= ray.e + cam.spin * (cam.spin * ray.e - m.momentum) * cam.horizon * cam.horizon;
    }
    kd_finish_ray(open, at, crossings, dark || !kd_escapes(barrier, start), curve);
}
