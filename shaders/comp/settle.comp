/* Kernel: writes rays that were traced again, in double on the host, to their places in the lens map
 * (src/render/frame/settle.c). */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"

layout(local_size_x = KD_GROUP_SIZE) in;
layout(push_constant) uniform Push { uint rays, planes, stride; }
push;
layout(set = 0, binding = 0) writeonly buffer LensMap { float lens[]; };
layout(set = 0, binding = 1) readonly buffer Settled
{
    uint places[];
    /* one word for each ray with its index in the map; then the planes of values, one after the other, as bits of
     * floats */
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.rays)
        return;
    for (uint k = 0; k < push.planes; k++)
        lens[k * push.stride + places[i]] = uintBitsToFloat(places[(1u + k) * push.rays + i]);
}
