/* What the nine cells round each cell of the finest grid have for it (bloom_gather.comp). What they would give to cells beyond the edge comes
 * back to those inside it. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/bloom.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;
layout(push_constant) uniform Push { uint cells_x, cells_y; float share, coarse_share; } push;
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer parts;
vec3 part(int at) { return texelFetch(parts, at).rgb; }
#else
layout(set = 0, binding = 0) readonly buffer Parts { vec4 parts[]; };
vec3 part(int at) { return parts[at].rgb; }
#endif
layout(set = 0, binding = 1) writeonly buffer Cells { vec4 cells[]; };

void main()
{
    int n = int(gl_GlobalInvocationID.x), across = int(push.cells_x), rows = int(push.cells_y), x = n % across, y = n / across;
    if (n >= across * rows)
        return;
    vec3 sum = vec3(0);
    for (int j = -1; j <= 1; j++) {
        int from_y = bloom_mirror(y + j, rows), side_y = from_y == y + j ? -j : j; /* a mirror image gives to the other side */
        for (int i = -1; i <= 1; i++) {
            int from_x = bloom_mirror(x + i, across), side_x = from_x == x + i ? -i : i;
            sum += part(9 * (across * from_y + from_x) + 3 * (side_y + 1) + side_x + 1);
        }
    }
    cells[n] = vec4(sum, 0);
}
