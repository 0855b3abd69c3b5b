/* Bodies as an emitter: opaque spheres, in the plane or off it, that rays may meet (light/meet.glsl).
 *
 * A body is a sphere of radius R in its own frame, and space is taken as flat on the scale of the body. The map A of a
 * body takes differences of coordinates from the body's centre to lengths in the orthonormal frame of zero angular
 * momentum there. These lengths are along r, theta and phi, stretched by the metric. In that frame the light that
 * arrives at the observer at one time is a plane wave t = n.Y, where n is the direction of propagation and Y the place.
 * In the frame of a body of velocity v, the wave has the time t' = gamma (t - v.Y). The wave meets the body where
 *
 *   b^2 + t'^2 = R^2,   b^2 = Y^2 - t^2.
 *
 * The distance b of the ray from the centre does not depend on v: a moving body appears as a sphere, rotated (Penrose
 * 1959, Terrell 1959). The cosine of the emission angle in the body's frame is t'/R. The surface emits as a black body
 * with linear limb darkening:
 *
 *   light = brightness B(g T) (1 - c (1 - cos)) / (1 - c/3),
 *   1/g = -k.U = (u^t E - u^phi L) - u^r p_r - u^theta p_theta. */
#ifndef KD_BLOCK_bodies
/* clang-format off */
#define KD_BLOCK_bodies(F, U, A) \
    F(least)                  /* 1/r of the outermost place that a body may reach */ \
    /* x, y, z and radius, M, of a ball that contains all bodies. Azimuths count from the observer, mirrored */ \
    F(x) F(y) F(z) F(reach) \
    U(leaves)                   /* number of the tree's leaves, a power of two */
/* clang-format on */
#define KD_TABLES_bodies(T)
#define KD_TRAIT_LIT 64u /* LIT: at least one body reflects light of the disk */
#define KD_TRAITS_bodies(T) T(VISIBLE) T(AZIMUTH) T(LIT)
/* A tree of balls in heap order: nodes from 1 on, with x, y, z and radius, and two children each. The last `leaves`
 * nodes belong to the bodies. The bodies follow the tree, with KD_BODY_WORDS each, in rows of four words:
 *   0 to 2   a row of the map A, and its value at the centre
 *   3        velocity and gamma
 *   4        velocity relative to which coordinates rotate, R, limb darkening, brightness
 *   5        factors of E, L, p_r and p_theta in 1/g
 *   6        temperature divided by the disk's largest; index of the body in the list; two unused words
 *   7 to 9   the disk's light that the body reflects (src/render/emit/bodies_illumination.c):
 *   7        its sum, and its moments along r, theta and phi
 *   8        its moments along rr, thetatheta and phiphi, and its temperature divided by the disk's largest
 *   9        its moments along rtheta, rphi and thetaphi */
#define KD_BODY_WORDS 40
#define KD_BUFFERS_bodies(B) B(3, stored, bodies)
#define KD_PASS_bodies(P)
#endif

#ifdef KD_EMIT_CODE
#ifdef KD_MARCH
vec4 kd_bodies_row(uint at) { return vec4(bodies[at], bodies[at + 1u], bodies[at + 2u], bodies[at + 3u]); }
vec4 kd_bodies_node(uint node) { return kd_bodies_row(4u * node); }
vec4 kd_body_row(uint body, uint row)
{
    return kd_bodies_row(8u * emission.bodies.leaves + KD_BODY_WORDS * body + 4u * row);
}

uint kd_bodies_which(kd_met met) { return uint(kd_body_row(met.body, 6u).y); }

/* 1/g of the body's light, as the observer sees it. */
float kd_bodies_shift(kd_met met)
{
    vec4 u = kd_body_row(met.body, 5u);
    float s = sqrt(max(1.0 - met.u * met.u, 1e-8));
    return max(u.x * met.energy - u.y * met.momentum - u.z * met.dw / kd_horizons(met.w, cam.root) - u.w * met.du / s,
               1e-6);
}

/* Temperature in the body's frame, K. */
float kd_bodies_kelvin(kd_met met) { return emission.disk.peak * kd_body_row(met.body, 6u).x; }

/* Irradiance of a surface of normal y, from the moments of the arriving light's direction n up to second order (R.
 * Ramamoorthi & P. Hanrahan 2001, "On the relationship between radiance and irradiance", J. Opt. Soc. Am. A 18, 2448):
 * to that order a cosine c clamped at 0 is 1/4 + c/2 + 5 (3 c^2 - 1)/32. */
vec3 kd_bodies_reflected(kd_met met)
{
    vec4 a = kd_body_row(met.body, 7u), b = kd_body_row(met.body, 8u), c = kd_body_row(met.body, 9u);
    float s = sqrt(max(1.0 - met.u * met.u, 0.0));
    vec4 p = vec4(s * cos(met.phi), -s * sin(met.phi), met.u, met.w);
    vec3 y =
        vec3(dot(kd_body_row(met.body, 0u), p), dot(kd_body_row(met.body, 1u), p), dot(kd_body_row(met.body, 2u), p));
    /* The normal in the body's frame. Light left the surface at the time t' = R cos, where cos is the cosine of the
     * emission angle. */
    vec4 v = kd_body_row(met.body, 3u), own = kd_body_row(met.body, 4u);
    y /= max(met.w, 1e-12);
    float t = (met.cosine * own.y / v.w + dot(v.xyz, y)) / (1.0 + v.z * own.x);
    y.z -= own.x * t;
    y += v.xyz * (v.w * v.w / (v.w + 1.0) * dot(v.xyz, y) - v.w * t);
    y *= inversesqrt(max(dot(y, y), 1e-30));
    float square = dot(b.xyz, y * y) + 2.0 * (c.x * y.x * y.y + c.y * y.x * y.z + c.z * y.y * y.z);
    float light = max(0.25 * a.x + 0.5 * dot(a.yzw, y) + (5.0 / 32.0) * (3.0 * square - a.x), 0.0), t2 = b.w * b.w;
    return b.w > 0.0 ? light / (t2 * t2) * kd_black_body(min(b.w / kd_bodies_shift(met), 1e6), TRAITS_bodies)
                     : vec3(0.0);
}

vec3 kd_bodies_light(kd_met met)
{
    vec4 own = kd_body_row(met.body, 4u);
    float t = kd_body_row(met.body, 6u).x / kd_bodies_shift(met),
          limb = (1.0 - own.z * (1.0 - met.cosine)) / (1.0 - own.z * (1.0 / 3.0));
    vec3 light = own.w * limb * kd_black_body(min(t, 1e6), TRAITS_bodies);
    if ((TRAITS_bodies & KD_TRAIT_LIT) != 0u)
        light += kd_bodies_reflected(met);
    return min(light, 1e30);
}
#endif
#endif
