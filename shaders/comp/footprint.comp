/* Kernel: computes the footprints of each ray. A footprint is the size of the area that the ray stands for. There is
 * one on the disk for each crossing, and one in the sky (shared/lens.h).
 *
 * A step of the camera is a square in the picture. To first order the map takes the square to a parallelogram. The map
 * takes a disc of one step's diameter to an ellipse. The footprint is the long axis of that ellipse, the largest
 * singular value of the map's derivative J:
 *
 *   sigma^2 = (A + B)/2 + sqrt((A - B)^2/4 + C^2),   A = |J_x|^2, B = |J_y|^2, C = J_x.J_y .
 *
 * The derivative comes from differences to neighbouring rays of the same order or fate. Neighbours on both sides give
 * the derivative to second order. At the edge of the picture or of the buffer, two neighbours on one side give it to
 * second order as well. One neighbour gives it to first order. A ray without neighbours is isolated at an edge, and its
 * footprint is KD_FOOTPRINT_EDGE. Half the second difference is added, because a map that turns back within a step
 * still has a size. This term is also of second order.
 *
 * Rays on listed pixels are on a square grid or on a lattice (ray/place.glsl). Each pixel's square grid is treated
 * separately. On a lattice J is a least-squares fit to the differences to neighbours in this pixel and in adjacent
 * pixels. Its step is the side of a square with the area of one ray. Residuals of the fit are added like the second
 * difference.
 *
 * Differences are between 32-bit numbers: a footprint below about 1e-6 of r, or 1e-6 radians, is noise. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_FOOTPRINT(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/math.glsl"
#include "ray/planes.glsl"
#include "ray/ellipse.glsl"
layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
struct kd_footprint { KD_FOOTPRINT_FIELDS_(F, U) };
layout(push_constant) uniform Push { kd_footprint push_; };
/* copied before the first branch, because after a branch lavapipe reads the block again for each lane and each use */
kd_footprint push;
layout(set = 0, binding = 0) buffer LensMap { float lens[]; };
/* List of places of the rays that are traced singly (ray/places.glsl). */
layout(set = 0, binding = KD_FOOTPRINT_PLACES) readonly buffer Places { uint words[]; };
#include "ray/places.glsl"
#ifdef KD_TEXELS
layout(set = 0, binding = 2) uniform textureBuffer traced;
float map_at(uint at) { return texelFetch(traced, int(at)).r; }
#else
float map_at(uint at) { return lens[at]; }
#endif

const uint FIRST = (QUANTITIES & KD_LENS_FOOTPRINT) != 0u ? KD_LENS_FOOTPRINT : KD_LENS_SKY_FOOTPRINT;
const bool SHAPED = (QUANTITIES & KD_LENS_SHAPE) != 0u;

/* Where a ray meets the disk or the sky. For a crossing: (w, phi). For the sky: a unit vector. */
struct kd_spot {
    vec3 at;
    bool there;
};

/* Selects one of the ends of a ray: crossing n, or the sky. */
struct kd_which {
    bool sky;
    uint n;
};

kd_spot spot(kd_which which, uint at, bool there)
{
    uint n = which.n;
    if (!which.sky) {
        float w = map_at(at + n * push.stride);
        return kd_spot(vec3(w, map_at(at + (kd_plane(KD_LENS_PHI) + n) * push.stride), 0.0), there && w > 0.0);
    }
    float u = map_at(at + kd_plane(KD_LENS_SKY_U) * push.stride), s = sqrt(max(1.0 - u * u, 0.0));
    kd_phasor phi = kd_cos_sin(map_at(at + kd_plane(KD_LENS_SKY_PHI) * push.stride));
    bool escapes = map_at(at + kd_plane(KD_LENS_FATE) * push.stride) == KD_FATE_ESCAPED;
    return kd_spot(vec3(s * phi.c, s * phi.s, u), there && escapes);
}

/* Difference between another ray's spot and the ray's own. Differences of azimuth are reduced to at most half a turn.
 */
vec3 apart(kd_which which, kd_spot own, kd_spot other)
{
    vec3 d = other.at - own.at;
    if (!which.sky)
        d.y = kd_turned(d.y);
    return d;
}

/* Changes of a spot along one axis of the picture: the change from ray to ray, and half the second difference. */
struct kd_change {
    vec3 slope, bend;
    bool there;
};

/* The change along an axis at one ray. place: the ray's index along the axis; places: number of rays along it. step_:
 * distance of neighbouring rays in a plane of the map. */
