/* What is spread by the cells of one grid, and of all coarser ones: this grid's share, and the coarser grid's sum on this one.
 *
 * The coarser sum: weights 3 and 1 over 4 (G. Chaikin 1974) are those by which a quadratic B-spline is one of half the spacing: all grids
 * together are a sum of such splines, whatever grid they are looked up on. The share is smoothed by 1, 2, 1 over 4 each way, which has a
 * zero where a grid mistakes waves for longer ones: so a point of light spreads alike wherever in its cell it is. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/bloom.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;
layout(push_constant) uniform Push { uint cells_x, cells_y; float share, coarse_share; } push; /* of the fine grid */
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

vec3 smoothed(int x, int y, int across, int rows)
{
    int left = bloom_mirror(x - 1, across), right = bloom_mirror(x + 1, across);
    vec3 sum = vec3(0);
    for (int k = -1; k <= 1; k++) {
        int row = across * bloom_mirror(y + k, rows);
        sum += (k == 0 ? 2.0 / 16 : 1.0 / 16) * (cell(row + left) + 2 * cell(row + x) + cell(row + right));
    }
    return sum;
}

void main()
{
    int n = int(gl_GlobalInvocationID.x), across = int(push.cells_x), columns = across / 2, rows = int(push.cells_y) / 2;
    if (n >= across * int(push.cells_y))
        return;
    int x = n % across, y = n / across;
    int near = x / 2, far = bloom_mirror(near + 2 * (x % 2) - 1, columns);
    int row = columns * (y / 2), beside = columns * bloom_mirror(y / 2 + 2 * (y % 2) - 1, rows);
    vec3 sum = (9 * coarse_cell(row + near) + 3 * (coarse_cell(row + far) + coarse_cell(beside + near)) + coarse_cell(beside + far)) / 16;
    fine[n] = vec4(push.share * smoothed(x, y, across, int(push.cells_y)) + push.coarse_share * sum, 0);
}
