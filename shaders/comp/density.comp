/* Kernel: converts the weights counted by particles.comp to the density at each node, relative to the expected
 * density. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"

layout(local_size_x = KD_GROUP_SIZE) in;
layout(push_constant) uniform Push { uint columns; }
push;
layout(set = 0, binding = 0) readonly buffer Grid { uint grid[]; };
/* expected number of particles per unit of density, for each row */
layout(set = 0, binding = 1) readonly buffer Expected { float per_unit[]; };
layout(set = 0, binding = 2) writeonly buffer Density { float density[]; };

void main()
{
    uint j = gl_GlobalInvocationID.x, i = gl_WorkGroupID.y;
    if (j >= push.columns)
        return;
    uint row = i * push.columns;
    uint sum = (grid[row + j] & 0xffffu) + (grid[row + ((j - 1) & (push.columns - 1))] >> 16);
    density[row + j] = float(sum) * per_unit[i];
}