kd_change change(kd_which which, kd_spot own, uint at, uint place, uint places, uint step_)
{
    bool first = place == 0, last = place + 1 == places;
    int o = first ? 1 : -1, p = first ? 2 : last ? -2 : 1; /* offsets of the two neighbours that are used */
    bool has_o = places > 1, has_p = int(place) + p >= 0 && int(place) + p < int(places);
    kd_spot near = spot(which, has_o ? at + o * step_ : at, has_o),
            other = spot(which, has_p ? at + p * step_ : at, has_p);
    vec3 d = apart(which, own, near), e = apart(which, own, other);
    float fo = float(o), fp = float(p), unit = 1.0 / (fo * fp * (fp - fo));
    if (near.there && other.there) /* slope and curvature of the parabola through all three spots */
        return kd_change((fp * fp * d - fo * fo * e) * unit, (fo * e - fp * d) * unit, true);
    if (near.there)
        return kd_change(fo * d, vec3(0.0), true);
    return kd_change(fp * e, vec3(0.0), other.there && abs(p) == 1);
}

/* Metric at a spot: factors that convert steps of w and phi to lengths in M. For the sky the factors are 1, and lengths
 * are in radians. */
vec3 scale(kd_which which, kd_spot own)
{
    float r = 1.0 / own.at.x;
    return which.sky ? vec3(1.0) : vec3(r * r, r, 0.0);
}

/* The ray's place in a grid that is stored completely in the map, row by row. */
struct kd_grid { uint x, y, width, rows; };

kd_oval on_grid(kd_which which, uint at, kd_grid grid)
{
    kd_spot own = spot(which, at, true);
    kd_change across = change(which, own, at, grid.x, grid.width, 1),
              down = change(which, own, at, grid.y, grid.rows, grid.width);
    vec3 m = scale(which, own), i = m * across.slope, j = m * down.slope, bend_i = m * across.bend,
         bend_j = m * down.bend;
    kd_oval o = kd_oval(kd_longest(dot(i, i) + dot(bend_i, bend_i), dot(j, j) + dot(bend_j, bend_j), dot(i, j)), 0.0);
    if (SHAPED && !which.sky) {
        vec3 rr = i * i + j * j + bend_i * bend_i + bend_j * bend_j;
        o.shape = kd_oval_of(rr.x, rr.y, i.x * i.y + j.x * j.y + bend_i.x * bend_i.y + bend_j.x * bend_j.y).shape;
    }
    if (across.there && down.there)
        return o;
    return KD_NO_OVAL;
}

/* Sums for the least-squares fit of a linear map d(v): the sums of v v^T, of d v^T and of d.d. missing: number of
 * neighbours that do not have the crossing, or the end in the sky, that the ray has. */
struct kd_fit {
    float xx, xy, yy;
    vec3 dx, dy;
    float dd, count, lacks;
};

/* For the left and the right neighbour of a pixel: true if it is in the list too. Such a neighbour is adjacent in the
 * list as well. */
struct kd_beside { bool left, right; };

vec2 listed(uint pixel) { return vec2(map_at(push.list + 2 * pixel), map_at(push.list + 2 * pixel + 1)); }

kd_beside beside(uint pixel)
{
    vec2 own = listed(pixel), before = listed(max(pixel, 1) - 1), after = listed(min(pixel + 1, push.rows - 1));
    return kd_beside(before == own - vec2(1.0, 0.0), after == own + vec2(1.0, 0.0));
}

/* Adds one neighbour of a ray to the fit. (vx, vy): vector from the ray to the neighbour, which may be in an adjacent
 * pixel. */
void count(inout kd_fit fit, kd_which which, kd_spot own, vec3 m, kd_beside all, uint at, uint k, int vx, int vy)
{
    int row = int((k * GENERATOR + SHIFT) % max(CRITICAL, 1)), x = int(k) + vx, y = row + vy;
    bool inside = (x >= 0 || all.left) && (x < int(CRITICAL) || all.right) && y >= 0 && y < int(CRITICAL);
    kd_spot other = spot(which, inside ? at + vx : at, inside);
    vec3 d = m * apart(which, own, other), v = vec3(vx, vy, 0.0);
    float there = other.there ? 1.0 : 0.0;
    if (!other.there)
        d = vec3(0.0); /* the difference may be NaN */
    fit.xx += there * v.x * v.x;
    fit.xy += there * v.x * v.y;
    fit.yy += there * v.y * v.y;
    fit.dx += d * v.x;
    fit.dy += d * v.y;
    fit.dd += dot(d, d);
    fit.count += there;
    fit.lacks += inside ? 1.0 - there : 0.0;
}

