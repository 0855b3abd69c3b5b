/* Kernel: blurs a grid of cells by a Gaussian along one axis (render/plan/beam.h). An invocation makes four cells that
 * are adjacent along the axis. The weights for a cell are those for the previous cell, shifted by one. So all four sums
 * read nearly the same cells, and each cell is read once. If ROWS is set, the kernel blurs down the columns, otherwise
 * along the rows. Beyond the ends of the grid there is no light. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_BEAM_BLUR(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;
#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BEAM_BLUR_FIELDS_(F, U) } push;
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer from;
vec3 cell(int i) { return texelFetch(from, i).rgb; }
#else
layout(set = 0, binding = 0) readonly buffer From { vec4 from[]; };
vec3 cell(int i) { return from[i].rgb; }
#endif
layout(set = 0, binding = 1) writeonly buffer To { vec4 to[]; };

void main()
{
    uint n = gl_GlobalInvocationID.x, across = ROWS ? push.columns : (push.columns + 3) / 4;
    if (n >= across * push.lines)
        return;
    int x = int(n % across), y = int(n / across), i = ROWS ? int(push.row0) + 4 * y : 4 * x;
    int step_ = ROWS ? int(push.columns) : 1, base = ROWS ? x : (int(push.row0) + y) * int(push.columns);
    int begin = max(i - int(push.reach), 0), end = min(i + 4 + int(push.reach), int(push.length_));
    /* The weight w falls with the distance t: w(t + 1)/w(t) shrinks by a constant factor at each step. */
    float t = float(begin - i), ratio = exp(-push.narrow * (2 * t + 1)), fall = exp(-2 * push.narrow);
    vec4 w = exp(-push.narrow * vec4(t * t, (t - 1) * (t - 1), (t - 2) * (t - 2), (t - 3) * (t - 3)));
    vec3 sum[4] = { vec3(0), vec3(0), vec3(0), vec3(0) };
    for (int k = begin; k < end; k++) {
        vec3 c = cell(base + k * step_);
        sum[0] += w.x * c;
        sum[1] += w.y * c;
        sum[2] += w.z * c;
        sum[3] += w.w * c;
        w = vec4(w.x * ratio, w.xyz);
        ratio *= fall;
    }
    for (int j = 0; j < 4; j++)
        if (i + j < int(push.length_))
            to[base + (i + j) * step_] = vec4(push.weight * sum[j], 0);
}
