/* Kernel: makes one layer of a frame (shared/layers.h) from the lens map. An invocation writes the number of one pixel,
 * or NaN if the pixel has none. LAYER: number of the layer. ORDER: number of the crossing. With KD_MARCH the kernel is
 * for scenes with volumes or bodies; transfer.comp has then stored the light, followed by Stokes Q, U and V. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_TRANSFER(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/layers.h"
#include "light/inputs.glsl"
#include "light/numbers.glsl"
layout(set = 0, binding = 3) writeonly buffer Layer { uint layer[]; };

/* The bits of NaN. NaN is written and recognised by its bits, because a device need not preserve NaN in arithmetic. */
#define KD_NOTHING_BITS 0x7fc00000u
#define KD_INFINITE_BITS 0x7f800000u
#define KD_NOTHING uintBitsToFloat(KD_NOTHING_BITS)

#define NOT_LIGHT_(number, name, needs, value)
#define NOT_(number, name, needs, value, met)
#define NOT_END_(number, name, needs, value)
#define IS_LIGHT_(number, name, needs, value) || LAYER == number
#define IS_(number, name, needs, value, met) || LAYER == number
const bool OF_LIGHT = false KD_LAYERS(IS_LIGHT_, NOT_, NOT_END_);
#define IS_POLARIZED_(number, name, needs, value) || LAYER == (((needs) & KD_LENS_SLOPE) != 0u ? number : 0)
const bool POLARIZED = false KD_LAYERS(IS_POLARIZED_, NOT_, NOT_END_);
const bool OF_CROSSING = false KD_LAYERS(NOT_LIGHT_, IS_, NOT_END_);

/* Optical depth of matter at a sample, along the ray: -ln of its transmission. */
float kd_layer_depth(kd_sample s)
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    kd_beam_at(beam, s);
    return beam.through > 0.0 ? -log(beam.through) : uintBitsToFloat(KD_INFINITE_BITS);
}

/* Least size of a footprint. A ray has no footprint if it has no neighbours, or if its neighbours are indistinguishable
 * from it in 32 bits (comp/footprint.comp). */
#define KD_FOOTPRINT_LEAST 1e-6 /* on the disk relative to r; in the sky in radians */
float kd_layer_size(float footprint, float least)
{
    return footprint < KD_FOOTPRINT_EDGE && footprint >= least ? footprint : KD_NOTHING;
}

kd_sample sample_at(uint n, float w, uint at, kd_ray ray)
{
    uint plane = at + n * slice.stride;
    bool listed =
        /* true if the rays are listed ones about the critical curve, not those of the camera's grid */
        (QUANTITIES & KD_LENS_ALPHA) != 0u;
    float momentum = (listed ? -quantity(KD_LENS_ALPHA, at) : ray.l) * cam.s;
    float ago = SLOW ? quantity(KD_LENS_DELAY, plane) - emission.frame.delay : 0.0,
          slope = quantity(KD_LENS_SLOPE, plane);
    float q =
        listed ? kd_carter_of_slope(ray.e, momentum, w, slope) : kd_geodesic_of(ray, KD_HOLE_OF(cam), cam.u, cam.s).q;
    return kd_with_cosine(kd_sample(w, quantity(KD_LENS_PHI, plane), ago, slope, ray.e, momentum, q,
                                    quantity(KD_LENS_FOOTPRINT, plane), quantity(KD_LENS_SHAPE, plane), n, 0.0));
}

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

/* True if a ray of the pixel was given up, so that the pixel has no number. This is a flag instead of a NaN, because a
 * device need not preserve NaN in sums. */
bool untold = false;

#ifdef KD_MARCH
#define KD_MARCH_MEET(beam, w, n, place, at)
#define KD_MARCH_GIVEN_UP(beam)
#include "light/march.glsl"
#include "light/meet.glsl"
layout(set = 0, binding = KD_LIGHT_BINDING) readonly buffer Radiance { float radiance[]; };

