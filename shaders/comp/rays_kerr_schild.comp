/* Kernel: traces listed rays by the usual method, Hamilton's equations in ingoing Cartesian Kerr-Schild coordinates,
 * for comparison.
 *
 *   H = (p.p - E^2 - f (E + l.p)^2)/2,  f = r^2 (2r - q^2)/(r^4 + a^2 z^2),
 *   l = ((rx + ay)/(r^2 + a^2), (ry - ax)/(r^2 + a^2), z/r)
 *
 * A ray traced backwards is a photon that moves away from the observer in the mirrored spacetime (t, phi) -> (-t,
 * -phi). This photon falls through the future horizon, where these coordinates are regular. The independent variable s,
 * with d(lambda) = r ds, makes the Hamiltonian r H, which has the same null orbits. Steps of constant size then shrink
 * with r, and stay symplectic.
 *
 * METHOD is 0, 1 or 2. 0 is symplectic Euler, p first, with one fixed-point iteration, as in common web shaders. 1 is
 * the classical Runge-Kutta method of order 4. 2 is M. Tao's extended phase space (2016, Phys. Rev. E 94, 043303) with
 * Yoshida's composition of order 6, solution A (1990, Phys. Lett. A 150, 262). Crossings of z = 0 are found by cubic
 * Hermite interpolation. The start (position and momentum) comes from the host in double. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_RAYS(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/math.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;

layout(push_constant) uniform Push { uint first, count; }
push;
layout(set = 0, binding = 0) readonly buffer Rays
{
    float spin, horizon_r, far;
#define F(name) float name;
    KD_HOLE_MORE_FIELDS_(F)
#undef F
    /* eight numbers for each ray: x, y, z, p_x, p_y, p_z; then 1/r and azimuth of the crossing before the start, 0 and
     * 0 if there is none */
    float list[];
}
rays;
layout(set = 0, binding = 1) writeonly buffer Ends { float ends[]; };
#include "ray/trace.glsl"

/* Tao's omega, in units of 1/s. If omega is small, the copies diverge on long orbits. If it is large, accuracy and
 * phase suffer. Among 0.1, 0.5, 2 and 10 the value 0.1 was the most accurate, by factors of 15 to 10^4 over the half
 * turns of a ray. */
#define KD_BIND 0.1

struct kd_point { vec3 x, p; };

float radius(vec3 x)
{
    float a = rays.spin, rho2 = dot(x, x) - a * a, az = a * x.z;
    float root = sqrt(rho2 * rho2 + 4.0 * az * az);
    return sqrt(rho2 > 0.0 ? 0.5 * (rho2 + root) : 2.0 * az * az / max(root - rho2, 1e-30));
}

/* d/ds of (x, p) under r H, with E = 1. */
kd_point flow(vec3 x, vec3 p)
{
    float a = rays.spin, r = radius(x), r2 = r * r, q = 1.0 / (r2 + a * a), den = 1.0 / (r2 * r2 + a * a * x.z * x.z);
    float f = r2 * (2.0 * r - rays.charge2) * den;
    /* gradient of r: (r^2 x, r^2 y, (r^2 + a^2) z) r / (r^4 + a^2 z^2) */
    vec3 dr = vec3(r2 * x.x, r2 * x.y, (r2 + a * a) * x.z) * (r * den);
    vec3 l = vec3((r * x.x + a * x.y) * q, (r * x.y - a * x.x) * q, x.z / r);
    float s = 1.0 + dot(l, p);
    float in_plane = x.x * p.x + x.y * p.y;
    vec3 df =
        ((6.0 * r2 - 2.0 * rays.charge2 * r) * dr - f * (4.0 * r2 * r * dr + vec3(0.0, 0.0, 2.0 * a * a * x.z))) * den;
    vec3 ds = dr * (in_plane * q - (l.x * p.x + l.y * p.y) * 2.0 * r * q - x.z * p.z / r2) +
              vec3((r * p.x - a * p.y) * q, (r * p.y + a * p.x) * q, p.z / r);
    float h = 0.5 * (dot(p, p) - 1.0 - f * s * s);
    kd_point o;
    o.x = r * (p - f * s * l);
    o.p = r * (0.5 * s * s * df + f * s * ds) - h * dr;
    return o;
}

kd_point euler(kd_point y, float h)
{
    kd_point k = flow(y.x, y.p);
    k = flow(y.x, y.p + h * k.p);
    vec3 p = y.p + h * k.p;
    kd_point o;
    o.p = p;
    o.x = y.x + h * flow(y.x, p).x;
    return o;
}

