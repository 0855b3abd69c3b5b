/* Kernel: histogram of the picture's luminance, for auto exposure. Counts are integers, so every run gives the same
 * histogram. In a large picture the kernel counts only every `skip`-th pixel. `skip` has no common divisor with usual
 * widths, so that the pixels come from all columns. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"

layout(local_size_x = KD_GROUP_SIZE) in;
layout(push_constant) uniform Push { uint pixels, skip; }
push;
layout(set = 0, binding = 0) readonly buffer Radiance { float radiance[]; };
layout(set = 0, binding = 1) buffer Histogram { uint histogram[KD_HISTOGRAM_BINS]; };
shared uint local_bins[KD_HISTOGRAM_BINS];

void main()
{
    for (uint i = gl_LocalInvocationID.x; i < KD_HISTOGRAM_BINS; i += KD_GROUP_SIZE)
        local_bins[i] = 0;
    barrier();
    uint step_ = gl_NumWorkGroups.x * KD_GROUP_SIZE;
    for (uint i = gl_GlobalInvocationID.x * push.skip; i < push.pixels; i += step_ * push.skip) {
        float y = 0.2126 * radiance[3 * i] + 0.7152 * radiance[3 * i + 1] + 0.0722 * radiance[3 * i + 2];
        uint bin = 0;
        if (y > 0.0)
            bin = clamp(floatBitsToUint(y) >> 20, KD_HISTOGRAM_FIRST + 1, KD_HISTOGRAM_FIRST + KD_HISTOGRAM_BINS - 1) -
                  KD_HISTOGRAM_FIRST;
        atomicAdd(local_bins[bin], 1);
    }
    barrier();
    for (uint i = gl_LocalInvocationID.x; i < KD_HISTOGRAM_BINS; i += KD_GROUP_SIZE)
        if (local_bins[i] != 0)
            atomicAdd(histogram[i], local_bins[i]);
}
