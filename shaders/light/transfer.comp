/* Light: from the lens map to linear sRGB radiance. An invocation lights a pixel. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_TRANSFER(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/math.glsl"
#include "ray/kerr_ray.glsl"
#include "ray/planes.glsl"
#include "shared/emitters.h"
layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
#define A(type, name, count) type name[count];
#define BLOCK(number, name) struct kd_##name##_block { KD_BLOCK_##name(F, U, A) };
#define MEMBER(number, name) kd_##name##_block name;
struct kd_camera { KD_CAMERA_FIELDS_(F, U) };
layout(push_constant) uniform Camera { kd_camera camera_; };
layout(set = 0, binding = 0) readonly buffer LensMap { float lens[]; };
struct kd_spot_block { KD_BLOCK_spot(F, U) };
KD_EMIT_BLOCKS(BLOCK)
layout(set = 0, binding = 1, std140) uniform Emission { KD_EMIT_BLOCKS(MEMBER) } emission_;
/* What is the same for all invocations, read before the first branch: behind one lavapipe reads it anew for each lane and each use. */
kd_camera cam;
struct kd_emission { KD_EMIT_BLOCKS(MEMBER) } emission;
#define READ(number, name) emission.name = emission_.name;
layout(set = 0, binding = 2) uniform textureBuffer tables;
#define TABLE(name, first, rows) const uint KD_TABLE_##name = first;
KD_EMIT_TABLES(TABLE)
vec4 kd_table_row(uint table, uint row) { return texelFetch(tables, int(table + row)); }
layout(set = 0, binding = 3) writeonly buffer Radiance { float radiance[]; };
layout(set = 0, binding = 4) readonly buffer Density { float density[]; };
#include "ray/camera.glsl"
#include "ray/place.glsl"
#include "light/compose.glsl"

const bool SLOW = (QUANTITIES & KD_LENS_DELAY) != 0u;

float quantity(uint which, uint at) { return (QUANTITIES & which) != 0u ? lens[at + kd_plane(which) * cam.stride] : 0.0; }

/* Q by w'^2 = R(w) of kerr_ray.glsl, of a ray whose place in the picture does not tell it. */
float kd_carter_of_slope(float energy, float momentum, float w, float slope)
{
    float w2 = w * w, ae = cam.spin * energy, j = momentum - ae;
    float rest = energy * energy + (ae * ae - momentum * momentum) * w2 + 2.0 * j * j * w2 * w - slope * slope;
    return rest / (w2 * kd_delta(w, cam.root));
}

/* The ray at this place of the camera, and in the lens map. */
kd_beam follow(uvec2 place, uint at)
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    kd_ray ray = kd_camera_ray(place.x, place.y);
    float momentum = ((QUANTITIES & KD_LENS_ALPHA) != 0u ? -quantity(KD_LENS_ALPHA, at) : ray.l) * cam.s;
    float carter = ray.p * ray.p + cam.u * cam.u * (ray.l * ray.l - cam.spin * cam.spin * ray.e * ray.e);
    for (uint n = 0; KD_GLOWS && n < ORDERS; n++) {
        uint plane = at + n * cam.stride;
        float w = lens[plane];
        if (w < 0.0)
            kd_beam_given_up(beam);
        if (w <= 0.0)
            break;
        float ago = SLOW ? quantity(KD_LENS_DELAY, plane) - emission.frame.delay : 0.0;
        float slope = quantity(KD_LENS_SLOPE, plane), footprint = quantity(KD_LENS_FOOTPRINT, plane);
        float q = (QUANTITIES & KD_LENS_ALPHA) != 0u ? kd_carter_of_slope(ray.e, momentum, w, slope) : carter;
        kd_beam_at(beam, kd_sample(w, quantity(KD_LENS_PHI, plane), ago, slope, ray.e, momentum, q, footprint, n));
        if (beam.through <= 0.0)
            break;
    }
    if ((QUANTITIES & KD_LENS_FATE) != 0u) {
        float fate = quantity(KD_LENS_FATE, at);
        if (fate == KD_FATE_UNDECIDED)
            kd_beam_given_up(beam);
        if (fate == KD_FATE_ESCAPED)
            kd_beam_end(beam, kd_end(quantity(KD_LENS_SKY_U, at), quantity(KD_LENS_SKY_PHI, at), quantity(KD_LENS_SKY_FOOTPRINT, at)));
    }
    return beam;
}

void main()
{
    cam = camera_;
    KD_EMIT_BLOCKS(READ)
    uint px = gl_GlobalInvocationID.x, py = cam.row0 / SIDE + gl_WorkGroupID.y, listed = 0;
    if (px >= (CRITICAL > 0 ? cam.rows : emission.frame.pixels_x))
        return;
    if (CRITICAL > 0) {
        listed = cam.row0 + px;
        uvec2 pixel = kd_listed_pixel(listed);
        px = pixel.x;
        py = pixel.y;
    }
    vec3 sum = vec3(0.0);
    float apart = 0.0;
    const uint rays = CRITICAL > 0 ? CRITICAL : SIDE * SIDE;
    for (uint i = 0; i < rays; i++) {
        uvec2 place = CRITICAL > 0 ? kd_critical_place(uvec2(px, py), i) : uvec2(px, py) * SIDE + uvec2(i % SIDE, i / SIDE);
        kd_beam beam = follow(place, CRITICAL > 0 ? listed * CRITICAL + i : (place.y - cam.band0) * cam.width + place.x);
        sum += beam.light;
        apart += beam.apart;
    }
    float share = 1.0 / float(rays);
    uint o = (py - (CRITICAL > 0 ? cam.band0 : cam.band0 / SIDE)) * emission.frame.pixels_x + px;
    radiance[3 * o] = share * sum.r;
    radiance[3 * o + 1] = share * sum.g;
    radiance[3 * o + 2] = share * sum.b;
    if (KD_APART) /* behind the band's pixels */
        radiance[3 * emission.frame.band_pixels + o] = share * apart;
}