kd_point runge_kutta(kd_point y, float h)
{
    kd_point a = flow(y.x, y.p), b = flow(y.x + 0.5 * h * a.x, y.p + 0.5 * h * a.p);
    kd_point c = flow(y.x + 0.5 * h * b.x, y.p + 0.5 * h * b.p), d = flow(y.x + h * c.x, y.p + h * c.p), o;
    o.x = y.x + h * (1.0 / 6.0) * (a.x + 2.0 * (b.x + c.x) + d.x);
    o.p = y.p + h * (1.0 / 6.0) * (a.p + 2.0 * (b.p + c.p) + d.p);
    return o;
}

/* The two copies of phase space, (x, p) and (x', p'), in Tao's method. */
struct kd_copies { kd_point a, b; };

kd_copies drift_a(kd_copies y, float h)
{
    kd_point k = flow(y.a.x, y.b.p);
    y.a.p += h * k.p;
    y.b.x += h * k.x;
    return y;
}
kd_copies drift_b(kd_copies y, float h)
{
    kd_point k = flow(y.b.x, y.a.p);
    y.b.p += h * k.p;
    y.a.x += h * k.x;
    return y;
}
/* Rotation that couples the copies. (x - x', p - p') rotates by the angle 2 omega h. t: cosine and sine of that angle.
 */
kd_copies bind(kd_copies y, kd_phasor t)
{
    vec3 sx = 0.5 * (y.a.x + y.b.x), sp = 0.5 * (y.a.p + y.b.p), dx = 0.5 * (y.a.x - y.b.x), dp = 0.5 * (y.a.p - y.b.p);
    vec3 rx = t.c * dx + t.s * dp, rp = t.c * dp - t.s * dx;
    y.a.x = sx + rx;
    y.b.x = sx - rx;
    y.a.p = sp + rp;
    y.b.p = sp - rp;
    return y;
}
kd_copies tao_2(kd_copies y, float h, kd_phasor t)
{
    y = drift_a(y, 0.5 * h);
    y = drift_b(y, 0.5 * h);
    y = bind(y, t);
    y = drift_b(y, 0.5 * h);
    return drift_a(y, 0.5 * h);
}
const float YOSHIDA[4] = float[4](0.784513610477560, 0.235573213359357, -1.17767998417887, 1.315186320683906);

kd_copies tao_6(kd_copies y, float h, kd_phasor turns[4])
{
    for (int i = 0; i < 7; i++) {
        int k = i < 4 ? i : 6 - i;
        y = tao_2(y, h * YOSHIDA[k], turns[k]);
    }
    return y;
}

/* Cubic Hermite interpolation at the fraction s of a step, from values and derivatives at both ends. */
float hermite(float y0, float d0, float y1, float d1, float s)
{
    float c2 = 3.0 * (y1 - y0) - 2.0 * d0 - d1, c3 = d0 + d1 - 2.0 * (y1 - y0);
    return y0 + s * (d0 + s * (c2 + s * c3));
}
float hermite_slope(float y0, float d0, float y1, float d1, float s)
{
    float c2 = 3.0 * (y1 - y0) - 2.0 * d0 - d1, c3 = d0 + d1 - 2.0 * (y1 - y0);
    return d0 + s * (2.0 * c2 + 3.0 * s * c3);
}

/* Number of turns about the axis that a step from x to y adds to the angle of atan2. The number of turns changes where
 * the chord crosses the half plane x < 0. Very close to the axis the ray and the chord may pass the axis on opposite
 * sides. */
float turned(vec3 x, vec3 y)
{
    if ((x.y < 0.0) == (y.y < 0.0) || (x.x * y.y - y.x * x.y) / (y.y - x.y) > 0.0)
        return 0.0;
    return y.y < 0.0 ? 1.0 : -1.0;
}

/* Boyer-Lindquist azimuth of the source minus that of the observer. */
float azimuth(vec3 x, float turns)
{
    float a = rays.spin, r = radius(x), root = rays.horizon_r - 1.0;
    float twist = root > 1e-4 ? a / (2.0 * root) * kd_log(1.0 + 2.0 * root / (r - 1.0 - root)) : a / (r - 1.0);
    return -(kd_atan2(x.y, x.x) + 2.0 * KD_PI * turns - kd_atan2(a, r) + twist);
}

