/* The march: light along a ray through volumes, composed with the crossings of the lens map in their order
 * (docs/physics/volume.md).
 *
 * The ray is traced again by the steps of ray/escape.glsl, which are long and accurate. Within a step the ray is
 * Hermite's quintic, which fits y, y' and y'' at both ends. Its error is of sixth order in the step, like the
 * integrator's. A step is split where w or u turns and where the plane is crossed, so that w and u are monotone in each
 * part. In each part Newton's method finds the range inside the volumes' bounds. This range is integrated in stretches
 * with three Gauss-Legendre nodes each. A stretch is as long as the grain, the depth and the distance allow. A stretch
 * that turns out too long is repeated.
 *
 * This file needs inputs.glsl and two macros. KD_MARCH_MEET(beam, w, n, place, at) composes crossing n of the lens map.
 * KD_MARCH_GIVEN_UP(beam) is for a ray whose end is not found. */
#ifndef KD_MARCH_GLSL
#define KD_MARCH_GLSL

/* These numbers are push constants, because they differ between dispatches: the same kernel also follows a sample of
 * pixels with finer steps (src/render/frame/march_error.c). */
#define STEPS slice.steps /* number of steps per half period */
#define FINE slice.fine   /* a stretch is at most 4/FINE grains long */

#include "ray/radial_step.glsl"
#include "ray/escape.glsl"

#define KD_MARCH_SHORTEST (1.0 / 4096.0) /* shortest stretch, as a fraction of a step */
/* least length of a stretch, as a fraction of the longest stretch that distance allows; applies if KD_MARCH_SHORTEST is
 * longer */
#define KD_MARCH_LEAST 0.05
/* longest stretch, as a fraction of r; three nodes then integrate r^2 with an error of 4e-5 */
#define KD_MARCH_WAY 0.5
#define KD_MARCH_DEPTH 1.0 /* largest optical depth of a stretch */
#define KD_MARCH_TURN 1.0  /* largest Faraday rotation and conversion in a stretch, radians */
/* Faraday rotation shortens a stretch to this fraction, at least, of the length otherwise allowed. Light that rotates
 * further within a stretch is mixed and mostly depolarised */
#define KD_MARCH_TURNED 0.125
#define KD_MARCH_TOO_LONG 1.5 /* a stretch is repeated if it is longer by this factor than its nodes allow */
/* largest factor by which a grain is lengthened where other matter almost hides the matter */
#define KD_MARCH_BEHIND 1.5
/* limit of loop passes, more than any ray needs. lavapipe may end a loop early; the count of passes shows that work was
 * left unfinished */
#define KD_MARCH_LOOPS 65536u
/* least Delta w^4 of a turning ray. Smaller values are closer to the horizon than 32 bits resolve. There the ray's time
 * has no valid digits, but it stays finite */
#define KD_MARCH_CLOSE 1e-8
/* Largest number of loop passes for one stretch, including the root finding for the ends of its part. */
#define KD_MARCH_STRETCH (4u + 3u * (KD_THICK_TAKEN + 4u + (KD_HAS(stokes) ? 12u : 0u)))
#define KD_MARCH_ENDS 100u
#define KD_MARCH_DEEP 1e3            /* optical depth of a stretch beyond which there is no visible difference */
#define KD_MARCH_OPAQUE slice.opaque /* a ray ends where less than this fraction of the light behind is transmitted */

/* State of a ray that is traced in pieces, one dispatch each (KD_PIECES), because a driver's limit on loops stopped it.
 * left: loop passes that this piece may still take. waits: true if no passes were left before the ray's end. The other
 * members say where to continue: number of completed steps, place within the next step, and length of the next stretch.
 */
#ifdef KD_PIECES
struct kd_march_piece {
    uint left, steps;
    float from, stretch;
    bool waits;
} kd_march_at;
#define KD_MARCH_SPEND(n) kd_march_at.left -= min(n, kd_march_at.left);
#define KD_MARCH_MAY (kd_march_at.left > 0u)
#define KD_MARCH_WAITS kd_march_at.waits
#else
#define KD_MARCH_SPEND(n)
#define KD_MARCH_MAY true
#define KD_MARCH_WAITS false
#endif

/* A polynomial in the time within a step, which runs from 0 to 1. */
struct kd_quintic { float c0, c1, c2, c3, c4, c5; };

/* The quintic from values y, slopes d and second derivatives a at both ends. */
kd_quintic kd_quintic_of(float y0, float d0, float a0, float y1, float d1, float a1)
{
    float rest = y1 - y0 - d0 - 0.5 * a0, slope = d1 - d0 - a0, bend = a1 - a0;
    return kd_quintic(y0, d0, 0.5 * a0, 10.0 * rest - 4.0 * slope + 0.5 * bend, -15.0 * rest + 7.0 * slope - bend,
                      6.0 * rest - 3.0 * slope + 0.5 * bend);
}

