/* Exposure, tone map, sRGB encoding, dither, rounding. One invocation writes four pixels as whole words: RGB of 8 bits in
 * three, of 16 bits in six, packed without padding as a PNG encoder wants them. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_POST(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_POST_FIELDS_(F, U) } push;
layout(set = 0, binding = 0) readonly buffer Radiance { float radiance[]; };
layout(set = 0, binding = 1) writeonly buffer Pixels { uint words[]; };

/* ACES reference rendering and sRGB output transforms: S. Hill's rational fit, with his matrices into and out of the space
 * in which the curve acts (2016). */
vec3 aces(vec3 c)
{
    const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 outof = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    c = into * c;
    c = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
    return clamp(outof * c, 0.0, 1.0);
}

float srgb(float c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055; }

/* A threshold in (-1/2, 1/2) that depends on the place alone: interleaved gradient noise (J. Jimenez 2014). */
float threshold(uint x, uint y)
{
    return fract(52.9829189 * fract(0.06711056 * float(x) + 0.00583715 * float(y))) - 0.5;
}

uvec3 pixel(uint i)
{
    vec3 c = push.gain * vec3(radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]);
    c = min(c, vec3(1e6)); /* the curve squares it */
    c = ACES ? aces(c) : clamp(c, 0.0, 1.0);
    uint place = push.first + i;
    float d = push.dither * threshold(place % push.pixels_x, place / push.pixels_x) * 0.998;
    vec3 v = vec3(srgb(c.r), srgb(c.g), srgb(c.b)) * push.levels;
    return uvec3(clamp(floor(v + 0.5 + d), 0.0, push.levels));
}

void main()
{
    uint block = gl_GlobalInvocationID.x, i = KD_POST_PIXELS * block;
    if (i >= push.pixels)
        return;
    uvec3 p[KD_POST_PIXELS];
    for (uint k = 0; k < KD_POST_PIXELS; k++)
        p[k] = pixel(min(i + k, push.pixels - 1));
    if (WIDE) {
        uint o = 6 * block;
        words[o] = p[0].r | p[0].g << 16;
        words[o + 1] = p[0].b | p[1].r << 16;
        words[o + 2] = p[1].g | p[1].b << 16;
        words[o + 3] = p[2].r | p[2].g << 16;
        words[o + 4] = p[2].b | p[3].r << 16;
        words[o + 5] = p[3].g | p[3].b << 16;
    } else {
        uint o = 3 * block;
        words[o] = p[0].r | p[0].g << 8 | p[0].b << 16 | p[1].r << 24;
        words[o + 1] = p[1].g | p[1].b << 8 | p[2].r << 16 | p[2].g << 24;
        words[o + 2] = p[2].b | p[3].r << 8 | p[3].g << 16 | p[3].b << 24;
    }
}
