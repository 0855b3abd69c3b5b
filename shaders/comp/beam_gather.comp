/* Kernel: converts rows of light to rows of cells (render/plan/beam.h). An invocation makes one cell of one row. If
 * cells are larger than pixels, the cell's light is the mean of the row's adjacent pixels, weighted by a quadratic
 * B-spline of the cells' width. Otherwise it is the light of the cell's own pixel. Light that is NaN, or 10^30 and
 * more, counts as 0, because it would spread over the whole picture. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
#include "shared/beam.glsl"
KD_SPEC_BEAM(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;
#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BEAM_BAND_FIELDS_(F, U) } push;
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer radiance;
vec4 four_floats(int i) { return texelFetch(radiance, i); }
#else
layout(set = 0, binding = 0) readonly buffer Radiance { vec4 radiance[]; };
vec4 four_floats(int i) { return radiance[i]; }
#endif
layout(set = 0, binding = 1) writeonly buffer Lines { vec4 lines[]; };

vec3 seen(vec3 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b < 1e30 ? c : vec3(0); }

void main()
{
    uint n = gl_GlobalInvocationID.x;
    if (n >= push.columns * push.rows)
        return;
    int i = int(n % push.columns), width = int(push.pixels_x), cell = int(push.cell);
    int row = int(n / push.columns) * width; /* index of the first pixel of the row */
    int from = row + (COARSE ? max(cell * (i - 2), 0) : i), to = row + (COARSE ? min(cell * (i + 1), width) : i + 1);
    float middle = COARSE ? float(i) - 0.5 : 0.0;
    vec3 sum = vec3(0);
    /* Three vectors of four floats are four pixels. */
    for (int four = from / 4; 4 * four < to; four++) {
        vec4 a = four_floats(3 * four), b = four_floats(3 * four + 1), c = four_floats(3 * four + 2);
        vec3 light[4] = { a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw };
        for (int k = 0; k < 4; k++) {
            int at = 4 * four + k;
            float t = (float(at - row) + 0.5) * push.cells - middle;
            float weight = COARSE ? beam_spline(t) * push.cells : 1.0;
            sum += at >= from && at < to ? weight * seen(light[k]) : vec3(0);
        }
    }
    lines[push.row0 * push.columns + n] = vec4(sum, 0);
}
