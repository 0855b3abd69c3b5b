/* Kernel: lists pairs of a ray and a star that the ray may see, ray by ray. It processes the rays that star_tiles.comp
 * left over because the map is not simple there. A ray stands for a cell of the picture one step wide, which the lens
 * map takes to a patch of the sky. This kernel lists the stars in a parallelogram about that patch, which follows from
 * the map's first derivatives. star_images.comp finds the places of the stars' images.
 *
 * Stars are sorted into square cells on the six faces of a cube about the sphere, the brightest of a cell first
 * (shared/faces.h). The search of a cell ends at the first star that is too faint. A star is too faint if it would
 * brighten the pixel by less than push.least, in units of sky.brightness, at twice the mean magnification of the ray's
 * patch. A patch of more than KD_STAR_PATCH radians, next to the critical curve, is left out.
 *
 * With J the map's derivative, the parallelogram is |x_i| <= KD_STAR_ROOM for x = (J^T J + e tr(J^T J))^-1 J^T p. Where
 * J is nearly singular, on the caustic, the derivative does not describe the whole patch; the term with e widens the
 * parallelogram there.
 *
 * On the caustic the parallelogram is much wider than the patch. So a star must also be in a rectangle along the
 * patch's long axis. By the map's derivatives of first and second order this rectangle contains the patch. These
 * derivatives need all eight rays about the ray. */
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

#define KD_STAR_ROOM 0.8
#define KD_STAR_MARGIN 0.0025 /* e */
/* KD_STAR_HALF: half a side of a ray's cell with its borders, in which cells share images. KD_STAR_BEND: the square of
 * that. Both have a margin for terms of third order. */
#define KD_STAR_HALF 0.65
#define KD_STAR_BEND 0.5

/* The mixed derivative, from the four rays at the corners. there: true if all four rays escape. */
vec3 twist(uint at, uint x, uint y, out bool there)
{
    vec3 sum = vec3(0.0);
    there = true;
    int k = 0;
    [[dont_unroll]] do { /* loops test at their ends, for the reason given in lens_closed.comp */
        int i = (k & 1) * 2 - 1, j = (k >> 1) * 2 - 1;
        ivec2 place = kd_around_neighbour(ivec2(x + i, y + j));
        uint near = place.x < 0 ? at : uint(place.y) * push.width + uint(place.x);
        there = there && place.x >= 0 && kd_sky_escapes(near);
        sum += 0.25 * float(i * j) * kd_sky_from(near);
    } while (++k < 4);
    return sum;
}

/* Slope along an axis of the picture, from the differences to both neighbours; 0 if neither neighbour escapes. bend:
 * half the second difference. there: true if both neighbours escape. */
vec3 slope(vec3 n, uint at, uint x, uint y, ivec2 axis, out vec3 bend, out bool there)
{
    ivec2 next = kd_around_neighbour(ivec2(x, y) + axis), last = kd_around_neighbour(ivec2(x, y) - axis);
    uint after_ = next.x < 0 ? at : uint(next.y) * push.width + uint(next.x),
         before_ = last.x < 0 ? at : uint(last.y) * push.width + uint(last.x);
    bool after = next.x >= 0 && kd_sky_escapes(after_), before = last.x >= 0 && kd_sky_escapes(before_);
    vec3 to = kd_sky_from(after_) - n, from = kd_sky_from(before_) - n;
    there = after && before;
    bend = 0.5 * (to + from);
    return after ? to : before ? -from : vec3(0.0);
}

/* Half the extent of a ray's patch along an axis, by the derivatives of the map. */
float rectangle_of(vec3 axis, vec3 i, vec3 j, vec3 ii, vec3 jj, vec3 ij)
{
    return KD_STAR_HALF * (abs(dot(axis, i)) + abs(dot(axis, j))) +
           KD_STAR_BEND * (abs(dot(axis, ii)) + abs(dot(axis, jj)) + abs(dot(axis, ij)));
}

/* True if the rim, or another grid of the rim, makes all images in the ray's cell. */
bool is_left_out(uint x, uint y)
{
    return AT_RIM
               ? kd_rim_part(vec2(x, y), 0.7) <= 0.0
               : RIM == 1u && kd_rim_share(kd_rim_place(kd_camera_look(vec2(x + push.column0, y + push.row0)))) >= 1.0;
}

