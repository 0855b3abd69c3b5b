/* Kernel: makes the lens map of a square grid of rays on listed pixels. It interpolates in the map of the picture's
 * grid, which has one ray in the middle of each pixel. Interpolated rays need no tracing. They give the source across
 * the pixel, as the ray bundle of James, von Tunzelmann, Franklin & Thorne 2015 (Class. Quantum Grav. 32, 065001,
 * appendix A.2) does to first order.
 *
 * One biquadratic polynomial through a pixel and its eight neighbours interpolates w and each other quantity of a
 * crossing. For directions in the sky it interpolates the unit vector. At the distance x from the middle, in sides of a
 * pixel, the polynomial's error is x(x^2 - 1)/6 times the third difference along x, and so at most 1/17 of that
 * difference. The same holds along y.
 *
 * If MARK is set, the kernel interpolates nothing. It only tests whether interpolation is accurate, and writes 1 or 0
 * for each listed pixel to the words after the list. Three conditions must hold. All nine rays must have the same fate,
 * and crossings of the same orders. In the metric of the source, the second differences must be less than BENT times
 * the first. For crossings the third differences must be less than TWISTED times the first, so that the error is below
 * 0.004 of a pixel. The word is always 0 at the edges of the picture, and at the edges of the band in the buffer. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_BETWEEN(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/math.glsl"
#include "ray/planes.glsl"
layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
struct kd_between { KD_BETWEEN_FIELDS_(F, U) };
layout(push_constant) uniform Push { kd_between push_; };
kd_between push; /* copied before the first branch, for the reason given in footprint.comp */
layout(set = 0, binding = 0) buffer Listed { float listed[]; };
layout(set = 0, binding = 1) readonly buffer LensMap { float lens[]; };

const float BENT = 0.3, TWISTED = 0.06;
const bool SKY = (QUANTITIES & KD_LENS_SKY_U) != 0u, FATE = (QUANTITIES & KD_LENS_FATE) != 0u;

/* A biquadratic polynomial: its value in the middle, slopes along x and y, half second differences, and the mixed
 * terms xy, x^2 y, x y^2, x^2 y^2. */
struct kd_biquadratic { vec3 slope_x, slope_y, bend_x, bend_y, xy, xxy, xyy, xxyy; };

vec3 turned(vec3 d, bool angle)
{
    if (angle)
        d.y = kd_turned(d.y);
    return d;
}

/* Values that the map stores for the ray at index `at`. For a crossing: w and a second quantity. For the sky: a unit
 * vector. */
vec3 crossing(uint n, uint quantity, uint at)
{
    return vec3(lens[at + n * push.map_stride], lens[at + (kd_plane(quantity) + n) * push.map_stride], 0.0);
}

vec3 direction(uint at)
{
    float u = lens[at + kd_plane(KD_LENS_SKY_U) * push.map_stride], s = sqrt(max(1.0 - u * u, 0.0));
    kd_phasor phi = kd_cos_sin(lens[at + kd_plane(KD_LENS_SKY_PHI) * push.map_stride]);
    return vec3(s * phi.c, s * phi.s, u);
}

/* The values that are interpolated for a ray: those of crossing n, or those of the sky if n is ORDERS. */
vec3 spot(uint n, uint quantity, uint at) { return n < ORDERS ? crossing(n, quantity, at) : direction(at); }

