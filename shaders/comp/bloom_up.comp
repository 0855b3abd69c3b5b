/* Kernel: adds the light that one grid spreads to the sum of the light that all coarser grids spread. The next coarser
 * grid holds that sum; the result is on the cells of the finer grid.
 *
 * With the weights 3 and 1 over 4 (G. Chaikin 1974) a quadratic B-spline becomes one of half the spacing. So the light
 * of all grids together is a sum of quadratic B-splines, and the result does not depend on the grid on which they are
 * evaluated. This grid's light is smoothed by 1, 2, 1 over 4 along each side. This smoothing removes the frequency that
 * the grid aliases, so a point of light spreads in the same way wherever it is in its cell. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_BLOOM_GRID(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/bloom.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;
layout(push_constant) uniform Push
{
    uint cells_x, cells_y;
    float share, coarse_share;
}
push; /* numbers of columns and rows of the fine grid */
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer coarse;
layout(set = 0, binding = 1) uniform textureBuffer light;
vec3 coarse_cell(int at) { return texelFetch(coarse, at).rgb; }
vec3 cell(int at) { return texelFetch(light, at).rgb; }
#else
layout(set = 0, binding = 0) readonly buffer Coarse { vec4 coarse[]; };
layout(set = 0, binding = 1) readonly buffer Light { vec4 light[]; };
vec3 coarse_cell(int at) { return coarse[at].rgb; }
vec3 cell(int at) { return light[at].rgb; }
#endif
layout(set = 0, binding = 2) writeonly buffer Fine { vec4 fine[]; };

/* Smooths four cells in a row by the weights 1, 2, 1. Returns the values of the two middle cells, times 4. */
struct pair { vec3 a, b; };

pair smoothed(int row, ivec4 x)
{
    vec3 p = cell(row + x.x), q = cell(row + x.y), r = cell(row + x.z), s = cell(row + x.w);
    return pair(p + 2 * q + r, q + 2 * r + s);
}

/* Two fine cells from three coarse ones, times 4. */
pair finer(int row, ivec3 x)
{
    vec3 p = coarse_cell(row + x.x), q = coarse_cell(row + x.y), r = coarse_cell(row + x.z);
    return pair(p + 3 * q, 3 * q + r);
}

/* An invocation makes two cells along each side, which share what they read. */
void main()
{
    int across = int(push.cells_x), rows = int(push.cells_y), columns = (across + 1) / 2;
    uvec2 place = bloom_place(gl_GlobalInvocationID.x, uint(columns));
    int x = 2 * int(place.x), y = 2 * int(place.y);
    if (y >= rows)
        return;
    ivec4 at = ivec4(bloom_column(x - 1, across, AROUND), x, bloom_column(x + 1, across, AROUND),
                     bloom_column(x + 2, across, AROUND));
    pair a = smoothed(across * bloom_mirror(y - 1, rows), at), b = smoothed(across * y, at);
    pair c = smoothed(across * bloom_mirror(y + 1, rows), at), d = smoothed(across * bloom_mirror(y + 2, rows), at);
    int half_x = across / 2, half_y = rows / 2;
    ivec3 near = ivec3(bloom_column(x / 2 - 1, half_x, AROUND), bloom_column(x / 2, half_x, AROUND),
                       bloom_column(x / 2 + 1, half_x, AROUND));
    pair e = finer(half_x * bloom_mirror(y / 2 - 1, half_y), near),
         f = finer(half_x * bloom_mirror(y / 2, half_y), near);
    pair g = finer(half_x * bloom_mirror(y / 2 + 1, half_y), near);
    float own = push.share / 16, above = push.coarse_share / 16;
    vec3 upper_left = own * (a.a + 2 * b.a + c.a) + above * (e.a + 3 * f.a),
         upper_right = own * (a.b + 2 * b.b + c.b) + above * (e.b + 3 * f.b);
    vec3 lower_left = own * (b.a + 2 * c.a + d.a) + above * (3 * f.a + g.a),
         lower_right = own * (b.b + 2 * c.b + d.b) + above * (3 * f.b + g.b);
    int n = across * y + x;
    bool more = x + 1 < across, below = y + 1 < rows;
    fine[n] = vec4(upper_left, 0);
    if (more)
        fine[n + 1] = vec4(upper_right, 0);
    if (below)
        fine[n + across] = vec4(lower_left, 0);
    if (more && below)
        fine[n + across + 1] = vec4(lower_right, 0);
}
