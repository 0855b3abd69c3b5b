/* Kernel: spreads the images of stars over pixels. star_tiles.comp and star_search.comp make pairs of a ray and a star.
 * For each pair the kernel finds the images of the star: the places in the ray's cell of the picture, [-1/2, 1/2]^2
 * steps, that the lens map takes to the star. It spreads the star's magnified light over the pixels nearest to each
 * image.
 *
 * About its ray the map is taken as quadratic, in the plane of the sky perpendicular to the ray (orthographic
 * projection). Its coefficients come from the eight surrounding rays: the linear ones by least squares, the others by
 * second differences. On the rim the map is of higher order, from twenty rays. Beside rays that do not escape, and at
 * edges, the map is of first order, from the rays that exist. Roots are found by Newton's method, from four starts
 * unless there is clearly only one root. Each root counts once: there are up to four where a caustic passes.
 *
 * A star's flux F in an image is F dOmega/dOmega_s. Divided by the solid angle of a pixel it is the mean radiance
 * there, and the pixel's own solid angle cancels: the radiance is F divided by the solid angle of the sky to which the
 * map takes a pixel at the star's place, |det J|/cos(angle to the ray). The light is spread as in ray/star_light.glsl.
 *
 * Rays of the rim (ray/rim.glsl) are processed in the same way, with their own steps and the size of these steps in the
 * picture.
 *
 * Code for several rays or starts is in loops that are not unrolled. No array has a variable index, because drivers
 * would unroll the loops around it in any case. In this form lavapipe compiles the kernel in a third of the time. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_STARS(KD_SPEC_U_, KD_SPEC_B_)
#include "ray/kerr_ray.glsl"
#include "ray/sky_map.glsl"
layout(set = 0, binding = 3) readonly buffer Pairs { uint pairs[]; };
layout(set = 0, binding = 4) readonly buffer Stars { float stars[]; };
#define KD_CAMERA_BINDING 5
#define KD_CAMERA_ONLY
#include "ray/camera.glsl"
#include "ray/rim.glsl"
#include "ray/around.glsl"
#define KD_STAR_LIGHT_BINDING 6
#include "ray/star_light.glsl"

#define KD_STAR_THIN 0.02 /* least area of a patch, relative to the square of the patch's size */

/* The map about a ray, in radians: f(x, y) = c + a x + b y + aa x^2 + ab x y + bb y^2 + aaa x^3 + aab x^2 y + abb x y^2
 * + bbb y^3. On the rim there are also the terms aaab x^3 y + abbb x y^3. */
struct kd_patch {
    vec2 c, a, b, aa, ab, bb, aaa, aab, abb, bbb, aaab, abbb;
    bool there;
};

struct kd_chart { vec3 n, e1, e2; };

struct kd_neighbour {
    vec2 f;
    bool there;
};

kd_neighbour neighbour(kd_chart c, uint at, uint x, uint y, int dx, int dy)
{
    ivec2 place = kd_around_neighbour(ivec2(x, y) + ivec2(dx, dy));
    bool inside = place.x >= 0;
    uint there = inside ? uint(place.y) * push.width + uint(place.x) : at;
    vec3 n = kd_sky_from(there);
    n -= c.n; /* values are subtracted first, so that small differences keep all their digits */
    return kd_neighbour(vec2(dot(c.e1, n), dot(c.e2, n)), inside && kd_sky_escapes(there));
}

/* Derivatives along an axis from one side only. */
void one_sided(kd_neighbour before, kd_neighbour after, inout vec2 a, inout vec2 aa, inout bool there)
{
    bool both = before.there && after.there;
    a = both ? 0.5 * (after.f - before.f) : after.there ? after.f : -before.f;
    aa = both ? 0.5 * (after.f + before.f) : vec2(0.0);
    there = there && (before.there || after.there);
}

/* Next to a caustic a patch is thin: rounding of 32 bits, and terms of third order, are a large part of its width.
 * There the map is the least-squares cubic for 7 x 7 rays. It is computed by the polynomials 1, u, u^2 - 4, u^3 - 7u.
 * They are orthogonal on the integers -3 to 3, and their squared norms there are 7, 28, 84 and 216. */