void main()
{
    if (gl_GlobalInvocationID.x >= push.count)
        return;
    uint i = push.first + gl_GlobalInvocationID.x, in_ = 8 * i, o = (3 * ORDERS + 4) * i;
    kd_copies y;
    y.a.x = vec3(rays.list[in_], rays.list[in_ + 1], rays.list[in_ + 2]);
    y.a.p = vec3(rays.list[in_ + 3], rays.list[in_ + 4], rays.list[in_ + 5]);
    y.b = y.a;
    for (uint n = 0; n < 3 * ORDERS + 4; n++)
        ends[o + n] = 0.0;

    /* lavapipe leaves all loops of an invocation after 65535 rounds in total, with intermediate values in the
     * variables. `most`, the limit of rounds, is therefore lower; a ray that needs more rounds stays undecided. With
     * the most steps that src/render/rays/check.c accepts, `most` is 16 half turns for Tao's method and 60 for the
     * others. A ray that passes the hole takes 8 to 13. */
    const uint most = min(60 * STEPS, METHOD == 2 ? 8000 : 64000);

    float h = 0.6 * KD_PI / float(STEPS), fate = KD_FATE_UNDECIDED, about = 0.0;
    uint n = 0;
    if (rays.list[in_ + 6] > 0.0) {
        ends[o] = rays.list[in_ + 6];
        ends[o + 1] = rays.list[in_ + 7];
        n = 1;
    }
    float far = max(rays.far, 10.0 * radius(y.a.x));
    /* rotations for all sizes of step; computed once, because their series takes ten rounds of a loop */
    kd_phasor turns[4];
    for (int k = 0; k < 4; k++)
        turns[k] = kd_cos_sin(2.0 * KD_BIND * h * YOSHIDA[k]);
    KD_TRACE_STEP(KD_TRACE_START, 0.0, vec4(y.a.x, 0.0), vec4(y.a.p, 0.0), 0.0);
    for (uint step_ = 0; step_ < most; step_++) {
        kd_point before = y.a;
        if (METHOD == 0)
            y.a = euler(y.a, h);
        else if (METHOD == 1)
            y.a = runge_kutta(y.a, h);
        else
            y = tao_6(y, h, turns);
        KD_TRACE_STEP(float(n), h, vec4(y.a.x, 0.0), vec4(y.a.p, 0.0), 0.0);
        float z0 = before.x.z, z1 = y.a.x.z, r = radius(y.a.x);
        if (z0 != 0.0 && (z0 > 0.0) != (z1 > 0.0) && n < ORDERS) {
            vec3 d0 = h * flow(before.x, before.p).x, d1 = h * flow(y.a.x, y.a.p).x;
            float s = z0 / (z0 - z1);
            for (int k = 0; k < 4; k++)
                s = clamp(s - hermite(z0, d0.z, z1, d1.z, s) / hermite_slope(z0, d0.z, z1, d1.z, s), 0.0, 1.0);
            vec3 hit =
                vec3(hermite(before.x.x, d0.x, y.a.x.x, d1.x, s), hermite(before.x.y, d0.y, y.a.x.y, d1.y, s), 0.0);
            float hit_r = radius(hit);
            if (!(hit_r > rays.horizon_r)) {
                fate = KD_FATE_CAPTURED;
                break;
            }
            ends[o + 3 * n] = 1.0 / hit_r;
            ends[o + 3 * n + 1] = azimuth(hit, about + turned(before.x, hit));
            n++;
        }
        about += turned(before.x, y.a.x);
        if (!(r > rays.horizon_r * 1.0001)) {
            fate = KD_FATE_CAPTURED;
            break;
        }
        if (r > far && dot(y.a.x, y.a.p) > 0.0) {
            fate = KD_FATE_ESCAPED;
            /* from here on the ray is straight, and crosses the plane once more if it moves towards the plane */
            if (z1 * y.a.p.z < 0.0 && n < ORDERS) {
                vec3 hit = y.a.x - y.a.p * (z1 / y.a.p.z);
                ends[o + 3 * n] = inversesqrt(hit.x * hit.x + hit.y * hit.y);
                ends[o + 3 * n + 1] = azimuth(vec3(hit.x, hit.y, 0.0), about + turned(y.a.x, hit));
            }
            break;
        }
    }
    ends[o + 3 * ORDERS + 2] = fate;
    /* the momentum gives the direction, because it is closer to its limit at infinity than the position is */
    if (fate == KD_FATE_ESCAPED) {
        vec3 p = y.a.p;
        ends[o + 3 * ORDERS] = p.z / sqrt(dot(p, p));
        ends[o + 3 * ORDERS + 1] = -kd_atan2(p.y, p.x);
    }
    /* Drift: violation of the null condition, relative to E^2 = 1. */
    vec3 x = y.a.x, p = y.a.p;
    float a = rays.spin, r = radius(x), q = r * r + a * a;
    float s = 1.0 + ((r * x.x + a * x.y) * p.x + (r * x.y - a * x.x) * p.y) / q + x.z * p.z / r;
    ends[o + 3 * ORDERS + 3] =
        abs(dot(p, p) - 1.0 - r * r * (2.0 * r - rays.charge2) / (r * r * r * r + a * a * x.z * x.z) * s * s);
}