float kd_quintic_at(kd_quintic q, float t)
{
    return q.c0 + t * (q.c1 + t * (q.c2 + t * (q.c3 + t * (q.c4 + t * q.c5))));
}
float kd_quintic_slope(kd_quintic q, float t)
{
    return q.c1 + t * (2.0 * q.c2 + t * (3.0 * q.c3 + t * (4.0 * q.c4 + t * 5.0 * q.c5)));
}
kd_quintic kd_quintic_derived(kd_quintic q)
{
    return kd_quintic(q.c1, 2.0 * q.c2, 3.0 * q.c3, 4.0 * q.c4, 5.0 * q.c5, 0.0);
}

/* Time between `low` and `high` at which the quintic takes a value. Newton's method, kept within these bounds. */
float kd_quintic_root(kd_quintic q, float value, float low, float high)
{
    bool falls = kd_quintic_at(q, low) >= value;
    float t = 0.5 * (low + high), moved = high - low;
    for (int k = 0; k < 10 && moved > 1e-7; k++) {
        float was = t;
        float f = kd_quintic_at(q, t) - value, next = t - f / kd_quintic_slope(q, t);
        bool before = (f < 0.0) != falls;
        low = before ? t : low;
        high = before ? high : t;
        t = next >= low && next <= high ? next : 0.5 * (low + high);
        moved = abs(t - was);
    }
    return t;
}

/* Narrows the range (from, to), in which q is monotone, to the part where sign_ times (q - value) is not negative. */
void kd_quintic_clip(kd_quintic q, float value, float sign_, inout float from, inout float to)
{
    float a = sign_ * (kd_quintic_at(q, from) - value), b = sign_ * (kd_quintic_at(q, to) - value);
    if ((a < 0.0) != (b < 0.0)) {
        float t = kd_quintic_root(q, value, from, to);
        from = a < 0.0 ? t : from;
        to = a < 0.0 ? to : t;
    } else if (a < 0.0)
        to = from;
}

const bool KD_MARCH_TURNS = ((KD_ALONG_TRAITS | KD_MET_TRAITS) & KD_TRAIT_AZIMUTH) != 0u;

/* True if the march needs the times at which light left its sources. */
#ifdef KD_PROBE
const bool KD_MARCH_DELAYS = true;
#else
const bool KD_MARCH_DELAYS = (KD_ALONG_TRAITS & KD_TRAIT_SLOW) != 0u;
#endif

/* Frame dragging up to the start of a step. chi: azimuth of the ray by dragging, in ingoing, outgoing or
 * Boyer-Lindquist coordinates. way: which of these coordinates, as in ray/radial_step.glsl. fallen: terms that earlier
 * coordinates left out. ago: how much earlier light left the start of the step than light that shows the scene's time.
 */
struct kd_march_drag {
    float chi, way, fallen;
    bool returns;
    float ago;
};

/* A step of the ray. Within the step chi is a cubic in time. The delay is the quintic `ago` plus along * kd_march_edge.
 * along: 1 if the ray moves inwards, -1 if outwards, 0 if it turns. */
struct kd_stride {
    kd_quintic w, u, x, y;
    float h, c0, c1, c2, c3, way;
    kd_quintic ago;
    float along;
};

/* Function of w in the closed-form part of the delay. Along the ray, traced backwards, Boyer-Lindquist time grows by t'
 * = (1 + a^2 w^2) W/(w^2 D) + a (L - a E (1 - u^2)), D = 1 - 2w + a^2 w^2 and W = E + a (a E - L) w^2. With w'^2 = W^2
 * - D K w^2 the first part of t' is (1 + a^2 w^2) (w'/(w^2 D) + K/(W + w')) where the ray goes inwards, and the same
 * with -w' where it goes outwards. The first term of this part is d/dtau of -1/w + ln(w^2/D) + (2 - q^2) kd_fall, for D
 * and W with the charge q. This term contains everything that grows without bound towards infinity and at the horizon.
 * After subtraction of r_o + 2 ln r_o it vanishes for an observer at infinity. The rest of t' is smooth. In the step in
 * which the ray turns, t' itself is smooth. */
float kd_march_edge(float w) { return w > 0.0 ? kd_late(w) - 1.0 / w + kd_log(w * w / kd_horizons(w, cam.root)) : 0.0; }

