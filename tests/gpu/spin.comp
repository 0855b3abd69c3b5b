// Work that takes long enough to be timed: `rounds` dependent steps of a linear congruence in each invocation.
#version 450
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer State { uint state[]; };
layout(push_constant) uniform Push { uint n, rounds; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= n)
        return;
    uint s = state[i];
    for (uint k = 0; k < rounds; k++)
        s = s * 1664525u + 1013904223u;
    state[i] = s;
}