void refine(kd_chart c, uint at, uint x, uint y, inout kd_patch o)
{
    float area = o.a.x * o.b.y - o.a.y * o.b.x, size = dot(o.a, o.a) + dot(o.b, o.b);
    bool thin = abs(area) < KD_STAR_THIN * size, there = true;
    vec2 k00 = vec2(0.0), k10 = vec2(0.0), k01 = vec2(0.0), k20 = vec2(0.0), k11 = vec2(0.0), k02 = vec2(0.0),
         k30 = vec2(0.0), k21 = vec2(0.0), k12 = vec2(0.0), k03 = vec2(0.0);
    int i = 0;
    [[dont_unroll]] do { /* loops test at their ends, for the reason given in lens_closed.comp */
        int row = i / 7, dx = i - 7 * row - 3, dy = row - 3;
        kd_neighbour n = neighbour(c, at, x, y, dx, dy);
        float u = float(dx), v = float(dy), u2 = u * u - 4.0, v2 = v * v - 4.0;
        there = there && n.there;
        k00 += n.f;
        k10 += u * n.f;
        k01 += v * n.f;
        k20 += u2 * n.f;
        k11 += u * v * n.f;
        k02 += v2 * n.f;
        k30 += u * (u2 - 3.0) * n.f;
        k21 += u2 * v * n.f;
        k12 += u * v2 * n.f;
        k03 += v * (v2 - 3.0) * n.f;
    } while (++i < (thin ? 49 : 0));
    if (thin && there) {
        o.aaa = k30 / (216.0 * 7.0);
        o.aab = k21 / (84.0 * 28.0);
        o.abb = k12 / (28.0 * 84.0);
        o.bbb = k03 / (7.0 * 216.0);
        o.aa = k20 / (84.0 * 7.0);
        o.ab = k11 / (28.0 * 28.0);
        o.bb = k02 / (7.0 * 84.0);
        o.a = k10 / (28.0 * 7.0) - 7.0 * o.aaa - 4.0 * o.abb;
        o.b = k01 / (7.0 * 28.0) - 7.0 * o.bbb - 4.0 * o.aab;
        o.c = k00 / 49.0 - 4.0 * (o.aa + o.bb);
    }
}

/* Offset of ray k of the outer twelve rays, which are the 5 x 5 rays without the corners and without the inner 3 x 3. k
 * = 0 to 3: the middles of the left, right, upper and lower sides. Then come the two rays beside each of these. */
ivec2 outer(int k)
{
    int side = k < 4 ? k : (k - 4) / 2, far = (side & 1) == 0 ? -2 : 2, near = k < 4 ? 0 : (k & 1) == 0 ? 1 : -1;
    return side < 2 ? ivec2(far, near) : ivec2(near, far);
}

/* Adds terms of higher order on the rim, where steps are long and numbers have almost no rounding error. They are all
 * terms of third order, and x^3 y and x y^3. They come from 21 rays, the 5 x 5 without the corners. near: the 3 x 3
 * rays in the middle. */
void extend(kd_chart c, uint at, uint x, uint y, vec2 near[9], inout kd_patch o)
{
    vec2 far[12];
    bool there = true;
    int k = 0;
    [[dont_unroll]] do {
        ivec2 d = outer(k);
        kd_neighbour n = neighbour(c, at, x, y, d.x, d.y);
        [[unroll]] for (int i = 0; i < 11; i++)
            far[i] = far[i + 1];
        far[11] = n.f;
        there = there && (k >= 4 || n.there);
    } while (++k < 12);
    vec2 before = 0.5 * (far[4] - far[5]), after = 0.5 * (far[6] - far[7]), above = 0.5 * (far[8] - far[9]),
         below = 0.5 * (far[10] - far[11]);
    kd_quartic along = kd_quartic_of(far[0], near[3], vec2(0.0), near[5], far[1]),
               down = kd_quartic_of(far[2], near[1], vec2(0.0), near[7], far[3]);
    kd_quartic slope_y = kd_quartic_of(before, 0.5 * (near[6] - near[0]), 0.5 * (near[7] - near[1]),
                                       0.5 * (near[8] - near[2]), after),
               slope_x = kd_quartic_of(above, 0.5 * (near[2] - near[0]), 0.5 * (near[5] - near[3]),
                                       0.5 * (near[8] - near[6]), below);
    if (there) {
        o.a = along.x;
        o.aa = along.xx;
        o.aaa = along.xxx;
        o.b = down.x;
        o.bb = down.xx;
        o.bbb = down.xxx;
        o.aab = slope_y.xx;
        o.abb = slope_x.xx;
        o.aaab = slope_y.xxx;
        o.abbb = slope_x.xxx;
        o.ab = slope_y.x - o.abbb;
    }
}

