/* Kernel: converts rows of pixels to rows of cells, or back, by quadratic B-splines (render/plan/beam.h). The dispatch
 * makes a slice of rows, and each invocation makes one cell. The cell is a weighted sum of `count` cells of the same
 * column, above and below it. There is no light beyond the ends of the column. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/beam.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;
#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BEAM_SPLINE_FIELDS_(F, U) } push;
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
    uint n = gl_GlobalInvocationID.x;
    if (n >= push.columns * push.rows)
        return;
    uint i = push.row0 + n / push.columns;
    int x = int(n % push.columns), first = int(i * push.first_times / push.first_over) - int(push.before);
    int begin = max(first, 0), end = min(first + int(push.count), int(push.length_));
    float middle = (float(i) + 0.5) * push.to_scale + push.shift;
    vec3 sum = vec3(0);
    for (int k = begin; k < end; k++)
        sum += beam_spline((float(k) + 0.5) * push.from_scale - middle) * cell(k * int(push.columns) + x);
    to[push.row0 * push.columns + n] = vec4(push.weight * sum, 0);
}