float kd_march_later(kd_geodesic m, kd_ray ray, kd_stride s, float t)
{
    float a = cam.spin, w = kd_quintic_at(s.w, t), u = kd_quintic_at(s.u, t), w2 = w * w, b = 1.0 + a * a * w2;
    kd_state y;
    y.w = w;
    y.dw = kd_quintic_slope(s.w, t) / s.h;
    float all = ray.e + a * (a * ray.e - m.momentum) * w2;
    float out_ = s.along != 0.0 ? b * m.k / kd_one_way(m, y, ray.e, a, s.along)
                                : b * all / max(w2 * kd_horizons(w, cam.root), KD_MARCH_CLOSE);
    return s.h * (out_ + a * (m.momentum - a * ray.e * (1.0 - u * u)));
}

/* Integral over time of the polynomial through five nodes of the step (Newton's forward differences). At the end of the
 * step it equals Boole's rule. */
kd_quintic kd_march_later_along(kd_geodesic m, kd_ray ray, kd_stride s, float begin)
{
    float f0 = kd_march_later(m, ray, s, 0.0), f1 = kd_march_later(m, ray, s, 0.25),
          f2 = kd_march_later(m, ray, s, 0.5);
    float f3 = kd_march_later(m, ray, s, 0.75), f4 = kd_march_later(m, ray, s, 1.0);
    float d1 = f1 - f0, d2 = f2 - 2.0 * f1 + f0, d3 = f3 - f0 + 3.0 * (f1 - f2),
          d4 = f4 + f0 - 4.0 * (f1 + f3) + 6.0 * f2;
    return kd_quintic(begin, f0, 2.0 * d1 - d2 + (2.0 / 3.0) * d3 - 0.5 * d4,
                      (8.0 / 3.0) * (d2 - d3) + (22.0 / 9.0) * d4, (8.0 / 3.0) * d3 - 4.0 * d4, (32.0 / 15.0) * d4);
}

float kd_march_ago(kd_stride s, float t)
{
    return kd_quintic_at(s.ago, t) + s.along * kd_march_edge(kd_quintic_at(s.w, t));
}

float kd_march_rate(kd_geodesic m, kd_ray ray, float w, float dw, float way)
{
    kd_state y;
    y.w = w;
    y.dw = dw;
    return INGOING ? kd_drag_ingoing(m, y, ray.e, cam.spin, cam.root, way)
                   : kd_drag(m, y, ray.e, cam.spin, cam.root, way);
}

kd_stride kd_stride_of(kd_geodesic m, kd_ray ray, kd_path p, kd_path q, float h, inout kd_march_drag drag)
{
    vec4 a = h * h * kd_path_pull(m, p.y), b = h * h * kd_path_pull(m, q.y);
    kd_stride s;
    s.w = kd_quintic_of(p.y.w, h * p.v.w, a.w, q.y.w, h * q.v.w, b.w);
    s.u = kd_quintic_of(p.y.z, h * p.v.z, a.z, q.y.z, h * q.v.z, b.z);
    s.h = h;
    if (KD_MARCH_TURNS) {
        s.x = kd_quintic_of(p.y.x, h * p.v.x, a.x, q.y.x, h * q.v.x, b.x);
        s.y = kd_quintic_of(p.y.y, h * p.v.y, a.y, q.y.y, h * q.v.y, b.y);
        /* changes the coordinates as comp/lens_map.comp does */
        if (INGOING && drag.returns && drag.way < 0.0 && p.v.w > 0.0) {
            drag.way = 1.0;
            drag.fallen -= 2.0 * kd_drag_fall(p.y.w, cam.spin, cam.root);
        }
        s.way = INGOING ? drag.way : p.v.w > 0.0 && q.v.w > 0.0 ? 1.0 : p.v.w < 0.0 && q.v.w < 0.0 ? -1.0 : 0.0;
        float r0 = h * kd_march_rate(m, ray, p.y.w, p.v.w, s.way), r2 = h * kd_march_rate(m, ray, q.y.w, q.v.w, s.way);
        float r1 = h * kd_march_rate(m, ray, kd_quintic_at(s.w, 0.5), kd_quintic_slope(s.w, 0.5) / h, s.way);
        s.c0 = drag.chi + (INGOING ? drag.fallen : -s.way * kd_drag_fall(p.y.w, cam.spin, cam.root));
        s.c1 = r0;
        s.c2 = 0.5 * (4.0 * r1 - 3.0 * r0 - r2);
        s.c3 = (2.0 / 3.0) * (r0 - 2.0 * r1 + r2);
        drag.chi +=
            s.c1 + s.c2 + s.c3 +
            (INGOING ? 0.0
                     : s.way * (kd_drag_fall(q.y.w, cam.spin, cam.root) - kd_drag_fall(p.y.w, cam.spin, cam.root)));
    }
    if (KD_MARCH_DELAYS) {
        s.along = p.v.w > 0.0 && q.v.w > 0.0 ? 1.0 : p.v.w < 0.0 && q.v.w < 0.0 ? -1.0 : 0.0;
        s.ago = kd_march_later_along(m, ray, s, drag.ago - s.along * kd_march_edge(p.y.w));
        drag.ago = kd_march_ago(s, 1.0);
    }
    return s;
}