kd_oval on_lattice(kd_which which, uint at)
{
    uint k = at % max(CRITICAL, 1);
    kd_beside all = beside(at / max(CRITICAL, 1));
    kd_spot own = spot(which, at, true);
    kd_fit fit = kd_fit(0.0, 0.0, 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    vec3 m = scale(which, own);
#define BOTH(vx, vy) \
    count(fit, which, own, m, all, at, k, int(vx), int(vy)); \
    count(fit, which, own, m, all, at, k, -int(vx), -int(vy))
    BOTH(X1, Y1);
    BOTH(X2, Y2);
    BOTH(X3, Y3);
    BOTH(X4, Y4);
    /* area of one ray; the determinant det is at least area^2, unless the neighbours lie on a line */
    float area = float(CRITICAL), det = fit.xx * fit.yy - fit.xy * fit.xy;
    vec3 i = (fit.yy * fit.dx - fit.xy * fit.dy) / det, j = (fit.xx * fit.dy - fit.xy * fit.dx) / det;
    float left = max(fit.dd - dot(i, fit.dx) - dot(j, fit.dy), 0.0) / max(fit.count, 1.0);
    kd_oval o =
        kd_oval(kd_longest(area * dot(i, i) + left, area * dot(j, j) + left, area * dot(i, j)), KD_NO_OVAL.shape);
    if (SHAPED && !which.sky)
        o.shape = kd_oval_of(area * (i.x * i.x + j.x * j.x) + left, area * (i.y * i.y + j.y * j.y) + left,
                             area * (i.x * i.y + j.x * j.y))
                      .shape;
    /* A pixel without adjacent listed pixels may have only four rays, which lie on a line. The change along that line
     * is then used for all directions. */
    if (det < 0.5 * area * area)
        o = kd_oval(fit.lacks > 0.0 || fit.count == 0.0 ? KD_FOOTPRINT_EDGE
                                                        : kd_longest(area * fit.dd / (fit.xx + fit.yy), 0.0, 0.0),
                    KD_NO_OVAL.shape);
    return o;
}

kd_oval footprint(kd_which which, uint at, kd_grid grid)
{
    if (CRITICAL > 0 && GENERATOR > 0)
        return on_lattice(which, at);
    return on_grid(which, at, grid);
}

/* Stores the result of max, for the reason given in lens_fill.comp. */
void put(uint at, float value) { lens[at] = max(value, -KD_FOOTPRINT_EDGE); }

/* Marks a footprint as missing, because the neighbouring rays are not traced yet. */
void mark(uint at) { lens[at + kd_plane(FIRST) * push.stride] = KD_FOOTPRINT_WANTED; }
bool is_marked(uint at) { return map_at(at + kd_plane(FIRST) * push.stride) == KD_FOOTPRINT_WANTED; }

/* Finds the ray of this invocation. Returns false if the invocation has no ray. */
bool this_ray(out kd_grid grid, out uint at)
{
    uint x = gl_GlobalInvocationID.x, y = push.first + gl_WorkGroupID.y;
    if (CRITICAL > 0) {
        at = push.first + x;
        uint k = at % max(CRITICAL, 1), side = max(SHIFT, 1);
        grid = kd_grid(k % side, k / side, side, side);
        return at < push.end;
    }
    const bool alone = push.alone == 1u;
    uvec2 place = kd_place_at(words[push.list + x]) + uvec2(push.origin_x, push.origin_y);
    grid = kd_grid(alone ? place.x : x, alone ? place.y : y, push.width, push.rows);
    at = grid.y * push.width + grid.x;
    return alone ? x < kd_stage_count(KD_STAGE_ALONE) : x < push.width && (push.alone == 0u || is_marked(at));
}

void main()
{
    push = push_;
    kd_grid grid;
    uint at;
    if (!this_ray(grid, at))
        return;
    if (push.alone == 1u && grid.y >= push.end) {
        mark(at);
        return;
    }
    if ((QUANTITIES & KD_LENS_FOOTPRINT) != 0u) {
        uint plane = at + kd_plane(KD_LENS_FOOTPRINT) * push.stride, n = 0;
        /* orders have no gaps, so a ray without a first crossing has none at all */
        bool crosses = ORDERS > 0u && map_at(at) > 0.0;
        do {
            if (crosses) {
                kd_oval o = footprint(kd_which(false, n), at, grid);
                put(plane + n * push.stride, o.size);
                if (SHAPED)
                    put(at + (kd_plane(KD_LENS_SHAPE) + n) * push.stride, o.shape);
                n++;
            }
            crosses = crosses && n < ORDERS && map_at(at + n * push.stride) > 0.0;
        } while (crosses);
        for (; n < ORDERS; n++)
            lens[plane + n * push.stride] = 0.0;
    }
    if ((QUANTITIES & KD_LENS_SKY_FOOTPRINT) != 0u) {
        bool escapes = map_at(at + kd_plane(KD_LENS_FATE) * push.stride) == KD_FATE_ESCAPED;
        put(at + kd_plane(KD_LENS_SKY_FOOTPRINT) * push.stride,
            escapes ? footprint(kd_which(true, 0u), at, grid).size : 0.0);
    }
}
