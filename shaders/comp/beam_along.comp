/* A grid of cells from another, by weights along one of its axes (render/plan/beam.h). An invocation makes one cell of a slice of rows. BLUR weighs by a
 * Gaussian; else by a quadratic B-spline: from rows of pixels to rows of cells, and back. What lies beyond the ends is dark. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
#include "shared/beam.glsl"
KD_SPEC_BEAM_ALONG(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;
#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BEAM_ALONG_FIELDS_(F, U) } push;
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
    int across = int(push.columns), x = int(n % push.columns), y = int(push.row0 + n / push.columns), i = ROWS ? y : x;
    int first = int(uint(i) * push.first_times / push.first_over) - int(push.before);
    int step_ = ROWS ? across : 1, base = ROWS ? x : y * across;
    int begin = max(first, 0), end = min(first + int(push.count), int(push.length_));
    float middle = (float(i) + 0.5) * push.to_scale + push.shift;
    vec3 sum = vec3(0);
    for (int k = begin; k < end; k++) {
        float t = (float(k) + 0.5) * push.from_scale - middle;
        sum += (BLUR ? exp(-push.narrow * t * t) : beam_spline(t)) * cell(base + k * step_);
    }
    to[y * across + x] = vec4(push.weight * sum, 0);
}
