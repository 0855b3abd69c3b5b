/* This kernel lists pairs of a ray and a star that it may see. A ray stands for a cell of the picture one step wide, which the lens map takes to a
 * patch of the sky; here are the stars in a parallelogram about that patch, by its first derivatives. star_images.comp finds their places.
 *
 * Stars are sorted into square cells on the six faces of a cube about the sphere, the brightest of a cell first (shared/faces.h). A star whose light,
 * by the mean magnification of a ray's patch, would brighten the pixel by less than KD_STAR_LEAST of the unit of sky.brightness ends the
 * search of its cell. A patch of more than KD_STAR_PATCH radians, next to the critical curve, is left out.
 *
 * The parallelogram: with J the map's derivative, |x_i| <= KD_STAR_ROOM for x = (J^T J + e tr(J^T J))^-1 J^T p. e makes room for what the
 * derivative does not say where J is all but singular, on the caustic. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_STARS(KD_SPEC_U_, KD_SPEC_B_)
#include "ray/sky_map.glsl"
#include "shared/faces.h"
layout(set = 0, binding = 3) buffer Pairs { uint pairs[]; }; /* how many; then a ray and a star each */
#ifdef KD_TEXELS
layout(set = 0, binding = 4) uniform textureBuffer stars;
vec4 star_row(uint k) { return texelFetch(stars, int(k)); }
#else
layout(set = 0, binding = 4) readonly buffer Stars { vec4 stars[]; };
vec4 star_row(uint k) { return stars[k]; }
#endif
layout(set = 0, binding = 5) readonly buffer Cells { uint cells[]; }; /* where each begins, and the end */

#define KD_STAR_ROOM 0.8
#define KD_STAR_MARGIN 0.0025 /* e */

/* To a neighbour, along an axis of the picture; 0 if neither escapes. */
vec3 slope(vec3 n, uint at, uint place, uint places, uint step_)
{
    bool last = place + 1u >= places;
    bool after = !last && kd_sky_escapes(last ? at : at + step_), before = place > 0u && kd_sky_escapes(place > 0u ? at - step_ : at);
    vec3 other = kd_sky_from(after ? at + step_ : before ? at - step_ : at);
    return after ? other - n : n - other;
}

void main()
{
    kd_sky_map_read();
    uint x = gl_GlobalInvocationID.x, y = push.first + gl_WorkGroupID.y;
    if (x >= push.width)
        return;
    uint at = y * push.width + x;
    float size = kd_sky_number(KD_LENS_SKY_FOOTPRINT, at);
    vec3 own = kd_sky_from(at), i = slope(own, at, x, push.width, 1u), j = slope(own, at, y, push.rows, push.width);
    vec3 n = kd_sky_galactic(own), a = kd_sky_galactic(i), b = kd_sky_galactic(j);
    float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), more = KD_STAR_MARGIN * (aa + bb);
    float det = (aa + more) * (bb + more) - ab * ab, unit = 1.0 / max(det, 1e-30);
    float patch_ = sqrt(max(aa * bb - ab * ab, 0.0)) * float(SIDE * SIDE), least = KD_STAR_LEAST * patch_;
    float reach = 0.75 * size;
    bool looks = kd_sky_escapes(at) && size < KD_STAR_PATCH && aa > 0.0 && bb > 0.0;
    kd_face face = kd_face_of(n);
    /* A step of the direction moves the place on the face by 1 + p^2 + q^2 times as much at most; and more, as that grows. */
    float room = 1.25 * reach * (1.0 + face.p * face.p + face.q * face.q);
    ivec2 low = kd_face_cell(face.p - room, face.q - room), high = kd_face_cell(face.p + room, face.q + room);
    /* What x is made of; so that a star is tested by two products. */
    vec3 to_x = ((bb + more) * a - ab * b) * unit, to_y = ((aa + more) * b - ab * a) * unit;
    float far = 1.3 * reach * reach;
    ivec2 cell = ivec2(low.x - 1, low.y);
    uint k = 0u, end = 0u;
    bool done = !looks;
    /* lavapipe executes both sides of a branch, and skips work only by leaving a loop. So the inner loop goes from star to star, and from cell
     * to cell, until one is near, and the outer one notes it. */
    for (;;) {
        bool near = false;
        for (;;) {
            bool next = k >= end;
            if (next) {
                bool row = cell.x >= high.x;
                done = done || (row && cell.y >= high.y);
                cell = ivec2(row ? low.x : cell.x + 1, row ? cell.y + 1 : cell.y);
                uint of = uint((face.number * KD_FACE_CELLS + min(cell.y, KD_FACE_CELLS - 1)) * KD_FACE_CELLS + cell.x);
                k = cells[of];
                end = cells[of + 1u];
            }
            if (k < end && !done) {
                vec4 star = star_row(k);
                vec3 p = star.xyz - n;
                near = abs(dot(p, to_x)) <= KD_STAR_ROOM && abs(dot(p, to_y)) <= KD_STAR_ROOM && dot(p, p) < far && star.w >= least;
                k = star.w < least ? end : k + 1u;
            }
            if (done || near)
                break;
        }
        if (done)
            break;
        uint place = atomicAdd(pairs[0], 1u);
        if (place < push.room) {
            pairs[2u + 2u * place] = at;
            pairs[3u + 2u * place] = k - 1u;
        }
    }
}
