/* Light that a lens spreads, as a quadratic B-spline on the finest grid: a pixel gives to its own cell and to the eight round it, by where
 * in its cell it is, so that what is spread moves and widens evenly with it. An invocation adds up what the pixels of its cell give each
 * of the nine, rows from the top; bloom_join.comp adds up what a cell is given.
 *
 * A cell's pixels may lie in several bands: each band adds its rows to what those before it have left, one after the other, so that the sum
 * does not depend on where bands end. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/bloom.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BLOOM_GATHER_FIELDS_(F, U) } push;
layout(set = 0, binding = 0) readonly buffer Radiance { float radiance[]; };
layout(set = 0, binding = 1) buffer Parts { vec4 parts[]; };

/* Where cell i of n cells begins, in pixels; the products are integers below 2^31. */
float edge(uint i, uint pixels, uint n) { return float(i * pixels / n) + float(i * pixels % n) / float(n); }

/* Of the part of a pixel from a to b within a cell from `from` to `to`: its share of the cell, as the three cells get it. */
vec3 shares(float a, float b, float from, float to)
{
    a = max(a, from);
    b = min(b, to);
    float size = to - from;
    return bloom_spline((0.5 * (a + b) - from) / size - 0.5) * ((b - a) / size);
}

/* What a row of pixels gives the cell to the left, its own, and the one to the right. */
mat3 row_of(uint y, float left, float right)
{
    mat3 sum = mat3(0);
    uint last = min(uint(ceil(right)), push.pixels_x);
    for (uint x = uint(left); x < last; x++) {
        uint at = 3 * ((y - push.row0) * push.pixels_x + x);
        vec3 light = push.gain * vec3(radiance[at], radiance[at + 1], radiance[at + 2]);
        sum += outerProduct(bloom_of(light, push.strength), shares(float(x), float(x + 1), left, right));
    }
    return sum;
}

mat3 kept(uint at) { return mat3(parts[at].rgb, parts[at + 1].rgb, parts[at + 2].rgb); }
void keep(uint at, mat3 sum)
{
    parts[at] = vec4(sum[0], 0);
    parts[at + 1] = vec4(sum[1], 0);
    parts[at + 2] = vec4(sum[2], 0);
}

void main()
{
    uint n = gl_GlobalInvocationID.x;
    if (n >= push.cells_x * push.cell_rows)
        return;
    uint i = n % push.cells_x, j = push.cell_row0 + n / push.cells_x, at = 9 * (j * push.cells_x + i);
    float left = edge(i, push.pixels_x, push.cells_x), right = edge(i + 1, push.pixels_x, push.cells_x);
    float top = edge(j, push.pixels_y, push.cells_y), bottom = edge(j + 1, push.pixels_y, push.cells_y);
    uint first = uint(top), last = min(min(uint(ceil(bottom)), push.pixels_y), push.row0 + push.rows);
    bool begun = first < push.row0;
    mat3 above = begun ? kept(at) : mat3(0), own = begun ? kept(at + 3) : mat3(0), below = begun ? kept(at + 6) : mat3(0);
    for (uint y = max(first, push.row0); y < last; y++) {
        vec3 weight = shares(float(y), float(y + 1), top, bottom);
        mat3 row = row_of(y, left, right);
        above += weight.x * row;
        own += weight.y * row;
        below += weight.z * row;
    }
    keep(at, above);
    keep(at + 3, own);
    keep(at + 6, below);
}
