/* Kernel: makes the lens map in closed form, for an observer at infinity or outside the photon orbits. It computes the
 * radii of the crossings. If the scene requires them, it also computes the azimuths and radial slopes of the crossings,
 * a ray's fate, and the direction in which the ray escapes. It writes all planes of shared/lens.h except those of the
 * delay and of alpha.
 *
 * The times at which a ray crosses the plane are known (polar.glsl), and from them its radius (arc.glsl). The azimuth
 * by which the hole drags the ray is an integral over each half period, by Gauss-Legendre quadrature. The positions at
 * the nodes of the quadrature are computed from the nearer of the two crossings. The time from that crossing to the
 * node is the same in all half periods except the first. The ray escapes when w vanishes, which is known from w and w'
 * at its last crossing. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_LENS_CLOSED(KD_SPEC_U_, KD_SPEC_B_)
#include "ray/planes.glsl"
const bool PHI = (QUANTITIES & KD_LENS_PHI) != 0u, SKY = (QUANTITIES & KD_LENS_FATE) != 0u,
           SLOPE = (QUANTITIES & KD_LENS_SLOPE) != 0u;
#include "ray/kerr_ray.glsl"
#include "ray/polar.glsl"
#include "ray/polar_azimuth.glsl"
#include "ray/arc.glsl"
#include "ray/arc_drag.glsl"
#include "ray/arc_escape.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;

layout(set = 0, binding = 0) buffer LensMap { float lens[]; };
#define KD_CAMERA_BINDING 2
#define KD_BY_PLACE_BINDING KD_PLACES_BINDING
#include "ray/camera.glsl"
#include "ray/place.glsl"
#include "ray/open.glsl"
#include "ray/node.glsl"

/* number of half periods that are followed after the last order. Rays that circle longer are within a relative distance
 * of 1e-13 of the critical curve */
const uint MORE = 12;

/* The part of a ray between two crossings. */
struct kd_leg {
    kd_centre last; /* centre at the last crossing, or at the start */
    kd_centre to;   /* centre at the next crossing; meaningful only if the ray is still outside there (see `alive`) */
    kd_state next;  /* state of the ray at the next crossing */
    bool alive;     /* true if the ray is still outside at the next crossing */
    float psi, chi; /* psi: azimuth without drag at the next crossing. chi: azimuth by drag up to `last` */
    float drag;     /* azimuth by drag from `last` to the next crossing */
    float tau;      /* Mino time of the next crossing */
    float side;     /* direction of the ray at `last`: 1 upwards, -1 downwards */
    bool crossed;   /* true if `last` is a crossing, not the start */
};

/* Upper bound of the time until the ray reaches the horizon or, if it starts outwards, infinity. The bound follows from
 * the least value of R on the ray. */
float time_limit(kd_turning_point b, kd_state start, float e, bool falls)
{
    float e2 = e * e, least = min(e2, start.dw * start.dw);
    if (falls)
        return cam.horizon / sqrt(clamp(b.r, 1e-6 * e2, e2));
    if (b.w < start.w)
        least = min(least, b.r);
    return start.dw < 0.0 ? 1.01 * start.w / sqrt(max(least, 1e-12 * e2)) : 1e30;
}

/* True if the ray still exists at the crossing. The closed form continues beyond the horizon, turns inside and comes
 * back out. So a ray that falls must still fall at the crossing, and must reach it within its largest possible time. A
 * ray that escapes comes back from infinity on the other side, where w < 0. */
bool goes_on(kd_leg leg, bool falls, float limit)
{
    return leg.tau < limit && (falls ? leg.next.dw > 0.0 : leg.last.dv > 0.0 || leg.next.dw <= 0.0);
}

/* True if rounding may have created or removed the leg's next crossing. This test does not use the drag. The drag takes
 * half of the kernel's time, and is computed only if something else needs it. */
bool is_open(kd_leg leg, kd_polar polar, kd_margins margins)
{
    return (polar.crosses && kd_crossing_is_open(leg.next.w, margins)) || ((PHI || SKY) && !kd_is_finite(leg.drag));
}