kd_march_drag kd_march_drag_of(kd_geodesic m, kd_ray ray)
{
    kd_march_drag drag = kd_march_drag(INGOING ? 0.0 : -cam.twist, -1.0, 0.0, false, -emission.frame.delay);
    if (INGOING) {
        kd_state y;
        y.w = ray.w;
        y.dw = ray.dw;
        kd_rounding off = kd_camera_rounding();
        kd_turning_point b = kd_turning_point_beside(
            m, kd_turning_point_of(m, ray, cam.spin, cam.horizon, cam.root, off), y, cam.horizon, off);
        drag.returns = !kd_escapes(b, y);
        drag.way = drag.returns && y.dw > 0.0 ? 1.0 : -1.0;
        drag.fallen = drag.way > 0.0 ? -2.0 * cam.twist : 0.0;
    }
    return drag;
}

/* Shortens an ellipse M_rr, M_rf, M_ff by the fraction `less` in the direction d. */
vec3 kd_march_shorter(vec3 m, vec2 d, float less)
{
    vec2 md = vec2(m.x * d.x + m.y * d.y, m.y * d.x + m.z * d.y);
    float dd = dot(d, md) * less * less;
    return m - less * vec3(2.0 * d.x * md.x, d.x * md.y + d.y * md.x, 2.0 * d.y * md.y) +
           dd * vec3(d.x * d.x, d.x * d.y, d.y * d.y);
}

/* The ellipse, perpendicular to a ray, that the ray stands for at its crossing n of the plane. To project the footprint
 * perpendicular to the ray, its axis along the ray is multiplied by the cosine of the angle to the normal. The axis
 * then has components in the plane (times the cosine again) and along the normal (times the sine). outwards: 1 if the
 * ray is traced outwards, -1 if inwards. The result is zero for a ray without that crossing. */
kd_spread kd_march_spread(kd_geodesic m, kd_ray ray, uint n, uint at, float outwards)
{
    uint k = at + min(n, ORDERS - 1u) * slice.stride;
    float w = lens[k], size = quantity(KD_LENS_FOOTPRINT, k);
    uint bits = floatBitsToUint(quantity(KD_LENS_SHAPE, k));
    float i = float(bits & 2047u) * (1.0 / 2047.0), j = float((bits >> 11) & 2047u) * (2.0 / 2047.0) - 1.0;
    float both = sqrt(i * (1.0 - i)), apart = i - 0.5,
          all = size * size / (0.5 + sqrt(apart * apart + j * j * both * both));
    vec3 flat_ = all * vec3(i, j * both, 1.0 - i);
    /* Direction of the ray as if space were flat, divided by r. Its components are r'^2 = R(w)/w^4 outwards, L about
     * the axis, and sqrt(Q) along the normal. */
    float w2 = w * w, out2 = max(ray.e * ray.e + w2 * (m.a2 + w * (2.0 * m.k - w * m.d)), 0.0),
          round_ = -m.momentum * w, up2 = max(m.q, 0.0) * w2;
    float plane2 = max(out2 + round_ * round_, 1e-12), c2 = up2 / (up2 + plane2), less = 1.0 - sqrt(c2),
          rise = sqrt(1.0 - c2);
    vec2 d = vec2(outwards * sqrt(out2), round_) * inversesqrt(plane2);
    vec3 across = kd_march_shorter(flat_, d, less);
    vec2 md = vec2(across.x * d.x + across.y * d.y, across.y * d.x + across.z * d.y);
    float dd = dot(d, md), known = w > 0.0 && size < KD_FOOTPRINT_EDGE ? 1.0 : 0.0;
    return kd_spread(known * kd_march_shorter(across, d, less), known * rise * vec3(md - less * dd * d, rise * dd));
}

/* Largest 1/r at which the current ray crosses the plane; 0 if no crossing is known. */
float kd_march_nearest = 0.0;

float kd_march_nearest_of(uint at)
{
    float nearest = 0.0;
    for (uint n = 0u; n < ORDERS; n++) {
        float w = lens[at + n * slice.stride];
        nearest = max(nearest, w);
        if (w <= 0.0)
            break;
    }
    return nearest;
}