void search(uint at)
{
    uint y = at / push.width, x = at - y * push.width;
    bool along, across, around;
    vec3 own = kd_sky_from(at), bend_i, bend_j, i = slope(own, at, x, y, ivec2(1, 0), bend_i, along),
         j = slope(own, at, x, y, ivec2(0, 1), bend_j, across), bend_ij = twist(at, x, y, around);
    vec3 n = kd_sky_galactic(own), a = kd_sky_galactic(i), b = kd_sky_galactic(j);
    float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), more = KD_STAR_MARGIN * (aa + bb);
    float det = (aa + more) * (bb + more) - ab * ab, unit = 1.0 / max(det, 1e-30);
    float size = AT_RIM ? sqrt(aa + bb) : kd_sky_size(at, aa, bb, ab), steps = kd_steps_of(x, y);
    float patch_ = sqrt(max(aa * bb - ab * ab, 0.0)),
          least = 0.5 * push.least * float(SIDE * SIDE) * patch_ / max(steps, 1e-30);
    float reach = 0.75 * size;
    bool looks = kd_sky_escapes(at) && size < (RIM != 0u ? KD_STAR_PATCH_RIM : KD_STAR_PATCH) && aa > 0.0 && bb > 0.0 &&
                 !is_left_out(x, y);
    /* The components of x are the products of a star's vector with these two vectors, so that two products test a star.
     */
    vec3 to_x = ((bb + more) * a - ab * b) * unit, to_y = ((aa + more) * b - ab * a) * unit;
    float far = 1.3 * reach * reach;
    /* The rectangle along the long axis. If not all eight rays exist, only `reach` bounds it. Second-order terms count
     * from the slope on one side, since the central one is i - bend_i. */
    vec3 long_ = dot(i, i) > dot(j, j) ? i : j;
    long_ = i * dot(i, long_) + j * dot(j, long_);
    long_ -= own * dot(own, long_);
    long_ *= inversesqrt(max(dot(long_, long_), 1e-38));
    vec3 wide = cross(own, long_);
    float room_long = rectangle_of(long_, i - bend_i, j - bend_j, bend_i, bend_j, bend_ij),
          room_wide = rectangle_of(wide, i - bend_i, j - bend_j, bend_i, bend_j, bend_ij) + 0.01 * room_long;
    bool all_there = along && across && around;
    room_long = all_there ? room_long : 2.0 * reach;
    room_wide = all_there ? room_wide : 2.0 * reach;
    long_ = kd_sky_galactic(long_);
    wide = kd_sky_galactic(wide);
    /* The rectangle about the parallelogram. e adds little to it, unless the parallelogram is thin. The rectangle is
     * limited to the ray's size. A small change of direction moves the place on the face by at most 1 + p^2 + q^2 times
     * that change. A margin is added, because this factor grows within the step. */
    kd_face face = kd_face_of(n);
    vec2 middle = vec2(face.p, face.q), all = vec2(1.25 * reach * (1.0 + dot(middle, middle)));
    vec2 room =
        abs(kd_face_place(face.number, n + a) - middle) + abs(kd_face_place(face.number, n + b) - middle) + 0.1 * all;
    room = patch_ < 0.1 * (aa + bb) ? all : min(1.1 * KD_STAR_ROOM * room, all);
    vec2 other = 1.1 * (abs(kd_face_place(face.number, n + room_long * long_) - middle) +
                        abs(kd_face_place(face.number, n + room_wide * wide) - middle)) +
                 0.02 * all;
    room = all_there ? min(room, other) : room;
    kd_cells cells = kd_cells_of(face.number, middle - room, middle + room);
    kd_star_walk walk = kd_star_walk_from(cells, looks);
    /* lavapipe executes both sides of a branch, and skips work only by leaving a loop. So the inner loop goes from star
     * to star, and from cell to cell, until a star is near, and the outer loop records this star. */
    for (;;) {
        bool near = false;
        for (;;) {
            kd_star_next_cell(cells, walk);
            if (walk.k < walk.end && !walk.done) {
                vec4 star = star_row(walk.k);
                vec3 p = star.xyz - n;
                near = abs(dot(p, to_x)) <= KD_STAR_ROOM && abs(dot(p, to_y)) <= KD_STAR_ROOM && dot(p, p) < far &&
                       abs(dot(p, long_)) <= room_long && abs(dot(p, wide)) <= room_wide && star.w >= least;
                walk.k = star.w < least ? walk.end : walk.k + 1u;
            }
            if (walk.done || near)
                break;
        }
        if (walk.done)
            break;
        uint place = atomicAdd(pairs[0], 1u);
        if (place < push.room) {
            pairs[2u + 2u * place] = at;
            pairs[3u + 2u * place] = walk.k - 1u;
        }
    }
}

void main()
{
    kd_sky_map_read();
    cam = camera_;
    uint n = listed[1], all = gl_NumWorkGroups.x * KD_GROUP_SIZE;
    uint i = gl_GlobalInvocationID.x;
    do {
        if (i < n)
            search(listed[2u + push.tiles + i]);
        i += all;
    } while (i < n);
}
