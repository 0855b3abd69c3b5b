/* Kernel: converts rows of cells back to rows of light; this is the inverse of beam_gather.comp. An invocation makes
 * four pixels of a band. Three vectors of four floats hold them. */
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
layout(set = 0, binding = 0) uniform textureBuffer lines;
vec3 cell(int i) { return texelFetch(lines, i).rgb; }
#else
layout(set = 0, binding = 0) readonly buffer Lines { vec4 lines[]; };
vec3 cell(int i) { return lines[i].rgb; }
#endif
layout(set = 0, binding = 1) writeonly buffer Light { vec4 light[]; };

/* Light of pixel n of the band, or of the band's last pixel if n is beyond the end. The row n/width is computed by a
 * float product, which may be wrong by one; `more` corrects it. */
vec3 pixel(int n)
{
    int width = int(push.pixels_x);
    n = min(n, width * int(push.rows) - 1);
    int y = int(float(n) * (1 / float(width))), x = n - y * width, more = x >= width ? 1 : x < 0 ? -1 : 0;
    int row = (int(push.row0) + y + more) * int(push.columns);
    x -= more * width;
    if (!COARSE)
        return cell(row + x);
    float u = (float(x) + 0.5) * push.cells, left = floor(u), t = u - left - 0.5;
    /* index of the cell before the pixel's own cell, because the grid has one extra cell to the left of the picture */
    int i = row + int(left);
    return beam_spline(t + 1) * cell(i) + beam_spline(t) * cell(i + 1) + beam_spline(t - 1) * cell(i + 2);
}

void main()
{
    int four = int(gl_GlobalInvocationID.x);
    if (4 * four >= int(push.pixels_x * push.rows))
        return;
    vec3 a = pixel(4 * four), b = pixel(4 * four + 1), c = pixel(4 * four + 2), d = pixel(4 * four + 3);
    light[3 * four] = vec4(a, b.x);
    light[3 * four + 1] = vec4(b.yz, c.xy);
    light[3 * four + 2] = vec4(c.z, d);
}
