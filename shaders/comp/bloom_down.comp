/* Kernel: makes a grid from the next finer one. The new grid has half as many cells along each side, and the weights
 * are 1, 3, 3, 1 over 8. Coarse cells receive all light of the fine cells. A quadratic B-spline of the fine grid
 * becomes a quadratic B-spline of the coarse grid. */
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
push; /* numbers of columns and rows of the coarse grid */
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer fine;
vec3 cell(int at) { return texelFetch(fine, at).rgb; }
#else
layout(set = 0, binding = 0) readonly buffer Fine { vec4 fine[]; };
vec3 cell(int at) { return fine[at].rgb; }
#endif
layout(set = 0, binding = 1) writeonly buffer Coarse { vec4 coarse[]; };

void main()
{
    int n = int(gl_GlobalInvocationID.x), across = int(push.cells_x), rows = 2 * int(push.cells_y),
        columns = 2 * across;
    if (n >= across * int(push.cells_y))
        return;
    int x = 2 * (n % across) - 1, y = 2 * (n / across) - 1;
    int x0 = bloom_column(x, columns, AROUND), x3 = bloom_column(x + 3, columns, AROUND);
    vec3 sum = vec3(0);
    for (int k = 0; k < 4; k++) {
        int row = columns * bloom_mirror(y + k, rows);
        float weight = k == 0 || k == 3 ? 1.0 / 64 : 3.0 / 64;
        sum += weight * (cell(row + x0) + cell(row + x3) + 3 * (cell(row + x + 1) + cell(row + x + 2)));
    }
    coarse[n] = vec4(sum, 0);
}