kd_midst kd_midst_of(kd_geodesic m, kd_ray ray, kd_stride s, kd_spread spread, uint order, float t)
{
    float w = kd_quintic_at(s.w, t), u = kd_quintic_at(s.u, t), dw = kd_quintic_slope(s.w, t) / s.h,
          du = kd_quintic_slope(s.u, t) / s.h;
    float r = 1.0 / w, fall = dw * r, turn = max(m.q + m.momentum * m.momentum + m.energy2 * u * u, 0.0);
    float phi = 0.0;
    if (KD_MARCH_TURNS)
        phi = -(kd_atan2(kd_quintic_at(s.y, t), kd_quintic_at(s.x, t)) + s.c0 + t * (s.c1 + t * (s.c2 + t * s.c3)) +
                s.way * kd_drag_fall(w, cam.spin, cam.root));
    return kd_midst(w, u, dw, du, ray.e, m.momentum, m.q, r * sqrt(fall * fall + turn), phi, spread, order,
                    KD_MARCH_DELAYS ? kd_march_ago(s, t) : 0.0, kd_march_nearest);
}

/* The march attenuates light of a node by half of that node's own depth and by all depth before it. In Gauss's method
 * of three stages (Hairer, Norsett & Wanner 1993, II.7), with coefficients a_ij and b_j and depths x_j, the attenuation
 * is sum_j a_ij/b_j x_j. This function returns the resulting difference of light, to first order in depth. The
 * difference is 0 where light is proportional to depth, because the sum over the three nodes is then exact. */
vec3 kd_march_rest(vec4 one, vec4 two, vec4 three)
{
    float x = one.w + two.w + three.w;
    vec3 rest = 0.0809475 * (one.rgb * two.w - two.rgb * (one.w - three.w) - three.rgb * two.w) -
                0.0352425 * (one.rgb * three.w - three.rgb * one.w);
    return x < 8.0 ? exp(-0.5 * x) * rest : vec3(0.0);
}

/* Compensated sum of many small terms (Kahan 1965). In a plain sum the rounding of thousands of similar terms adds up
 * to a relative error of 5e-5. */
void kd_march_add(inout float sum, inout float off, float more)
{
    precise float y = more - off, t = sum + y;
    precise float rounded = t - sum;
    off = rounded - y;
    sum = t;
}

void kd_march_add(inout vec3 sum, inout vec3 off, vec3 more)
{
    precise vec3 y = more - off, t = sum + y;
    precise vec3 rounded = t - sum;
    off = rounded - y;
    sum = t;
}

/* Integrates a part of a step inside the volumes. The part's light and depth are summed separately, and its
 * transmission is the exponential of its depth. */
