/* Kernel: converts light to pixels: exposure, tone map, sRGB encoding, dither, rounding. One invocation writes four
 * pixels as whole words: three words for RGB of 8 bits, six words for RGB of 16 bits. They are packed without padding,
 * as a PNG encoder needs them. Invocations after the last pixel write zeros.
 *
 * This file is compiled to eight kernels, for all combinations of three macros. KD_TEXELS reads the radiance as texels
 * of four floats, three of which are four pixels. KD_BLOOM removes the light that a lens spreads, and adds the light
 * that arrives. KD_HEAT shows the luminance after the tone curve in false colour. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
#include "shared/math.glsl"
#ifdef KD_BLOOM
#include "shared/bloom.glsl"
#endif
KD_SPEC_POST(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_POST_FIELDS_(F, U) } push;
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer radiance;
vec4 four_floats(uint i) { return texelFetch(radiance, int(i)); }
#else
layout(set = 0, binding = 0) readonly buffer Radiance { vec4 radiance[]; };
vec4 four_floats(uint i) { return radiance[i]; }
#endif
#ifdef KD_BLOOM
#ifdef KD_TEXELS
layout(set = 0, binding = 2) uniform textureBuffer cells;
vec3 cell(int i) { return texelFetch(cells, i).rgb; }
#else
layout(set = 0, binding = 2) readonly buffer Cells { vec4 cells[]; };
vec3 cell(int i) { return cells[i].rgb; }
#endif
#endif
layout(set = 0, binding = 1) buffer Pixels { uint words[]; };
#ifdef KD_HEAT
#ifdef KD_BLOOM
layout(set = 0, binding = 3) uniform textureBuffer colours;
#else
layout(set = 0, binding = 2) uniform textureBuffer colours;
#endif
#endif

#define LEVELS (WIDE ? 65535 : 255)

/* ACES reference rendering and sRGB output transforms: S. Hill's rational fit, with his matrices into and out of the
 * space in which the curve acts (2016). Numerator and denominator are divided by 0.983729; for the numerator this
 * division is part of the second matrix. */
vec3 aces(vec3 c)
{
    const float d = 0.983729;
    const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 outof = mat3(1.60475 / d, -0.10208 / d, -0.00327 / d, -0.53108 / d, 1.10813 / d, -0.07276 / d,
                            -0.07367 / d, -0.00605 / d, 1.07602 / d);
    c = into * min(c, vec3(1e6)); /* limits the light, because the curve squares it */
    c = (c * (c + 0.0245786) - 0.000090537) / (c * (c + 0.4329510 / d) + 0.238081 / d);
    return outof * c;
}

/* Khronos PBR Neutral (E. Chin, 2024): light below 0.8 keeps its colour and, except for an offset of 0.04, its
 * brightness. Above 0.8, as light becomes brighter, its largest channel tends to 1 and its colour to white. */
vec3 neutral(vec3 c)
{
    const float start = 0.8 - 0.04, desaturation = 0.15, d = 1 - start;
    c = min(c, vec3(1e6));
    float least = min(c.r, min(c.g, c.b));
    c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(c.r, max(c.g, c.b)), shown = 1 - d * d / (peak + d - start);
    vec3 bright = mix(c * (shown / peak), vec3(shown), 1 - 1 / (desaturation * (peak - shown) + 1));
    return peak < start ? c : bright;
}

/* The encoding of c in [0, 1] by IEC 61966-2-1, times LEVELS. The power 1.055 c^(1/2.4) - 0.055 is approximated by a
 * polynomial in s = c^(1/4) for c from 0.0031308 to 1. Among polynomials that are 1 at c = 1 it is the best: its
 * largest error is 3.4e-7. 2e-7 is added, so that white is 65535 in spite of roundoff. The total error is below 5.4e-7,
 * a thirtieth of a step of 16 bits. */
