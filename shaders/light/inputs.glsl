/* Inputs of the kernels that make light from a lens map: the map, numbers and tables of the emitters, the camera, and
 * the emitters' buffers. The map has binding 0, numbers 1, tables 2, and the camera 4. Buffers have the bindings from
 * KD_OWN_BINDING on. Binding 3 is the kernel's output. This file needs the specialisation constants of
 * KD_SPEC_TRANSFER. */
#ifndef KD_INPUTS_GLSL
#define KD_INPUTS_GLSL

#include "shared/math.glsl"
#include "ray/kerr_ray.glsl"
#include "ray/planes.glsl"
#include "shared/emitters.h"
layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
#define A(type, name, count) type name[count];
#define BLOCK(number, name) \
    struct kd_##name##_block { KD_BLOCK_##name(F, U, A) };
#define MEMBER(number, name) kd_##name##_block name;
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer lens_texels;
#define KD_MAP_AT(at) texelFetch(lens_texels, int(at)).r
#else
layout(set = 0, binding = 0) readonly buffer LensMap { float lens[]; };
#endif
struct kd_spot_block { KD_BLOCK_spot(F, U) };
KD_EMIT_BLOCKS(BLOCK)
layout(set = 0, binding = 1, std140) uniform Emission { KD_EMIT_BLOCKS(MEMBER) } emission_;
/* The numbers of all emitters, uniform over all invocations. They are copied before the first branch, because lavapipe
 * reads a uniform block again for each lane and each use after a branch. */
struct kd_emission { KD_EMIT_BLOCKS(MEMBER) } emission;
#define READ(number, name) emission.name = emission_.name;
#include "light/tables.glsl"
/* The emitters' buffers are texel buffers if the lens map is one. lavapipe reads storage buffers lane by lane, at ten
 * times the cost. */
#define KD_OWN_stored(number, member) \
    layout(set = 0, binding = KD_OWN_BINDING + number) readonly buffer Own_##member { float member[]; };
#define KD_OWN_quads(number, member) \
    layout(set = 0, binding = KD_OWN_BINDING + number) readonly buffer Own_##member { uvec4 member[]; };
#define KD_OWN_quad_texels(number, member) \
    layout(set = 0, binding = KD_OWN_BINDING + number) uniform utextureBuffer member;
#ifdef KD_TEXELS
#define KD_OWN_words(number, member) layout(set = 0, binding = KD_OWN_BINDING + number) uniform utextureBuffer member;
#define KD_OWN_pairs(number, member) KD_OWN_words(number, member)
#define KD_OWN_floats(number, member) layout(set = 0, binding = KD_OWN_BINDING + number) uniform textureBuffer member;
#define KD_OWN_WORD(member, at) texelFetch(member, int(at)).r
#define KD_OWN_PAIR(member, at) texelFetch(member, int(at)).rg
#define KD_OWN_FLOAT(member, at) texelFetch(member, int(at)).r
#else
#define KD_OWN_words(number, member) \
    layout(set = 0, binding = KD_OWN_BINDING + number) readonly buffer Own_##member { uint member[]; };
#define KD_OWN_pairs(number, member) \
    layout(set = 0, binding = KD_OWN_BINDING + number) readonly buffer Own_##member { uvec2 member[]; };
#define KD_OWN_floats(number, member) KD_OWN_stored(number, member)
#define KD_OWN_WORD(member, at) member[at]
#define KD_OWN_PAIR(member, at) member[at]
#define KD_OWN_FLOAT(member, at) member[at]
#endif
#define KD_B(number, type, member) KD_OWN_##type(number, member)
KD_EMIT_BUFFERS
#define KD_CAMERA_BINDING 4
#include "ray/camera.glsl"
#include "ray/metric.glsl"
#include "ray/place.glsl"
#include "light/compose.glsl"

const bool SLOW = (QUANTITIES & KD_LENS_DELAY) != 0u;

float quantity(uint which, uint at)
{
    return (QUANTITIES & which) != 0u ? KD_MAP_AT(at + kd_plane(which) * slice.stride) : 0.0;
}

/* Carter's constant Q from the slope of w, by w'^2 = R(w) of kerr_ray.glsl, for a ray that is not on the camera's grid.
 */
float kd_carter_of_slope(float energy, float momentum, float w, float slope)
{
    float w2 = w * w, ae = cam.spin * energy, j = momentum - ae;
    float rest = energy * energy + (ae * ae - momentum * momentum) * w2 + j * j * w2 * kd_mass_term(w) - slope * slope;
    return rest / (w2 * kd_delta(w, cam.root));
}

#endif