void kd_march_part(inout kd_beam beam, kd_geodesic m, kd_ray ray, kd_stride s, kd_spread spread, uint order, float from,
                   float to, inout float stretch, inout bool lost)
{
    float coarse = 4.0 / float(FINE), front = beam.through, depth = 0.0, depth_off = 0.0;
    vec3 light = vec3(0.0), light_off = vec3(0.0), seen = vec3(0.0), seen_off = vec3(0.0);
    /* length of the next stretch as a fraction of the step. 0 means unknown: a trial stretch of length 0 then
     * determines it */
    float wish = stretch / s.h;
    for (uint n = 0u; n < KD_MARCH_LOOPS && from < to && beam.through > KD_MARCH_OPAQUE && KD_MARCH_MAY; n++) {
        KD_MARCH_SPEND(KD_MARCH_STRETCH)
        float left = to - from, length_ = wish > 0.0 ? left / ceil(min(left / wish, 16777216.0)) : 0.0, most = 1.0,
              least = KD_MARCH_SHORTEST;
        float next = from + length_;
        length_ = next - from; /* length of the stretch after rounding */
        kd_beam trial = kd_beam(vec3(0.0), 0.0, beam.through);
        kd_stokes_trial polarised = kd_stokes_begin();
        KD_PROBE_TRY(length_ > 0.0 ? 3.0 : 1.0)
        float far = min(inversesqrt(beam.through), KD_MARCH_BEHIND);
        vec4 one = vec4(0.0), two = vec4(0.0), three = vec4(0.0); /* light and depth at each of the three nodes */
        for (int k = 0; k < (length_ > 0.0 ? 3 : 1); k++) {       /* one node is enough for the trial stretch */
            float weight = k == 1 ? 4.0 / 9.0 : 5.0 / 18.0, x = k == 0 ? 0.1127016654 : k == 1 ? 0.5 : 0.8872983346;
            kd_midst p = kd_midst_of(m, ray, s, spread, order, from + x * length_);
            kd_stokes_here = kd_stokes(vec4(0.0), 0.0, vec3(0.0), vec3(0.0));
            kd_medium medium = kd_medium_at(p);
            float r = 1.0 / p.w, au = cam.spin * p.u, way = (r * r + au * au) * s.h;
            kd_beam_along(trial, medium, weight * length_ * way);
            if (KD_HAS(stokes))
                kd_stokes_along(polarised, weight * length_ * way);
            one = two;
            two = three;
            three = vec4(min(weight * length_ * way * medium.light, KD_BEAM_MOST),
                         min(weight * length_ * way * medium.depth, KD_MARCH_DEEP));
            float allowed = min(min(medium.grain * far, KD_MARCH_WAY * r) / (p.speed * s.h),
                                KD_MARCH_DEPTH / max(medium.depth * way, 1e-30));
            if (KD_HAS(stokes))
                allowed = min(allowed, max(KD_MARCH_TURN / max(length(kd_stokes_here.turns) * way, 1e-30),
                                           KD_MARCH_TURNED * allowed));
            most = min(most, coarse * allowed);
            least = min(least, KD_MARCH_LEAST * coarse * KD_MARCH_WAY * r / (p.speed * s.h));
        }
        wish = max(most, least);
        if (length_ > 0.0 && length_ <= KD_MARCH_TOO_LONG * wish) {
            vec3 rest = beam.through * kd_march_rest(one, two, three);
            if (KD_HAS(stokes)) {
                vec4 all = kd_stokes_take(polarised);
                rest = vec3(all.x) - trial.light;
                kd_march_add(seen, seen_off, all.yzw);
            }
            KD_PROBE_TAKE(vec3(0.0), trial.light, rest)
            kd_march_add(light, light_off, min(trial.light + rest, KD_BEAM_MOST));
            kd_march_add(depth, depth_off, one.w + two.w + three.w);
            beam.through = KD_HAS(stokes) ? kd_jones_through(kd_stokes_front) : front * exp(-depth);
            from = length_ < left ? next : to;
        }
    }
    beam.light = min(beam.light + light, KD_BEAM_MOST);
    if (KD_HAS(stokes))
        kd_stokes_seen = kd_stokes_sound(vec4(beam.light.x, kd_stokes_seen + seen)).yzw;
    stretch = wish * s.h;
    bool undone = from < to && beam.through > KD_MARCH_OPAQUE;
#ifdef KD_PIECES
    kd_march_at.waits = undone && !KD_MARCH_MAY;
    kd_march_at.from = kd_march_at.waits ? from : 0.0;
#endif
    lost = lost || (undone && !KD_MARCH_WAITS);
    beam.through = beam.through > KD_MARCH_OPAQUE ? beam.through : 0.0;
}

/* True if a ray can reach the volumes. For a ray from outside, w'^2 = R(w) must be positive at their outer edge. */
bool kd_march_meets(kd_geodesic m, kd_ray ray)
{
    float w = emission.frame.along_least, w2 = w * w;
    return ray.w >= w || ray.e * ray.e + w2 * (m.a2 + w * (2.0 * m.k - w * m.d)) > 0.0;
}

/* State of a ray. The current step goes from p to q. side: side of the plane that p is on. crossed: number of crossings
 * so far. stretch: length of the next stretch, in Mino time. steps: number of steps. goes: true if there is a current
 * step. lost: true if the ray's end was not found. left: Mino time from p to a surface that ends the ray
 * (light/meet.glsl). */
struct kd_march_way {
    kd_geodesic m;
    kd_path p, q;
    kd_stride s;
    kd_march_drag drag;
    float rate2, side, h, stretch, left;
    uint crossed, steps;
    bool goes, lost;
};

/* Least and largest of a quintic's Bernstein coefficients, which are bounds of its values in the step (Farouki & Rajan
 * 1987). */
vec2 kd_quintic_hull(kd_quintic q)
{
    float b1 = q.c0 + 0.2 * q.c1, b2 = q.c0 + 0.4 * q.c1 + 0.1 * q.c2, b3 = q.c0 + 0.6 * q.c1 + 0.3 * q.c2 + 0.1 * q.c3;
    float b4 = q.c0 + 0.8 * q.c1 + 0.6 * q.c2 + 0.4 * q.c3 + 0.2 * q.c4, b5 = q.c0 + q.c1 + q.c2 + q.c3 + q.c4 + q.c5;
    return vec2(min(min(min(q.c0, b1), min(b2, b3)), min(b4, b5)), max(max(max(q.c0, b1), max(b2, b3)), max(b4, b5)));
}

bool kd_march_crosses(kd_march_way y) { return y.q.y.z * y.side < 0.0; }