vec3 srgb(vec3 c)
{
    const float unit = float(LEVELS);
    vec3 s = sqrt(sqrt(c)), p = vec3(-0.0739483505679 * unit);
    p = p * s + 0.385429949916 * unit;
    p = p * s - 0.882619007895 * unit;
    p = p * s + 1.19475044398 * unit;
    p = p * s - 1.14831670556 * unit;
    p = p * s + 1.45922793182 * unit;
    p = p * s + 0.123946936286 * unit;
    p = p * s - 0.0584709979785 * unit;
    return mix(p, 12.92 * unit * c, lessThanEqual(c, vec3(0.0031308)));
}

#ifdef KD_HEAT
/* The false colour of a luminance in [0, 1], times LEVELS. The table's entries are encoded as sRGB; between entries the
 * colour is linear. */
vec3 heat(float y)
{
    float at = clamp(y, 0.0, 1.0) * float(textureSize(colours) - 1);
    int i = clamp(int(at), 0, textureSize(colours) - 2);
    return float(LEVELS) * mix(texelFetch(colours, i).rgb, texelFetch(colours, i + 1).rgb, at - float(i));
}
#endif

/* Column and row of a pixel in the picture. They are floats, which hold such integers exactly. */
struct place { float x, y; };

/* Place of pixel i. The row is a quotient computed in floats, which is wrong by at most one, because places are below
 * 2^30 and rows below 2^15. The code corrects it. */
place place_of(uint i)
{
    int n = int(i), width = int(push.pixels_x), y = int(float(n) * (1 / float(width))), x = n - y * width;
    int more = x >= width ? 1 : x < 0 ? -1 : 0;
    return place(float(x - more * width), float(y + more));
}

place next(place at)
{
    bool ends = at.x + 1 == float(push.pixels_x);
    return place(ends ? 0.0 : at.x + 1, ends ? at.y + 1 : at.y);
}

/* A threshold in [0, 1) that depends only on the place: interleaved gradient noise (J. Jimenez 2014). */
float threshold(place at)
{
    return fract(52.9829189 * fract(0.06711056 * (at.x + push.left) + 0.00583715 * (at.y + push.top)));
}

/* Light that a lens spreads to the four pixels of an invocation. */
struct spread { vec3 a, b, c, d; };

#ifdef KD_BLOOM
/* Light that other pixels spread to this pixel. */
vec3 arriving(place at)
{
    float u = (at.x + 0.5) * push.scale_x, v = (at.y + 0.5) * push.scale_y;
    int across = int(push.cells_x), x = int(u), y = int(v);
    int x0 = bloom_column(x - 1, across, AROUND), x2 = bloom_column(x + 1, across, AROUND);
    vec3 a = bloom_spline(u - float(x) - 0.5), b = bloom_spline(v - float(y) - 0.5), sum = vec3(0);
    for (int k = 0; k < 3; k++) {
        int row = across * bloom_mirror(y + k - 1, int(push.cells_y));
        sum += b[k] * (a.x * cell(row + x0) + a.y * cell(row + x) + a.z * cell(row + x2));
    }
    return sum;
}

/* A column of three cells, weighted by row. */
vec3 column(ivec3 rows, int x, vec3 b)
{
    int at = bloom_column(x, int(push.cells_x), AROUND);
    return b.x * cell(rows.x + at) + b.y * cell(rows.y + at) + b.z * cell(rows.z + at);
}

/* The four pixels of an invocation. If they are adjacent and cells are larger than pixels, four or five columns of
 * cells cover them, and are read once. */
spread arriving_all(place first, place second, place third, place fourth)
{
    if (COLUMNS == 0)
        return spread(arriving(first), arriving(second), arriving(third), arriving(fourth));
    float u = (first.x + 0.5) * push.scale_x, v = (first.y + 0.5) * push.scale_y;
    int across = int(push.cells_x), x = int(u), y = int(v), rows = int(push.cells_y);
    ivec3 row = across * ivec3(bloom_mirror(y - 1, rows), y, bloom_mirror(y + 1, rows));
    vec3 weight = bloom_spline(v - float(y) - 0.5), of[4] = { vec3(0), vec3(0), vec3(0), vec3(0) };
    for (int k = 0; k < int(COLUMNS); k++) {
        vec3 light = column(row, x + k - 1, weight);
        float t = u - float(x) + (0.5 - float(k));
        for (int i = 0; i < 4; i++)
            of[i] += bloom_weight(t + float(i) * push.scale_x) * light;
    }
    return spread(of[0], of[1], of[2], of[3]);
}
#endif

