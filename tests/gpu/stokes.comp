// Computes the light behind a length of matter by shaders/light/stokes.glsl. Input: 10 numbers of the matter. Output: 8
// numbers, 4 for light that enters from behind and 4 for the matter's own light.
#version 450
#extension GL_GOOGLE_include_directive : require
#define real float
#include "shared/math.glsl"
#include "light/stokes.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer In { float of[]; };
layout(set = 0, binding = 1) buffer Out { float gives[]; };
layout(push_constant) uniform Push
{
    uint n;
    float q, u, v;
};

void main()
{
    uint i = gl_GlobalInvocationID.x, at = 10u * i;
    if (i >= n)
        return;
    kd_stokes m = kd_stokes(vec4(1.0, of[at], of[at + 1u], of[at + 2u]), of[at + 3u],
                            vec3(of[at + 4u], of[at + 5u], of[at + 6u]), vec3(of[at + 7u], of[at + 8u], of[at + 9u]));
    kd_stokes_cell cell = kd_stokes_cell_of(m);
    vec4 through = kd_jones_on(cell.passes, vec4(1.0, q, u, v));
    for (uint k = 0u; k < 4u; k++) {
        gives[8u * i + k] = through[k];
        gives[8u * i + 4u + k] = cell.light[k];
    }
}
