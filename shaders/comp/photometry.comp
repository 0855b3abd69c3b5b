/* Kernel: sums the light of a picture for its flux and centroid. A pixel x and y steps from the middle has the
 * luminance Y. With f = 1/|(1, x step, y step)|, or f = 1 in the image plane, the kernel computes
 *
 *   sum of Y f^3, of Y f^4, of Y f^4 x, of Y f^4 y,
 *
 * for the whole picture and for the hot spots' own light. If Stokes parameters are kept, it also sums Q, U and V, and
 * the spots' Q and U, times f^3. f^3 is the solid angle of a pixel relative to the middle one; f times (1, x step, y
 * step) is the unit vector towards it. An invocation sums KD_LIGHT_PIXELS pixels with compensation (W. Kahan 1965, CACM
 * 8, 40); the host adds these sums in double. The order is always the same. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_PHOTOMETRY(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;
#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_LIGHT_FIELDS_(F, U) } push;
layout(set = 0, binding = 0) readonly buffer Radiance { float radiance[]; };
layout(set = 0, binding = 1) writeonly buffer Sums { vec4 sums[]; };

/* A compensated sum. value: the sum so far. lost: the amount by which rounding has made `value` too large. */
struct sum4 { precise vec4 value, lost; };

sum4 add(sum4 s, vec4 term)
{
    precise vec4 small = term - s.lost, next = s.value + small;
    s.lost = (next - s.value) - small;
    s.value = next;
    return s;
}

void main()
{
    /* Adjacent invocations read adjacent pixels. */
    uint o = gl_WorkGroupID.x * (KD_GROUP_SIZE * KD_LIGHT_PIXELS) + gl_LocalInvocationID.x;
    uint px = o % push.pixels_x, row = o / push.pixels_x;
    sum4 all = sum4(vec4(0.0), vec4(0.0)), spots = all, stokes = all, stokes_spots = all;
    for (uint k = 0; k < KD_LIGHT_PIXELS && o < push.pixels; k++) {
        float x = float(px) - push.middle_x, y = push.middle_y - float(push.row0 + row);
        float f = FINITE ? 1.0 / sqrt(1.0 + push.step_ * push.step_ * (x * x + y * y)) : 1.0;
        vec4 term = f * f * f * vec4(1.0, f, f * x, f * y);
        float light = 0.2126 * radiance[3 * o] + 0.7152 * radiance[3 * o + 1] + 0.0722 * radiance[3 * o + 2];
        all = add(all, light * term);
        if (SEPARATE_PHOTOMETRY)
            spots = add(spots, radiance[push.spots + o] * term);
        if (STOKES) {
            uint at = push.stokes + o;
            vec3 s = vec3(radiance[at], radiance[at + push.plane], radiance[at + 2 * push.plane]);
            stokes = add(stokes, vec4(s.xy, s.z > KD_STOKES_LEAST_UNTOLD ? 0.0 : s.z, 0.0) * term.x);
            if (STOKES_APART)
                stokes_spots =
                    add(stokes_spots,
                        vec4(radiance[at + 3 * push.plane], radiance[at + 4 * push.plane], 0.0, 0.0) * term.x);
        }
        o += KD_GROUP_SIZE;
        for (px += KD_GROUP_SIZE; px >= push.pixels_x; px -= push.pixels_x)
            row++;
    }
    uint to = (STOKES ? 4 : 2) * gl_GlobalInvocationID.x;
    sums[to] = all.value;
    sums[to + 1] = spots.value;
    if (STOKES) {
        sums[to + 2] = stokes.value;
        sums[to + 3] = stokes_spots.value;
    }
}