/* Rounds to the next level, or dithers by less than half a level. arrives: light that a lens spreads to the pixel. */
ivec3 pixel(vec3 c, place at, vec3 arrives)
{
    c *= push.gain;
#ifdef KD_BLOOM
    c += arrives - bloom_of(c, push.bloom);
#endif
    c = ACES ? aces(c) : NEUTRAL ? neutral(c) : c;
#ifdef KD_HEAT
    c = heat(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
#else
    c = srgb(clamp(c, 0.0, 1.0));
#endif
    float spread = 0.998 * push.dither;
    /* adds at most one half, or a dither, and truncates; truncation rounds down because the value is positive */
    return min(ivec3(c + (spread * threshold(at) + (0.5 - 0.5 * spread))), LEVELS);
}

bool is_number(vec3 c) { return kd_is_finite(c.r) && kd_is_finite(c.g) && kd_is_finite(c.b); }

/* Number of pixels, of the four, whose light is not finite. left: number of pixels from here to the end of the band.
 * Pixels after the end are not counted. */
uint without_number(vec4 a, vec4 b, vec4 c, uint left)
{
    return (is_number(a.xyz) ? 0u : 1u) + (left < 2u || is_number(vec3(a.w, b.xy)) ? 0u : 1u) +
           (left < 3u || is_number(vec3(b.zw, c.x)) ? 0u : 1u) + (left < 4u || is_number(c.yzw) ? 0u : 1u);
}

void main()
{
    uint block = gl_GlobalInvocationID.x, i = KD_POST_PIXELS * block;
    uint at = 3 * min(block, (push.pixels - 1) / KD_POST_PIXELS);
    vec4 a = four_floats(at), b = four_floats(at + 1), c = four_floats(at + 2);
    place first = place_of(push.first + i), second = next(first), third = next(second), fourth = next(third);
#ifdef KD_BLOOM
    spread to = arriving_all(first, second, third, fourth);
#else
    const spread to = spread(vec3(0), vec3(0), vec3(0), vec3(0));
#endif
    ivec3 p[KD_POST_PIXELS] = { pixel(a.xyz, first, to.a), pixel(vec3(a.w, b.xy), second, to.b),
                                pixel(vec3(b.zw, c.x), third, to.c), pixel(c.yzw, fourth, to.d) };
    /* After the band's end a word is 0. The kernel selects this 0 instead of skipping the computation. lavapipe then
     * stores a finished vector. Otherwise it would pack the vector again for each lane, which takes a fifth of the
     * kernel's time. */
    bool inside = i < push.pixels;
    uint untold = inside && push.counter > 0u ? without_number(a, b, c, push.pixels - i) : 0u;
    if (untold > 0u)
        atomicAdd(words[push.counter], untold);
#define KEEP(word) (inside ? uint(word) : 0u)
    if (WIDE) {
        uint o = 6 * block;
        words[o] = KEEP(p[0].r | p[0].g << 16);
        words[o + 1] = KEEP(p[0].b | p[1].r << 16);
        words[o + 2] = KEEP(p[1].g | p[1].b << 16);
        words[o + 3] = KEEP(p[2].r | p[2].g << 16);
        words[o + 4] = KEEP(p[2].b | p[3].r << 16);
        words[o + 5] = KEEP(p[3].g | p[3].b << 16);
    } else {
        uint o = 3 * block;
        words[o] = KEEP(p[0].r | p[0].g << 8 | p[0].b << 16 | p[1].r << 24);
        words[o + 1] = KEEP(p[1].g | p[1].b << 8 | p[2].r << 16 | p[2].g << 24);
        words[o + 2] = KEEP(p[2].b | p[3].r << 8 | p[3].g << 16 | p[3].b << 24);
    }
}
