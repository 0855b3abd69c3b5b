// Computes y * mul + x + BIAS. The result depends on the order of the dispatches, so that a missing barrier changes it.
#version 450
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint BIAS = 0;
layout(set = 0, binding = 0) readonly buffer X { uint x[]; };
layout(set = 0, binding = 1) buffer Y { uint y[]; };
layout(push_constant) uniform Push { uint n, mul; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < n)
        y[i] = y[i] * mul + x[i] + BIAS;
}