/* Advances the leg by half a period. nodes, arc, z: values for the time of half a period. */
void go_on(inout kd_leg leg, kd_arcs a, kd_drag_terms drag, kd_nodes nodes, kd_arc arc, float z, float psi, float tau,
           float edge, float limit)
{
    leg.last = leg.to;
    leg.chi += leg.drag;
    leg.side = -leg.side;
    leg.next = kd_ahead(a, leg.last, arc);
    leg.to = kd_centre_of(a, leg.next);
    leg.drag = kd_drag_between(drag, leg.last, leg.to, nodes, z);
    leg.tau += tau;
    leg.psi += psi;
    leg.alive = leg.alive && leg.next.w > 0.0 && leg.next.w < edge && goes_on(leg, drag.falls, limit);
}

/* True if polar.first, the time of the first crossing, is valid. If A > 0 and Q < 0 the ray never reaches the plane.
 * Where Q nearly vanishes, its sign is decided by rounding (polar.glsl). Then the time is compared with a lower bound:
 * u'^2 = Q + A u^2 - e u^4 is at most s^2/4e, so the ray cannot reach the plane sooner than at the speed s / 2 sqrt(e).
 * If A < 0 and Q = 0, the ray stays in the plane. Its half periods are counted as usual, although it crosses nothing.
 */
bool first_is_known(kd_geodesic m, kd_polar polar, float u, float ae)
{
    return m.a2 <= 0.0 || (m.q > 0.0 && polar.first * polar.s > 1.98 * abs(u * ae));
}

/* Stores crossing n, or zeros if there is none (any is false). */
void keep(uint at, uint n, bool any, kd_leg leg, kd_drag_terms drag)
{
    float w = any ? leg.next.w * drag.unit : 0.0;
    at += n * slice.stride;
    lens[at] = w;
    if (PHI)
        lens[at + kd_plane(KD_LENS_PHI) * slice.stride] =
            any ? -(leg.psi + leg.chi + leg.drag + kd_drag_fallen(drag, w)) : 0.0;
    if (SLOPE)
        lens[at + kd_plane(KD_LENS_SLOPE) * slice.stride] = any ? leg.next.dw : 0.0;
}

/* Stores where the ray ends. Returns true if that end is certain. nodes, z: values for the leg that the ray does not
 * complete. before: if the leg begins with the start, the time from the last crossing to the start. */