kd_biquadratic patch_of(uint n, uint quantity, uint at)
{
    const bool angle = n < ORDERS && quantity == KD_LENS_PHI;
    vec3 own = spot(n, quantity, at);
#define APART(dx, dy) turned(spot(n, quantity, at + (dx) + (dy) * push.width) - own, angle)
    vec3 l = APART(-1, 0), r = APART(1, 0), u = APART(0, -1), d = APART(0, 1);
    vec3 lu = APART(-1, -1), ru = APART(1, -1), ld = APART(-1, 1), rd = APART(1, 1);
    kd_biquadratic p;
    p.slope_x = 0.5 * (r - l);
    p.slope_y = 0.5 * (d - u);
    p.bend_x = 0.5 * (r + l);
    p.bend_y = 0.5 * (d + u);
    p.xy = 0.25 * (rd - ld - ru + lu);
    p.xxy = 0.25 * (rd + ld - ru - lu) - p.slope_y;
    p.xyy = 0.25 * (rd - ld + ru - lu) - p.slope_x;
    p.xxyy = 0.25 * (rd + ld + ru + lu) - p.bend_x - p.bend_y;
    return p;
}

vec3 change(kd_biquadratic p, float x, float y)
{
    return x * (p.slope_x + x * p.bend_x) + y * (p.slope_y + y * p.bend_y) +
           x * y * (p.xy + x * p.xxy + y * p.xyy + x * y * p.xxyy);
}

/* True if the map is nearly linear over a patch: its second differences are small relative to its first ones. m: metric
 * of the source. */
bool straight(kd_biquadratic p, vec3 m)
{
    vec3 i = m * p.slope_x, j = m * p.slope_y, a = 2.0 * m * p.bend_x, b = 2.0 * m * p.bend_y, c = m * p.xy;
    return dot(a, a) + dot(b, b) + dot(c, c) < BENT * BENT * (dot(i, i) + dot(j, j)); /* false for NaN */
}

/* True if the error of the polynomial of crossing n is small relative to the polynomial's slopes. The error is the
 * third difference along x and y, which needs a ray two pixels away. There are four such rays; each that has the
 * crossing gives one difference. The second difference alone is not enough, because it is 0 at a pixel where the map
 * bends in opposite directions on both sides. */
bool even(uint n, uint quantity, uint at, kd_biquadratic p, vec3 m, uint x, uint y)
{
    vec3 own = crossing(n, quantity, at), i = m * p.slope_x, j = m * p.slope_y;
    float slope = dot(i, i) + dot(j, j), most = 0.0;
    for (int k = 0; k < 4; k++) {
        bool along_x = k < 2, forth = (k & 1) == 0;
        uint place = along_x ? x : y, end = along_x ? push.width : push.map_rows;
        if (forth ? place + 2u >= end : place < 2u)
            continue;
        int far = (forth ? 2 : -2) * (along_x ? 1 : int(push.width));
        vec3 second = crossing(n, quantity, at + far);
        vec3 s = forth ? (along_x ? p.slope_x : p.slope_y) : -(along_x ? p.slope_x : p.slope_y),
             b = along_x ? p.bend_x : p.bend_y;
        vec3 third = m * (turned(second - own, quantity == KD_LENS_PHI) - 2.0 * s - 4.0 * b);
        most = max(most, second.x > 0.0 ? dot(third, third) : 0.0);
    }
    return most < TWISTED * TWISTED * slope;
}

/* True if all nine rays have crossings of the same orders and the same fate. */
bool alike(uint at)
{
    bool same = true;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            uint there = at + dx + dy * push.width;
            for (uint n = 0; n < ORDERS; n++) {
                float own = lens[at + n * push.map_stride], other = lens[there + n * push.map_stride];
                same = same && own >= 0.0 && (own > 0.0 ? other > 0.0 : other == 0.0);
            }
            if (FATE)
                same = same && lens[there + kd_plane(KD_LENS_FATE) * push.map_stride] ==
                                   lens[at + kd_plane(KD_LENS_FATE) * push.map_stride];
        }
    return same;
}

bool escapes(uint at) { return SKY && lens[at + kd_plane(KD_LENS_FATE) * push.map_stride] == KD_FATE_ESCAPED; }