kd_patch patch_about(kd_chart c, uint at, uint x, uint y)
{
    vec2 f[9]; /* places of the 3 x 3 rays in the plane of the sky, row by row */
    uint there = 0u;
    int k = 0;
    [[dont_unroll]] do {
        kd_neighbour n = neighbour(c, at, x, y, k % 3 - 1, k / 3 - 1);
        [[unroll]] for (int i = 0; i < 8; i++)
            f[i] = f[i + 1];
        f[8] = n.f;
        there |= n.there ? 1u << k : 0u;
    } while (++k < 9);
    kd_patch o;
    o.there = true;
    o.c = o.ab = o.aaa = o.aab = o.abb = o.bbb = o.aaab = o.abbb = vec2(0.0);
    one_sided(kd_neighbour(f[3], (there & 8u) != 0u), kd_neighbour(f[5], (there & 32u) != 0u), o.a, o.aa, o.there);
    one_sided(kd_neighbour(f[1], (there & 2u) != 0u), kd_neighbour(f[7], (there & 128u) != 0u), o.b, o.bb, o.there);
    if ((there | 16u) == 511u) { /* true if all eight neighbours exist */
        o.a = ((f[2] - f[0]) + (f[5] - f[3]) + (f[8] - f[6])) * (1.0 / 6.0);
        o.b = ((f[6] - f[0]) + (f[7] - f[1]) + (f[8] - f[2])) * (1.0 / 6.0);
        o.ab = 0.25 * (f[8] - f[6] - f[2] + f[0]);
        if (AT_RIM)
            extend(c, at, x, y, f, o);
        else
            refine(c, at, x, y, o);
    }
    return o;
}

vec2 value(kd_patch m, vec2 p)
{
    vec2 f = m.c + p.x * (m.a + p.x * (m.aa + m.aaa * p.x + m.aab * p.y) + m.ab * p.y) +
             p.y * (m.b + p.y * (m.bb + m.bbb * p.y + m.abb * p.x));
    return AT_RIM ? f + p.x * p.y * (p.x * p.x * m.aaab + p.y * p.y * m.abbb) : f;
}

/* The map's derivative; its columns are d/dx and d/dy. */
mat2 derivative(kd_patch m, vec2 p)
{
    mat2 j = mat2(m.a + p.x * (2.0 * m.aa + 3.0 * m.aaa * p.x + 2.0 * m.aab * p.y) + p.y * (m.ab + m.abb * p.y),
                  m.b + p.y * (2.0 * m.bb + 3.0 * m.bbb * p.y + 2.0 * m.abb * p.x) + p.x * (m.ab + m.aab * p.x));
    if (AT_RIM)
        j += mat2(p.y * (3.0 * p.x * p.x * m.aaab + p.y * p.y * m.abbb),
                  p.x * (p.x * p.x * m.aaab + 3.0 * p.y * p.y * m.abbb));
    return j;
}
float determinant_of(mat2 j) { return j[0].x * j[1].y - j[1].x * j[0].y; }

/* A root of the map near the start `p`: a place that the map takes to q. If there is none, the result is outside all
 * cells. */
vec2 root(kd_patch m, vec2 q, vec2 p)
{
    float far = 1.0;
    int k = 0;
    [[dont_unroll]] do {
        mat2 j = derivative(m, p);
        float det = determinant_of(j);
        vec2 f = q - value(m, p), step_ = vec2(j[1].y * f.x - j[1].x * f.y, j[0].x * f.y - j[0].y * f.x) / det;
        far = max(abs(step_.x), abs(step_.y));
        p += far < 0.5 ? step_ : far < 1e9 ? step_ * (0.5 / far) : vec2(0.0);
        /* stops, because the next step of Newton's method would be only about 1e-8 */
    } while (++k < 6 && far > 1e-4);
    return far < 1e-3 ? p : vec2(1e9);
}

/* True if the map over a ray's cell has a unique inverse, because its derivative changes by less than itself. */
bool is_plain(kd_patch m)
{
    mat2 j = mat2(m.a, m.b);
    float det = determinant_of(j);
    vec2 all = abs(m.aa) + abs(m.ab) + abs(m.bb);
    return 1.2 * (all.x + all.y) * (abs(j[0].x) + abs(j[0].y) + abs(j[1].x) + abs(j[1].y)) < 0.7 * abs(det);
}

/* Weight of a cell for an image at x, in steps from its ray. The maps of two adjacent cells put an image at slightly
 * different places. Therefore both cells show the image about their border, with weights that go from 0 to 1 over a
 * fifth of a step. So no image is lost or counted twice. */
float share(float x) { return clamp(3.0 - 5.0 * abs(x), 0.0, 1.0); }

/* An image of a star in a ray's cell. place: place in the picture, in the picture's steps. steps: squared steps of the
 * picture per squared step of the ray. share: the fraction of the image that this grid shows; the rim or another grid
 * shows the rest. energy: energy at infinity of light whose measured energy is 1. */
