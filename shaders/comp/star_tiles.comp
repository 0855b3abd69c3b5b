/* Kernel: lists pairs of a ray and a star that the ray may see, from square tiles of the lens map. Each ray stands for
 * a cell of the picture one step wide; star_images.comp finds the star's image in it.
 *
 * Nine rays of a tile, three by three, give the map over the tile to second order. This map takes places in the tile to
 * the plane of the sky perpendicular to the middle ray. A tile is simple under three conditions: (1) all nine rays
 * escape; (2) the map's derivative changes by less than KD_STAR_TILE_BENT of itself, so that the map has a unique
 * inverse, which Newton's method finds; (3) the terms of third order, as the corners show, are less than
 * KD_STAR_TILE_OFF rays.
 *
 * Other tiles are listed. A large tile, KD_STAR_TILE rays a side, is listed as small tiles of three rays a side, for
 * the next run of this kernel. The rays of a small tile are listed for star_search.comp.
 *
 * Stars are sorted as in faces.h, the brightest of a cell first. A cell's search ends at the first star that would
 * brighten a pixel by less than push.least.
 *
 * Four more rays of a large tile give its map to third order, and its terms of fourth order along both axes. A simple
 * tile is smooth if the terms of fourth order, which are left out, are less than KD_STAR_TILE_SMOOTH rays. For a smooth
 * tile this kernel spreads the stars' light itself, at the places and with the magnification of the tile's map. It
 * lists no pairs for such a tile.
 *
 * If BRIGHT is set, this kernel spreads light itself in all simple tiles. In simple tiles that are not smooth, it uses
 * the map of second order. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_STARS(KD_SPEC_U_, KD_SPEC_B_)
#include "ray/kerr_ray.glsl"
#include "ray/sky_map.glsl"
#include "ray/star_list.glsl"
#define KD_CAMERA_BINDING 8
#define KD_CAMERA_ONLY
#include "ray/camera.glsl"
#include "ray/rim.glsl"
#include "ray/around.glsl"
layout(set = 0, binding = 10) readonly buffer Stars_ { float star_numbers[]; };
#define KD_STAR_LIGHT_BINDING 9
#include "ray/star_light.glsl"

#define KD_STAR_TILE_BENT 0.7
#define KD_STAR_TILE_OFF 0.2
#define KD_STAR_TILE_SMOOTH 0.005
const int HALF = int(TILE) / 2;
/* upper bound of kd_tile.near; images are searched up to 0.6 steps from a ray */
const float NEAR = TILE == KD_STAR_TILE || AT_RIM ? 0.72 : 0.65;

/* The map over a tile: q = a u + b v + aa u^2 + ab u v + bb v^2 + aaa u^3 + aab u^2 v + abb u v^2 + bbb v^3, where u
 * and v go from -1 at the tile's first rays to 1 at its last. The terms from the second order on are in units of a and
 * b. The terms of third order are 0 if the tile is not smooth. */
struct kd_tile {
    vec3 n, e1, e2;
    vec2 a, b, aa, ab, bb, aaa, aab, abb, bbb;
    float det, bent;
    float near; /* largest distance, in rays, of a star from the ray that it is paired with */
    kd_cells cells;
    bool simple, is_smooth;
};

vec2 solve(kd_tile t, vec2 q) { return vec2(t.b.y * q.x - t.b.x * q.y, t.a.x * q.y - t.a.y * q.x) / t.det; }

float most(vec2 v) { return max(abs(v.x), abs(v.y)); }