bool keep_end(uint at, kd_geodesic m, kd_ray ray, kd_arcs a, kd_azimuth azimuth, kd_drag_terms drag, kd_leg leg,
              kd_arc middle, float leg_z, float before, bool decided)
{
    kd_state far_away;
    far_away.w = 0.0;
    far_away.dw = -drag.e;
    float z = kd_arc_escape_time(a, leg.last, middle, leg.next, leg_z, drag.e), time = z * a.unit;
    float rate = sqrt(max(ray.l * ray.l + ray.p * ray.p, ray.e * ray.e));
    bool soon = FINITE && !leg.crossed && ((cam.u != 0.0 && m.q <= 0.0) || time * rate < 1.0);
    azimuth.uneven = azimuth.uneven && !soon;
    kd_direction end = kd_arc_direction(m, a, azimuth, time + before);
    float chi = leg.chi + kd_drag_between(drag, leg.last, kd_centre_of(a, far_away), kd_nodes_of(a.l, z), z);
    end.psi += leg.psi - azimuth.half_;
    end.u *= leg.side;
    if (FINITE) {
        kd_direction at_once = kd_arc_direction_soon(m, ray, cam.u, cam.s, time);
        if (soon)
            end = at_once;
    }
    float phi = end.psi + chi, fate = drag.falls ? KD_FATE_CAPTURED : KD_FATE_ESCAPED;
    if (!decided || (!drag.falls && (leg.alive || !kd_is_finite(phi))))
        fate = KD_FATE_UNDECIDED;
    bool escapes = fate == KD_FATE_ESCAPED;
    lens[at + kd_plane(KD_LENS_SKY_U) * slice.stride] = escapes ? end.u : 0.0;
    lens[at + kd_plane(KD_LENS_SKY_PHI) * slice.stride] = escapes ? -phi : 0.0;
    lens[at + kd_plane(KD_LENS_FATE) * slice.stride] = fate;
    return fate != KD_FATE_UNDECIDED;
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
    kd_arcs a = kd_arcs_of(m, ray.e);
    kd_ray tilted = ray; /* a ray in the plane is tilted slightly, because its azimuth would have no start */
    tilted.p = cam.u == 0.0 && ray.p == 0.0 ? 1e-15 : ray.p;
    kd_azimuth azimuth = kd_azimuth_of(m, tilted, polar, cam.u, cam.s);
    kd_state start;
    start.w = ray.w;
    start.dw = ray.dw;
    const kd_rounding rounding = kd_camera_rounding();
    kd_turning_point barrier = kd_turning_point_of(m, ray, cam.spin, cam.horizon, cam.root, rounding);
    kd_drag_terms drag = kd_drag_terms_of(m, ray.e, cam.spin, cam.root, a.unit, !kd_escapes(barrier, start));
    float edge = cam.horizon * a.scale, limit = time_limit(barrier, start, ray.e, drag.falls);

    const bool known = first_is_known(m, polar, cam.u, cam.spin * ray.e);
    polar.first = known ? polar.first : min(limit, polar.half_);
    float z1 = polar.first * a.scale, zh = polar.half_ * a.scale;
    kd_nodes n1 = kd_nodes_of(a.l, z1), nh = kd_nodes_of(a.l, zh);
    kd_arc end1 = kd_arc_twice(a.l, n1.middle), endh = kd_arc_twice(a.l, nh.middle);

    kd_leg leg;
    kd_state scaled = start;
    scaled.w *= a.scale;
    leg.last = kd_centre_of(a, scaled);
    leg.next = kd_ahead(a, leg.last, end1);
    leg.to = kd_centre_of(a, leg.next);
    leg.tau = polar.first;
    leg.psi = azimuth.first;
    leg.chi = FINITE ? -kd_drag_fallen(drag, ray.w) - cam.twist : 0.0;
    leg.drag = kd_drag_between(drag, leg.last, leg.to, n1, z1);
    leg.alive = known && leg.next.w > 0.0 && leg.next.w < edge && goes_on(leg, drag.falls, limit);
    leg.side = cam.u < 0.0 || (cam.u == 0.0 && ray.p < 0.0) ? -1.0 : 1.0;
    leg.crossed = leg.alive;
    /* Far out, w varies on the scale of E divided by the larger of E and |(l, p)|. That larger value is at least
     * a.scale / sqrt(3), and at least 1. The scale of w is at most the scale at the horizon. */
    const kd_margins margins = kd_margins_of(barrier, barrier.noise, max(1.74 * cam.size_e, cam.horizon), edge);
    bool open = !kd_is_decided(barrier, start, kd_start_noise(m, start, rounding)) || is_open(leg, polar, margins);
    keep(at, 0, leg.alive && polar.crosses, leg, drag);
    uint crossings = leg.alive && polar.crosses ? 1u : 0u;
    const uint legs = SKY && !drag.falls ? ORDERS + MORE : ORDERS;
    uint n = 1;
    /* follows all orders, because without drag a half period costs no more than storing zeros for a missing crossing */
    if (!PHI && !SKY) {
        for (; n < ORDERS; n++) {
            bool before = leg.alive;
            go_on(leg, a, drag, nh, endh, zh, azimuth.half_, polar.half_, edge, limit);
            open = open || (before && is_open(leg, polar, margins));
            crossings += leg.alive && polar.crosses ? 1u : 0u;
            keep(at, n, leg.alive && polar.crosses, leg, drag);
        }
    }
    /* These loops test at their ends, because with a test at the head lavapipe executes the body once more than
     * needed. */
    if ((PHI || SKY) && leg.alive && n < legs) {
        do {
            go_on(leg, a, drag, nh, endh, zh, azimuth.half_, polar.half_, edge, limit);
            if (n < ORDERS) {
                open = open || is_open(leg, polar, margins);
                crossings += leg.alive && polar.crosses ? 1u : 0u;
                keep(at, n, leg.alive && polar.crosses, leg, drag);
            }
        } while (++n < legs && leg.alive);
    }
    if ((PHI || SKY) && n < ORDERS) {
        do {
            keep(at, n, false, leg, drag);
        } while (++n < ORDERS);
    }
    if (SKY) {
        kd_arc middle = nh.middle;
        float z = zh, before = 0.0;
        if (!leg.crossed) {
            middle = n1.middle;
            z = z1;
            before = polar.half_ - polar.first;
        }
        open = !keep_end(at, m, ray, a, azimuth, drag, leg, middle, z, before, !open);
    }
    kd_finish_ray(open, at, crossings, drag.falls, barrier.r);
}