/* True if a step may enter the volumes, or may contain a crossing with light. */
bool kd_march_matters(kd_march_way y)
{
    vec2 w = kd_quintic_hull(y.s.w), u = kd_quintic_hull(y.s.u);
    bool within = w.y >= emission.frame.along_least && w.x <= emission.frame.along_most &&
                  u.y >= -emission.frame.along_u && u.x <= emission.frame.along_u;
    bool beside =
        !(emission.frame.along_hollow > 0.0) || u.x < -emission.frame.along_hollow || u.y > emission.frame.along_hollow;
    return (within && beside) || (KD_GLOWS && kd_march_crosses(y));
}

/* Completes the current step. The next step starts where this one ends, unless this was the last step. */
void kd_march_leave(inout kd_march_way y)
{
    bool crosses = kd_march_crosses(y), falls = y.q.y.w >= cam.horizon && (!INGOING || y.q.v.w > 0.0);
    /* A ray that is beyond the volumes, moves outwards and is accelerated outwards does not come back. */
    bool gone =
        y.q.v.w < 0.0 && y.q.y.w < emission.frame.along_least && (y.q.y.w <= 0.0 || kd_path_pull(y.m, y.q.y).w <= 0.0);
    y.side = crosses ? -y.side : y.side;
    y.crossed += crosses ? 1u : 0u;
    y.left -= y.h;
    y.goes = y.goes && !falls && !gone && y.left > 0.0;
    y.p = y.q;
}

/* Takes the next step. Step sizes and their limit are those of a ray that escapes (ray/escape.glsl). */
void kd_march_next(inout kd_march_way y, kd_ray ray)
{
    if (INGOING)
        y.h = KD_PI / (float(STEPS) * sqrt(y.rate2 + 6.0 * y.m.k * y.p.y.w));
    y.q = kd_path_step(y.m, y.p, y.h);
    if (INGOING && y.q.y.w > cam.horizon && y.q.v.w < 0.0)
        y.q.v.w = kd_leaving(y.m, y.q.y.w, ray.e);
    y.lost = y.lost || y.steps++ >= 12u * STEPS; /* y.lost is set if the ray circles without end */
    y.goes = !y.lost && kd_is_finite(y.q.y.w);   /* stops if w is not finite, because the ray has fallen in */
    y.s = kd_stride_of(y.m, ray, y.p, y.q, y.h, y.drag);
}

/* Advances to the next step that may have light. The steps before it are cheap and have a loop of their own, because
 * lavapipe skips work only by leaving a loop. */
void kd_march_advance(inout kd_march_way y, kd_ray ray)
{
    bool far = true;
    while (y.goes && far) {
        kd_march_next(y, ray);
        far = y.goes && !kd_march_matters(y);
        if (far)
            kd_march_leave(y);
    }
}

/* Integrates the current step. */
void kd_march_through(inout kd_beam beam, inout kd_march_way y, kd_ray ray, uvec2 place, uint at)
{
    const float none = 2.0;
    kd_stride s = y.s;
    float turn_w = y.p.v.w * y.q.v.w < 0.0 ? kd_quintic_root(kd_quintic_derived(s.w), 0.0, 0.0, 1.0) : none;
    float turn_u = y.p.v.z * y.q.v.z < 0.0 ? kd_quintic_root(kd_quintic_derived(s.u), 0.0, 0.0, 1.0) : none;
    float plane = kd_march_crosses(y) ? kd_quintic_root(s.u, 0.0, 0.0, 1.0) : none;
    float t = 0.0, last = min(y.left / y.h, 1.0);
#ifdef KD_PIECES
    t = kd_march_at.from;
    kd_march_at.from = 0.0;
#endif
    while (t < last && beam.through > 0.0) {
        KD_MARCH_SPEND(KD_MARCH_ENDS)
        float end = last;
        end = turn_w > t ? min(end, turn_w) : end;
        end = turn_u > t ? min(end, turn_u) : end;
        end = plane > t ? min(end, plane) : end;
        if (emission.frame.along_knot > 0.0) {
            float before = kd_quintic_at(s.w, t) - emission.frame.along_knot,
                  behind = kd_quintic_at(s.w, end) - emission.frame.along_knot;
            float knot = before * behind < 0.0 ? kd_quintic_root(s.w, emission.frame.along_knot, t, end) : none;
            end = knot > t ? min(end, knot) : end;
        }
        float from = t, to = end, up = t < plane ? y.side : -y.side;
        kd_quintic_clip(s.w, emission.frame.along_least, 1.0, from, to);
        kd_quintic_clip(s.w, emission.frame.along_most, -1.0, from, to);
        kd_quintic_clip(s.u, up * emission.frame.along_u, -up, from, to);
        kd_quintic_clip(s.u, up * (emission.frame.along_hollow > 0.0 ? emission.frame.along_hollow : -1.0), up, from,
                        to);
        kd_spread spread = kd_spread(vec3(0.0), vec3(0.0));
        uint order = 0u;
        /* order of the crossing nearest on the ray: the next one or, while the ray moves away from the plane, the
         * previous one */
        if (KD_OVERS || (KD_MARCH_TURNS && ORDERS > 0)) {
            uint passed = y.crossed + (t >= plane ? 1u : 0u);
            bool leaves =
                passed > 0u && kd_quintic_at(s.u, 0.5 * (from + to)) * kd_quintic_slope(s.u, 0.5 * (from + to)) > 0.0;
            order = leaves ? passed - 1u : passed;
        }
        if (KD_MARCH_TURNS && ORDERS > 0)
            spread = kd_march_spread(y.m, ray, order, at, kd_quintic_slope(s.w, 0.5 * (from + to)) < 0.0 ? 1.0 : -1.0);
        KD_PROBE_BEFORE(beam)
        kd_march_part(beam, y.m, ray, s, spread, order, from, to, y.stretch, y.lost);
        KD_PROBE_STRETCH(s, from, to, beam)
        if (KD_MARCH_WAITS)
            break;
        if (end == plane && KD_GLOWS && y.crossed < ORDERS && beam.through > 0.0) {
            float w = lens[at + y.crossed * slice.stride];
            if (w != 0.0)
                KD_MARCH_MEET(beam, w, y.crossed, place, at);
        }
        t = end;
    }
}