struct kd_star_pixel {
    vec2 place;
    float steps, share, energy;
};

kd_star_pixel spot_at(uint x, uint y, vec2 p)
{
    const uint px = x + push.column0, py = y + push.row0;
    kd_star_pixel o = kd_star_pixel(vec2(px, py) + p, 1.0, 1.0, 1.0);
    if (AT_RIM) {
        kd_rim_cell cell = kd_rim_cell_at(x, y, p);
        kd_seen seen = kd_camera_seen(cell.d);
        o.place = seen.place;
        o.steps = cell.area * seen.steps;
        o.share = kd_rim_share(cell.place) * kd_rim_part(vec2(x, y) + p, 0.0);
        o.energy = cam.e_t - (cam.e_r * cell.d.x + cam.e_theta * cell.d.y + cam.e_phi * cell.d.z) *
                                 inversesqrt(dot(cell.d, cell.d));
        return o;
    }
    o.energy = kd_camera_ray(px, py).e;
    if (RIM == 1u)
        o.share = 1.0 - kd_rim_share(kd_rim_place(kd_camera_look(vec2(px, py) + p)));
    return o;
}

void images(uint at, uint k)
{
    uint y = at / push.width, x = at - y * push.width;
    kd_chart c;
    c.n = kd_sky_from(at);
    c.e1 = normalize(abs(c.n.z) < 0.9 ? vec3(-c.n.y, c.n.x, 0.0) : vec3(0.0, -c.n.z, c.n.y));
    c.e2 = cross(c.n, c.e1);
    vec3 star = kd_sky_from_galactic(vec3(stars[4u * k], stars[4u * k + 1u], stars[4u * k + 2u]));
    vec2 q = vec2(dot(c.e1, star - c.n), dot(c.e2, star - c.n));
    kd_patch m = patch_about(c, at, x, y);
    float cosine = sqrt(max(1.0 - dot(q, q), 0.0)), size = dot(m.a, m.a) + dot(m.b, m.b);
    vec2 found0 = vec2(-1e9), found1 = found0, found2 = found0, found3 = found0;
    uint fresh = 0u; /* bit k is set if root k counts: it is in the cell, and no earlier start found it */
    int starts = is_plain(m) ? 1 : 4;
    /* This loop tests at its head. With the test at its end, images are lost on lavapipe (Mesa 22.3), for an unknown
     * reason. */
    [[dont_unroll]] for (int i = 0; i < starts; i++) {
        vec2 p = root(m, q, starts == 1 ? vec2(0.0) : vec2((i & 1) == 0 ? -0.3 : 0.3, i < 2 ? -0.3 : 0.3));
        bool counts = m.there && share(p.x) * share(p.y) > 0.0 && distance(p, found0) > 0.02 &&
                      distance(p, found1) > 0.02 && distance(p, found2) > 0.02;
        fresh |= counts ? 1u << i : 0u;
        found0 = i == 0 ? p : found0;
        found1 = i == 1 ? p : found1;
        found2 = i == 2 ? p : found2;
        found3 = i == 3 ? p : found3;
    }
    [[dont_unroll]] do {
        vec2 p = (fresh & 1u) != 0u ? found0 : (fresh & 2u) != 0u ? found1 : (fresh & 4u) != 0u ? found2 : found3;
        float det = max(abs(determinant_of(derivative(m, p))), 1e-6 * size);
        kd_star_pixel spot = spot_at(x, y, p);
        float magnified = stars[4u * k + 3u] * cosine * spot.steps / (det * float(SIDE * SIDE));
        if (fresh != 0u && !(magnified < push.least)) {
            vec3 colour = kd_sky_shifted(stars[4u * push.stars + k], FINITE ? 1.0 / spot.energy : 1.0,
                                         VISIBLE ? KD_TRAIT_VISIBLE : 0u);
            kd_star_spread((spot.place + 0.5) / float(SIDE) - 0.5,
                           emission.sky.brightness * magnified * share(p.x) * share(p.y) * spot.share * colour);
        }
        fresh &= fresh - 1u;
    } while (fresh != 0u);
}

void main()
{
    kd_sky_map_read();
    cam = camera_;
    uint n = min(pairs[0], push.room), all = gl_NumWorkGroups.x * KD_GROUP_SIZE;
    uint i = gl_GlobalInvocationID.x;
    do {
        if (i < n)
            images(pairs[2u + 2u * i], pairs[3u + 2u * i]);
        i += all;
    } while (i < n);
}