/* Luminance of a pixel (Stokes I), and Stokes Q, U and V. */
vec4 light_of_pixel(uint o)
{
    const uint pixels = emission.frame.band_pixels, at = (KD_SEPARATE_PHOTOMETRY ? 4u : 3u) * pixels + o;
    vec3 stokes = vec3(radiance[at], radiance[at + pixels], radiance[at + 2u * pixels]);
    untold = stokes.z > KD_STOKES_LEAST_UNTOLD;
    return vec4(dot(vec3(radiance[3u * o], radiance[3u * o + 1u], radiance[3u * o + 2u]), LUMINANCE), stokes);
}
#else
/* Stokes Q and U of a ray: all light of a crossing has the same polarisation. */
vec2 polarized = vec2(0.0);
void at_crossing(inout kd_beam beam, kd_sample s, uvec2 place, kd_ray ray)
{
    float before = dot(beam.light, LUMINANCE);
    kd_beam_at(beam, s);
    if (POLARIZED && KD_HAS(polarization))
        polarized += (dot(beam.light, LUMINANCE) - before) * kd_polarization_at(s, kd_polarization_right(place), ray.p);
}

/* Luminance of a ray (Stokes I), and Stokes Q, U and V, as the light arrives. They are for all light of the ray, or for
 * the light of one order. */
vec4 light(uvec2 place, uint at, uint pixel)
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    kd_ray ray = kd_camera_ray(place.x, place.y);
    bool given_up = false;
    polarized = vec2(0.0);
    for (uint n = 0; KD_GLOWS && n < (ORDER == KD_NO_ORDER ? ORDERS : ORDER + 1u); n++) {
        float w = lens[at + n * slice.stride];
        if (ORDER != KD_NO_ORDER)
            beam.light = vec3(0.0), polarized = vec2(0.0);
        given_up = given_up || w < 0.0;
        if (w <= 0.0)
            break;
        at_crossing(beam, sample_at(n, w, at, ray), place, ray);
    }
    if (ORDER == KD_NO_ORDER && KD_ENDS && (QUANTITIES & KD_LENS_FATE) != 0u) {
        float fate = quantity(KD_LENS_FATE, at);
        given_up = given_up || fate == KD_FATE_UNDECIDED;
        if (fate == KD_FATE_ESCAPED)
            kd_beam_end(beam, kd_end(quantity(KD_LENS_SKY_U, at), quantity(KD_LENS_SKY_PHI, at),
                                     quantity(KD_LENS_SKY_FOOTPRINT, at), ray.e));
        kd_beam_points(beam, pixel);
    }
    untold = untold || given_up;
    return vec4(dot(beam.light, LUMINANCE), polarized, 0.0);
}
#endif

/* kd_layer_evpa: angle of the electric field, from north to east, in (-pi/2, pi/2]. kd_layer_polarized: degree of
 * polarisation. */
float kd_layer_evpa(vec4 light)
{
    float by = kd_squarable(max(abs(light.y), abs(light.z)));
    return light.y == 0.0 && light.z == 0.0 ? KD_NOTHING : 0.5 * kd_atan2(light.z * by, light.y * by);
}
float kd_layer_polarized(vec4 light) { return light.x > 0.0 ? kd_part_of(vec3(light.yz, 0.0), light.x) : KD_NOTHING; }

/* The layer's value for the mean light of a pixel. */
float value_of_light(vec4 light)
{
#define LIGHT_VALUE_(number, name, needs, value) \
    if (LAYER == number) \
        return value;
    KD_LAYERS(LIGHT_VALUE_, NOT_, NOT_END_)
    return KD_NOTHING;
}

/* The layer's value at a crossing, which must lie on the disk. */
float value_of(kd_sample s, float delay)
{
#define VALUE_(number, name, needs, value, met) \
    if (LAYER == number) \
        return value;
    KD_LAYERS(NOT_LIGHT_, VALUE_, NOT_END_)
    return KD_NOTHING;
}