bool may(uint x, uint y, uint at)
{
    if (x == 0 || x + 1 >= push.width || y == 0 || y + 1 >= push.map_rows)
        return false;
    bool yes = alike(at);
    for (uint n = 0; n < ORDERS; n++) {
        float w = lens[at + n * push.map_stride];
        if (!(w > 0.0))
            break;
        float r = 1.0 / w;
        kd_biquadratic p = patch_of(n, (QUANTITIES & KD_LENS_PHI) != 0u ? KD_LENS_PHI : KD_LENS_W, at);
        vec3 m = vec3(r * r, (QUANTITIES & KD_LENS_PHI) != 0u ? r : 0.0, 0.0);
        yes = yes && straight(p, m) &&
              even(n, (QUANTITIES & KD_LENS_PHI) != 0u ? KD_LENS_PHI : KD_LENS_W, at, p, m, x, y);
    }
    if (escapes(at))
        yes = yes && straight(patch_of(ORDERS, 0u, at), vec3(1.0));
    return yes;
}

/* Offset, along one side, of ray k of a pixel from the pixel's middle. Each invocation processes one pixel, and all
 * rays of that pixel use the same polynomials. */
float along(uint k) { return (float(k) + 0.5) / float(SIDE) - 0.5; }

/* Interpolates w of crossing n and a second quantity, and writes both for all rays of a pixel. */
void interpolate(uint n, uint quantity, uint at, uint to)
{
    kd_biquadratic p = patch_of(n, quantity, at);
    vec3 own = crossing(n, quantity, at);
    for (uint k = 0; k < SIDE * SIDE; k++) {
        vec3 v = own + change(p, along(k % SIDE), along(k / SIDE));
        listed[to + k + n * push.stride] = max(v.x, 1e-30);
        if (quantity != KD_LENS_W)
            listed[to + k + (kd_plane(quantity) + n) * push.stride] = v.y;
    }
}

void interpolate_sky(uint at, uint to)
{
    kd_biquadratic p = patch_of(ORDERS, 0u, at);
    vec3 own = direction(at);
    for (uint k = 0; k < SIDE * SIDE; k++) {
        vec3 v = own + change(p, along(k % SIDE), along(k / SIDE));
        listed[to + k + kd_plane(KD_LENS_SKY_U) * push.stride] = v.z * inversesqrt(dot(v, v));
        listed[to + k + kd_plane(KD_LENS_SKY_PHI) * push.stride] = atan(v.y, v.x);
    }
}

/* Copies a value to all rays of a pixel. */
void copy(uint plane, uint at, uint to)
{
    float value = lens[at + plane * push.map_stride];
    for (uint k = 0; k < SIDE * SIDE; k++)
        listed[to + k + plane * push.stride] = value;
}

void fill(uint at, uint to)
{
    const uint beside[] = { KD_LENS_W, KD_LENS_PHI, KD_LENS_DELAY, KD_LENS_SLOPE };
    for (uint n = 0; n < ORDERS; n++) {
        if (!(lens[at + n * push.map_stride] > 0.0)) {
            copy(n, at, to);
            continue;
        }
        for (int i = 0; i < 4; i++) /* w has been written together with another quantity */
            if ((QUANTITIES & beside[i]) != 0u &&
                (i > 0 || (QUANTITIES & (KD_LENS_PHI | KD_LENS_DELAY | KD_LENS_SLOPE)) == 0u))
                interpolate(n, beside[i], at, to);
    }
    if (FATE)
        copy(kd_plane(KD_LENS_FATE), at, to);
    if (SKY && escapes(at))
        interpolate_sky(at, to);
}

void main()
{
    push = push_;
    uint pixel = push.first + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= push.count)
        return;
    uint x = uint(listed[push.list + 2 * pixel]), y = uint(listed[push.list + 2 * pixel + 1]) - push.row0,
         at = y * push.width + x;
    if (MARK)
        listed[push.list + 2 * push.marks + pixel] = may(x, y, at) ? 1.0 : 0.0;
    else
        fill(at, pixel * SIDE * SIDE);
}