/* Computes the map over a tile. whole: true if all rays of the tile exist. */
kd_tile tile_about(uint at, bool whole)
{
    kd_tile t;
    vec3 n = kd_sky_from(at);
    vec3 e1 = normalize(abs(n.z) < 0.9 ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y)), e2 = cross(n, e1);
    bool escape = whole && kd_sky_escapes(at);
    uint face = kd_face_of(kd_sky_galactic(n)).number;
    vec2 low = vec2(1e9), high = vec2(-1e9); /* low, high: bounds of the nine rays' places in the plane of the sky */
    /* terms of u v^2 and u^2 v, from the part of the corners that the other terms do not explain */
    vec2 corners = vec2(0.0), sides = vec2(0.0);
    /* values at the ends of both axes, and the mean at the corners */
    vec2 left = vec2(0.0), right = left, above = left, below = left, corner = left;
    t.a = t.b = t.aa = t.ab = t.bb = vec2(0.0);
    int k = 0;
    do { /* loops test at their ends, for the reason given in lens_closed.comp */
        int row = k / 3, i = k - 3 * row - 1, j = row - 1;
        uint there = whole ? at + uint(HALF * (j * int(push.width) + i)) : at;
        vec3 other = kd_sky_from(there);
        /* values are subtracted first, so that small differences keep all their digits */
        vec2 q = vec2(dot(e1, other - n), dot(e2, other - n));
        float u = float(i), v = float(j);
        escape = escape && kd_sky_escapes(there) && dot(n, other) > 0.5;
        vec2 place = kd_face_place(face, kd_sky_galactic(other));
        low = min(low, place);
        high = max(high, place);
        t.a += u * q * (1.0 / 6.0);
        t.b += v * q * (1.0 / 6.0);
        corners += (i == 0 || j == 0 ? -0.5 : 0.25) * u * q;
        sides += (i == 0 || j == 0 ? -0.5 : 0.25) * v * q;
        t.ab += 0.25 * u * v * q;
        t.aa += j == 0 ? 0.5 * u * u * q : vec2(0.0);
        t.bb += i == 0 ? 0.5 * v * v * q : vec2(0.0);
        left = k == 3 ? q : left;
        right = k == 5 ? q : right;
        above = k == 1 ? q : above;
        below = k == 7 ? q : below;
        corner += i * j != 0 ? 0.25 * q : vec2(0.0);
    } while (++k < 9);
    t.n = kd_sky_galactic(n);
    t.e1 = kd_sky_galactic(e1);
    t.e2 = kd_sky_galactic(e2);
    t.det = t.a.x * t.b.y - t.b.x * t.a.y;
    t.aaa = t.aab = t.abb = t.bbb = vec2(0.0);
    vec2 mixed = t.ab;
    t.aa = solve(t, t.aa);
    t.ab = solve(t, t.ab);
    t.bb = solve(t, t.bb);
    vec2 room = (high - low) * (0.5 * NEAR / float(HALF) + 0.05); /* cells extend beyond the rays by half a step */
    t.cells = kd_cells_of(face, low - room, high + room);
    escape = escape && most(low - room) < KD_FACE_EDGE && most(high + room) < KD_FACE_EDGE;
    t.bent = 2.0 * (most(t.aa) + most(t.ab) + most(t.bb));
    float unit = 1.0 / float(HALF * HALF);
    bool fine = AT_RIM || kd_sky_size(at, unit * dot(t.a, t.a), unit * dot(t.b, t.b), unit * dot(t.a, t.b)) <
                              (RIM == 1u ? KD_STAR_PATCH_RIM : KD_STAR_PATCH);
    float off = (most(solve(t, corners)) + most(solve(t, sides))) * float(HALF);
    t.simple = escape && kd_is_finite(t.bent) && t.bent < KD_STAR_TILE_BENT && off < KD_STAR_TILE_OFF && fine;
    t.near = min(0.61 + 0.55 * off, NEAR);
    t.is_smooth = false;
    if (TILE == KD_STAR_TILE) { /* each axis has rays at the distances -2, -1, 0, 1 and 2 of these steps */
        uint across = whole ? uint(HALF / 2) : 0u, down = across * push.width;
        vec3 u1 = kd_sky_from(at - across) - n, u2 = kd_sky_from(at + across) - n, v1 = kd_sky_from(at - down) - n,
             v2 = kd_sky_from(at + down) - n;
        vec2 west = vec2(dot(e1, u1), dot(e2, u1)), east = vec2(dot(e1, u2), dot(e2, u2)),
             north = vec2(dot(e1, v1), dot(e2, v1)), south = vec2(dot(e1, v2), dot(e2, v2));
        kd_quartic u = kd_quartic_of(left, west, vec2(0.0), east, right),
                   v = kd_quartic_of(above, north, vec2(0.0), south, below);
        float fourth = (most(solve(t, left + right - 4.0 * (west + east))) +
                        most(solve(t, above + below - 4.0 * (north + south)))) *
                           (2.0 / 3.0) +
                       most(solve(t, corner - 0.5 * (left + right + above + below)));
        t.is_smooth = t.simple && fourth * float(HALF) < KD_STAR_TILE_SMOOTH;
        if (t.is_smooth) {
            t.a = 2.0 * u.x;
            t.b = 2.0 * v.x;
            t.det = t.a.x * t.b.y - t.b.x * t.a.y;
            t.aa = solve(t, 4.0 * u.xx);
            t.ab = solve(t, mixed);
            t.bb = solve(t, 4.0 * v.xx);
            t.aaa = solve(t, 8.0 * u.xxx);
            t.aab = solve(t, sides);
            t.abb = solve(t, corners);
            t.bbb = solve(t, 8.0 * v.xxx);
        }
    }
    return t;
}

/* Derivatives of the map by u and v, in units of a and b. */
mat2 derivative(kd_tile t, vec2 p)
{
    return mat2(
        vec2(1.0, 0.0) + p.x * (2.0 * t.aa + 3.0 * p.x * t.aaa + 2.0 * p.y * t.aab) + p.y * (t.ab + p.y * t.abb),
        vec2(0.0, 1.0) + p.y * (2.0 * t.bb + 3.0 * p.y * t.bbb + 2.0 * p.x * t.abb) + p.x * (t.ab + p.x * t.aab));
}