#ifdef KD_MARCH
/* The layer's value at a body that hides what is behind it. */
float value_of_met(kd_met met)
{
#define MET_(number, name, needs, value, met) \
    if (LAYER == number) \
        return met;
    KD_LAYERS(NOT_LIGHT_, MET_, NOT_END_)
    return KD_NOTHING;
}
#endif

float of_crossing(uvec2 place, uint at)
{
    kd_ray ray = kd_camera_ray(place.x, place.y);
    uint before = ORDERS;
#ifdef KD_MARCH
    kd_met met = kd_met_nothing();
    if (KD_MEETS)
        met = kd_meet(place);
    if (KD_MEETS && kd_meet_lost)
        return KD_NOTHING;
    before = min(ORDERS, met.crossed);
#endif
    for (uint n = 0; n < before; n++) {
        float w = lens[at + n * slice.stride];
        if (w <= 0.0)
            break;
        kd_sample s = sample_at(n, w, at, ray);
        bool on = w * emission.frame.inner <= 1.0 && w * emission.frame.outer >= 1.0;
        if ((on || kd_plunge_falls(s)) && (ORDER == KD_NO_ORDER || n == ORDER))
            return value_of(s, quantity(KD_LENS_DELAY, at + n * slice.stride));
    }
#ifdef KD_MARCH
    if (met.body != KD_NOBODY && (ORDER == KD_NO_ORDER || met.crossed == ORDER))
        return value_of_met(met);
#endif
    return KD_NOTHING;
}

#define END_VALUE_(number, name, needs, value) \
    if (LAYER == number) \
        return value;
float of_end(uint at)
{
    float fate = quantity(KD_LENS_FATE, at);
    kd_end end =
        kd_end(quantity(KD_LENS_SKY_U, at), quantity(KD_LENS_SKY_PHI, at), quantity(KD_LENS_SKY_FOOTPRINT, at), 1.0);
    KD_LAYERS(NOT_LIGHT_, NOT_, END_VALUE_)
    return KD_NOTHING;
}

void main()
{
    kd_camera_read();
    KD_EMIT_BLOCKS(READ)
    uint px = gl_GlobalInvocationID.x, py = slice.row0 / SIDE + gl_WorkGroupID.y, listed = 0;
    if (px >= (CRITICAL > 0 ? slice.rows : emission.frame.pixels_x))
        return;
    if (CRITICAL > 0) {
        listed = slice.row0 + px;
        uvec2 pixel = kd_listed_pixel(listed);
        px = pixel.x;
        py = pixel.y;
    }
    uint o = (py - (CRITICAL > 0 ? slice.band0 : slice.band0 / SIDE)) * emission.frame.pixels_x + px;
    float value = 0.0;
    if (OF_LIGHT) {
#ifdef KD_MARCH
        vec4 sum = light_of_pixel(o);
#else
        const uint rays = CRITICAL > 0 ? CRITICAL : SIDE * SIDE;
        vec4 sum = vec4(0.0);
        for (uint i = 0u; i < rays; i++) {
            uvec2 place =
                CRITICAL > 0 ? kd_critical_place(uvec2(px, py), i) : uvec2(px, py) * SIDE + uvec2(i % SIDE, i / SIDE);
            sum +=
                light(place, CRITICAL > 0 ? listed * CRITICAL + i : (place.y - slice.band0) * cam.width + place.x, o);
        }
        sum *= 1.0 / float(rays);
#endif
        value = value_of_light(sum);
    } else {
        /* the ray of the grid that stands for the pixel: the middle ray, or the ray before the middle */
        uvec2 place = uvec2(px, py) * SIDE + (SIDE - 1u) / 2u;
        uint at = (place.y - slice.band0) * cam.width + place.x;
        value = OF_CROSSING ? of_crossing(place, at) : of_end(at);
    }
    uint bits = floatBitsToUint(value);
    layer[o] = !untold && (kd_is_finite(value) || bits == KD_INFINITE_BITS) ? bits : KD_NOTHING_BITS;
}
