/* Bindings shared by kernels that search stars in a lens map: the map, and numbers and tables of the emitters. The
 * bindings are 0, 1 and 2. This file needs the specialisation constants QUANTITIES, ORDERS and RIM. If RIM is 2, the
 * rays are those of the rim (rim.glsl), and the map holds the components x, y and z of directions. */
#ifndef KD_SKY_MAP_GLSL
#define KD_SKY_MAP_GLSL

#include "shared/math.glsl"
#include "shared/emitters.h"
#include "ray/planes.glsl"
layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
#define A(type, name, count) type name[count];
#define BLOCK(number, name) \
    struct kd_##name##_block { KD_BLOCK_##name(F, U, A) };
#define MEMBER(number, name) kd_##name##_block name;
struct kd_spot_block { KD_BLOCK_spot(F, U) };
KD_EMIT_BLOCKS(BLOCK)
struct kd_star_push { KD_STARS_FIELDS_(F, U) };
layout(push_constant) uniform Push { kd_star_push push_; };
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer lens_texels;
float map_at(uint at) { return texelFetch(lens_texels, int(at)).r; }
#else
layout(set = 0, binding = 0) readonly buffer LensMap { float lens[]; };
float map_at(uint at) { return lens[at]; }
#endif
layout(set = 0, binding = 1, std140) uniform Emission { KD_EMIT_BLOCKS(MEMBER) } emission_;
#include "light/tables.glsl"

/* The push constants and numbers are copied before the first branch, because after a branch lavapipe reads them again
 * for each lane and each use. */
kd_star_push push;
struct kd_sky_emission {
    kd_frame_block frame;
    kd_sky_block sky;
} emission;
void kd_sky_map_read()
{
    push = push_;
    emission.frame = emission_.frame;
    emission.sky = emission_.sky;
}

#define KD_EMIT_CODE
#include "emit/colour.glsl"
#include "emit/sky.glsl"

float kd_sky_number(uint quantity, uint at) { return map_at(at + kd_plane(quantity) * push.stride); }
/* Size on the sky, in radians, of the area that a ray stands for. If the map does not store it, it is computed from aa,
 * bb and ab, the products of the map's derivatives along the picture's axes. */
float kd_sky_size(uint at, float aa, float bb, float ab)
{
    float half_ = 0.5 * (aa - bb);
    return (QUANTITIES & KD_LENS_SKY_FOOTPRINT) != 0u ? kd_sky_number(KD_LENS_SKY_FOOTPRINT, at)
                                                      : sqrt(0.5 * (aa + bb) + sqrt(half_ * half_ + ab * ab));
}
bool kd_sky_escapes(uint at) { return RIM == 2u || kd_sky_number(KD_LENS_FATE, at) == KD_FATE_ESCAPED; }

/* Direction from which a ray comes, in the hole's frame. */
vec3 kd_sky_from(uint at)
{
    if (RIM == 2u)
        return vec3(map_at(at), map_at(at + push.stride), map_at(at + 2u * push.stride));
    float u = kd_sky_number(KD_LENS_SKY_U, at), s = sqrt(max(1.0 - u * u, 0.0));
    kd_phasor phi = kd_cos_sin(kd_sky_number(KD_LENS_SKY_PHI, at));
    return vec3(s * phi.c, s * phi.s, u);
}

#endif