float determinant_of(mat2 j) { return j[0].x * j[1].y - j[1].x * j[0].y; }

/* Adds the terms of second and third order to a place (u, v). */
vec2 linear_of(kd_tile t, vec2 p)
{
    return p + p.x * (p.x * (t.aa + p.x * t.aaa + p.y * t.aab) + p.y * t.ab) +
           p.y * p.y * (t.bb + p.y * t.bbb + p.x * t.abb);
}

/* Bounds for the stars that may be in a tile: the largest coordinates by the linear map, and `sharp`, the least area to
 * which the map takes a ray's cell, relative to the area by the linear map. Both come from nine places: the middle, the
 * sides and the corners. Between two places at the distance `far`, a parabola with second derivative c exceeds its
 * values there by up to c far^2/8; this is added. */
struct kd_bounds {
    vec2 most;
    float sharp;
};

kd_bounds bounds_of(kd_tile t)
{
    kd_bounds o = kd_bounds(vec2(0.0), 1.0);
    const float far = 1.0 + t.near / float(HALF);
    int k = 0;
    [[dont_unroll]] do {
        int row = k / 3;
        vec2 p = far * vec2(k - 3 * row - 1, row - 1);
        o.most = max(o.most, abs(linear_of(t, p)));
        o.sharp = min(o.sharp, determinant_of(derivative(t, p)));
    } while (++k < 9);
    float bent = far * t.bent;
    o.most += 0.02 + 0.125 * far * bent;
    o.sharp = max(0.97 * o.sharp - 0.5 * bent * bent, (1.0 - t.bent) * (1.0 - t.bent));
    return o;
}

/* Finds the place (u, v) that the whole map takes to the same point as the linear map takes `linear`. */
vec2 place_of(kd_tile t, vec2 linear)
{
    vec2 p = linear;
    for (int k = 0; k < 3; k++) {
        vec2 left = linear_of(t, p) - linear;
        mat2 j = derivative(t, p);
        p -= vec2(j[1].y * left.x - j[1].x * left.y, j[0].x * left.y - j[0].y * left.x) / determinant_of(j);
    }
    return p;
}

/* Solid angle to which the map takes a ray's cell at a place. */
float area(kd_tile t, vec2 p) { return abs(determinant_of(derivative(t, p)) * t.det) * (1.0 / float(HALF * HALF)); }

/* Spreads the light of star k. place: offset of the image from the middle ray (x, y) of a tile, in rays. magnified: the
 * star's flux divided by the solid angle of the sky to which the map takes a pixel. The maps of two adjacent tiles
 * differ slightly. Therefore both tiles show the image about their border, with weights that go from 0 to 1 over a
 * fifth of a step, as two rays do in star_images.comp. */
void shine(uint x, uint y, vec2 place, uint k, float magnified, bool bright)
{
    vec2 share = clamp(0.5 + 5.0 * (float(HALF) + 0.5 - abs(place)), 0.0, 1.0);
    float own = share.x * share.y;
    if (RIM == 1u && !BRIGHT) /* the rim contributes the rest of the image */
        own *= 1.0 - kd_rim_share(kd_rim_place(kd_camera_look(vec2(x, y) + place)));
    if (!bright || own <= 0.0)
        return;
    ivec2 near = ivec2(floor(place + 0.5));
    float energy = FINITE ? kd_camera_ray(uint(int(x) + near.x), uint(int(y) + near.y)).e : 1.0;
    vec3 colour = kd_sky_shifted(star_numbers[4u * push.stars + k], 1.0 / energy, VISIBLE ? KD_TRAIT_VISIBLE : 0u);
    kd_star_spread((vec2(x, y) + place + 0.5) / float(SIDE) - 0.5, emission.sky.brightness * magnified * own * colour);
}

/* Lists the pairs of star k with the rays near its image, unless the star is too faint. place: offset of the image from
 * the middle ray, in rays. */
void note(uint at, vec2 place, float near, uint k, bool bright)
{
    ivec2 low = max(ivec2(ceil(place - near)), ivec2(-HALF)), high = min(ivec2(floor(place + near)), ivec2(HALF));
    int across = high.x - low.x + 1, all = across * (high.y - low.y + 1);
    if (!bright || across <= 0 || all <= 0)
        return;
    uint first = atomicAdd(pairs[0], uint(all));
    int i = 0;
    do {
        int j = i / across;
        if (first + uint(i) < push.room) {
            pairs[2u + 2u * (first + uint(i))] = at + uint((low.y + j) * int(push.width) + low.x + i - across * j);
            pairs[3u + 2u * (first + uint(i))] = k;
        }
    } while (++i < all);
}

