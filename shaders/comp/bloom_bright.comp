/* Kernel: sums the light that a lens removes from its place (shared/bloom.glsl) over blocks of BLOCK_X times BLOCK_Y
 * pixels. Blocks are smaller than the cells of the finest grid. An invocation processes four columns of pixels, or the
 * columns of one block if these are more than four.
 *
 * A block's rows may be in two or more bands. Each band adds its rows, in order, to the sum of earlier bands. So the
 * result does not depend on where bands end.
 *
 * This file is compiled to two kernels. With KD_TEXELS the radiance is read as texels of four floats, and three texels
 * hold four pixels. Rows must then be multiples of four pixels. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
#include "shared/bloom.glsl"
KD_SPEC_BLOOM_BRIGHT(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BLOOM_BRIGHT_FIELDS_(F, U) } push;
layout(set = 0, binding = 1) buffer Blocks { vec4 blocks[]; };

/* Light that the lens removes from four adjacent pixels. */
struct quad { vec3 a, b, c, d; };
vec3 taken(vec3 light) { return bloom_of(push.gain * light, push.strength); }

#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer radiance;
quad quad_at(uint x, uint row)
{
    int at = int(3 * ((row * push.pixels_x + x) / 4));
    vec4 a = texelFetch(radiance, at), b = texelFetch(radiance, at + 1), c = texelFetch(radiance, at + 2);
    return quad(taken(a.xyz), taken(vec3(a.w, b.xy)), taken(vec3(b.zw, c.x)), taken(c.yzw));
}
#else
layout(set = 0, binding = 0) readonly buffer Radiance { float radiance[]; };
vec3 one_at(uint x, uint row)
{
    uint at = 3 * (row * push.pixels_x + min(x, push.pixels_x - 1));
    vec3 light = taken(vec3(radiance[at], radiance[at + 1], radiance[at + 2]));
    return x < push.pixels_x ? light : vec3(0);
}
quad quad_at(uint x, uint row)
{
    return quad(one_at(x, row), one_at(x + 1, row), one_at(x + 2, row), one_at(x + 3, row));
}
#endif

const uint WIDE = BLOCK_X > 4 ? BLOCK_X : 4,
           /* WIDE: number of columns of pixels that an invocation processes. EACH: number of blocks in these columns */
    EACH = BLOCK_X < 4 ? 4 / BLOCK_X : 1;

/* The sum that earlier bands have stored for the invocation's n-th block; 0 if there were none. */
vec3 begun(uint at, uint n, uint left) { return BEGUN && n < EACH && n < left ? blocks[at + n].rgb : vec3(0); }

void main()
{
    uvec2 place = bloom_place(gl_GlobalInvocationID.x, push.across);
    if (place.y >= push.block_rows)
        return;
    uint block = push.block_row0 + place.y, first = BLOCK_Y * block, at = block * push.blocks_x + EACH * place.x,
         left = push.blocks_x - EACH * place.x;
    vec3 a = vec3(0), b = vec3(0), c = vec3(0), d = vec3(0);
    if (BEGUN && first < push.row0) {
        a = begun(at, 0, left);
        b = begun(at, 1, left);
        c = begun(at, 2, left);
        d = begun(at, 3, left);
    }
    for (uint k = 0; k < BLOCK_Y; k++) {
        bool here = first + k >= push.row0 && first + k < push.row0 + push.rows;
        uint row = here ? first + k - push.row0 : 0;
        for (uint x = 0; x < WIDE; x += 4) {
            uint column = WIDE * place.x + x;
            quad q = quad_at(min(column, push.pixels_x - 1), row);
            float seen = here && column < push.pixels_x ? 1.0 : 0.0;
            if (BLOCK_X == 1) {
                a += seen * q.a;
                b += seen * q.b;
                c += seen * q.c;
                d += seen * q.d;
            } else if (BLOCK_X == 2) {
                a += seen * (q.a + q.b);
                b += seen * (q.c + q.d);
            } else {
                a += seen * ((q.a + q.b) + (q.c + q.d));
            }
        }
    }
    blocks[at] = vec4(a, 0);
    if (EACH > 1 && left > 1)
        blocks[at + 1] = vec4(b, 0);
    if (EACH > 2 && left > 2)
        blocks[at + 2] = vec4(c, 0);
    if (EACH > 2 && left > 3)
        blocks[at + 3] = vec4(d, 0);
}