kd_march_way kd_march_begin(kd_ray ray, float left)
{
    kd_march_way y;
    y.m = kd_geodesic_of(ray, KD_HOLE_OF(cam), cam.u, cam.s);
    y.p = kd_path_start(ray, cam.u, cam.s);
    y.q = y.p;
    y.rate2 = max(ray.l * ray.l + ray.p * ray.p, ray.e * ray.e);
    y.h = KD_PI / (float(STEPS) * sqrt(y.rate2));
    y.side = cam.u < 0.0 || (cam.u == 0.0 && ray.p < 0.0) ? -1.0 : 1.0;
    y.stretch = 0.0;
    y.left = left;
    y.crossed = 0u;
    y.steps = 0u;
    y.drag = kd_march_drag_of(y.m, ray);
    y.goes = kd_march_meets(y.m, ray) && !(INGOING && !kd_from_outside(y.m, ray.w, ray.e, cam.spin, cam.horizon));
    y.lost = false;
    return y;
}

#ifdef KD_PIECES
/* Repeats the steps that earlier pieces have completed, to restore the state of the ray. */
void kd_march_again(inout kd_march_way y, kd_ray ray)
{
    y.stretch = kd_march_at.stretch;
    while (y.goes && y.steps < kd_march_at.steps) {
        kd_march_next(y, ray);
        kd_march_leave(y);
    }
    y.lost = y.lost || y.steps < kd_march_at.steps;
    y.goes = y.goes && !y.lost;
}
#endif

/* Follows one ray up to the Mino time `time`. crossings: number of times that the ray crosses the plane before that
 * time. Light from the end of the ray is left out. */
void kd_march_follow(inout kd_beam beam, uvec2 place, uint at, float time, uint crossings)
{
    kd_ray ray = kd_camera_ray(place.x, place.y);
    kd_march_way y = kd_march_begin(ray, time);
    if (KD_MARCH_TURNS && ORDERS > 0)
        kd_march_nearest = kd_march_nearest_of(at);
#ifdef KD_PIECES
    kd_march_again(y, ray);
#endif
    if (KD_HAS(stokes)) {
        kd_stokes_right = kd_polarization_right(place);
#ifndef KD_PIECES
        kd_stokes_seen = vec3(0.0);
        kd_stokes_front = kd_jones_one();
#endif
    }
    for (uint n = 0u; n < KD_MARCH_LOOPS && y.goes && beam.through > 0.0; n++) {
        kd_march_advance(y, ray);
        if (y.goes) {
            kd_march_through(beam, y, ray, place, at);
            if (KD_MARCH_WAITS)
                break;
            kd_march_leave(y);
        }
    }
#ifdef KD_PIECES
    kd_march_at.steps = y.steps - 1u;
    kd_march_at.stretch = y.stretch;
    if (KD_MARCH_WAITS)
        return;
#endif
    if (y.lost || (y.goes && beam.through > 0.0))
        KD_MARCH_GIVEN_UP(beam);
    KD_PROBE_MARCHED(y.steps)
    for (uint n = y.crossed; KD_GLOWS && n < min(ORDERS, crossings) && beam.through > 0.0;
         n++) { /* composes the remaining crossings, which are beyond the volumes */
        float w = lens[at + n * slice.stride];
        if (w == 0.0)
            break;
        KD_MARCH_MEET(beam, w, n, place, at);
    }
}

#endif