/* Lists the existing parts of a tile: the small tiles of a large tile, or the rays of a small tile. first: index in the
 * map of the tile's first ray, which is at (x, y). */
void list(uint first, uint x, uint y)
{
    const bool large = TILE == KD_STAR_TILE;
    const uint step_ = large ? 3u : 1u;
    uint columns = (min(TILE, push.width - x) + step_ - 1u) / step_,
         all = columns * ((min(TILE, push.end - y) + step_ - 1u) / step_);
    uint to = (large ? 2u : 2u + push.tiles) + atomicAdd(listed[large ? 0u : 1u], all);
    uint i = 0u;
    do {
        uint row = i / columns;
        listed[to + i] = first + step_ * (row * push.width + i - columns * row);
    } while (++i < all);
}

/* True if the rim, or another grid of the rim, makes all images in a tile. It is enough to test the corners, because
 * the edge of the rim is convex. */
bool is_left_out(uint x, uint y)
{
    if (AT_RIM)
        return kd_rim_part(vec2(x, y) + 1.0, 1.8) <= 0.0;
    if (RIM != 1u)
        return false;
    float least = 1.0;
    for (int k = 0; k < 4; k++) {
        vec2 corner = vec2(x + push.column0, y + push.row0) - 0.6 + (float(TILE) + 0.2) * vec2(k & 1, k >> 1);
        least = min(least, kd_rim_share(kd_rim_place(kd_camera_look(corner))));
    }
    return least >= 1.0;
}

/* Processes the tile whose first ray is at (x, y). */
void seek(uint x, uint y)
{
    uint first = y * push.width + x;
    bool whole = x + TILE <= push.width && y + TILE <= push.end;
    uint at = whole ? first + uint(HALF) * (push.width + 1u) : first;
    kd_tile t = tile_about(at, whole);
    /* u and v are the products of a star's vector with these two vectors. */
    vec3 to_u = (t.b.y * t.e1 - t.b.x * t.e2) / t.det, to_v = (t.a.x * t.e2 - t.a.y * t.e1) / t.det;
    float unit = push.least * float(SIDE * SIDE) /
                 /* the factor 1.2 is needed because the last of the rim's rays stand for a slightly smaller area */
                 (AT_RIM ? 1.2 * kd_steps_of(x + 1u, y + 1u) : 1.0);
    kd_bounds bounds = bounds_of(t);
    float least = bounds.sharp * unit * abs(t.det) * (1.0 / float(HALF * HALF)); /* flux of the faintest visible star */
    bool left_out = is_left_out(x, y), spreads = BRIGHT || t.is_smooth;
    kd_star_walk walk = kd_star_walk_from(t.cells, t.simple && !left_out);
    for (;;) {
        bool near = false;
        vec2 place = vec2(0.0);
        vec4 star = vec4(0.0);
        for (;;) { /* this is a loop, because lavapipe skips work only by leaving a loop */
            kd_star_next_cell(t.cells, walk);
            if (walk.k < walk.end && !walk.done) {
                star = star_row(walk.k);
                place = vec2(dot(star.xyz - t.n, to_u), dot(star.xyz - t.n, to_v));
                near = abs(place.x) <= bounds.most.x && abs(place.y) <= bounds.most.y && dot(star.xyz, t.n) > 0.5 &&
                       star.w >= least;
                walk.k = star.w < least ? walk.end : walk.k + 1u;
            }
            if (walk.done || near)
                break;
        }
        if (walk.done)
            break;
        place = place_of(t, place);
        float patch_ = area(t, place);
        if (spreads)
            shine(x + push.column0 + uint(HALF), y + push.row0 + uint(HALF), place * float(HALF), walk.k - 1u,
                  star.w * dot(star.xyz, t.n) / (patch_ * float(SIDE * SIDE)), star.w > unit * patch_);
        if (!spreads)
            note(at, place * float(HALF), t.near, walk.k - 1u, star.w > 0.8 * unit * patch_);
    }
    if (!t.simple && !left_out)
        list(first, x, y);
}

void main()
{
    kd_sky_map_read();
    cam = camera_;
    if (TILE == KD_STAR_TILE || AT_RIM) {
        uint x = push.left + gl_GlobalInvocationID.x * TILE;
        if (x < push.right)
            seek(x, push.first + gl_WorkGroupID.y * TILE);
        return;
    }
    uint n = listed[0], all = gl_NumWorkGroups.x * KD_GROUP_SIZE;
    uint i = gl_GlobalInvocationID.x;
    do {
        if (i < n) {
            uint first = listed[2u + i], y = first / push.width;
            seek(first - y * push.width, y);
        }
        i += all;
    } while (i < n);
}
