/* Determines which ray an invocation processes. Needs camera.glsl, the lens map as `lens`, and the specialisation
 * constants CRITICAL, GENERATOR and SHIFT. Kernels that trace define KD_BY_PLACE_BINDING, the binding of the list of
 * places.
 *
 * If CRITICAL is KD_RAYS_BY_PLACE, invocations process the rays of a stage in a list of places (ray/places.glsl). These
 * are single rays of the grid, or nodes. Nodes have a map of their own, in which their states follow the planes.
 *
 * If CRITICAL is 0, they process rays of the picture's grid. A row of workgroups is a row of rays.
 *
 * Otherwise CRITICAL is the number of rays on each listed pixel. They are on a lattice or, if GENERATOR is 0, on a
 * square grid (src/render/view/critical_pixels.h). The list of pixels, x and y of each, follows the planes in the lens
 * map. */
#ifndef KD_PLACE_GLSL
#define KD_PLACE_GLSL

#ifndef KD_MAP_AT
#define KD_MAP_AT(at) lens[at]
#endif

#ifdef KD_BY_PLACE_BINDING
layout(set = 0, binding = KD_BY_PLACE_BINDING) readonly buffer Places { uint words[]; };
#include "ray/places.glsl"
const bool BY_PLACE = CRITICAL == KD_RAYS_BY_PLACE;
#endif

/* The pixel with the number `pixel` in the list. */
uvec2 kd_listed_pixel(uint pixel)
{
    uint at = slice.list + 2 * pixel;
    return uvec2(KD_MAP_AT(at), KD_MAP_AT(at + 1));
}

/* Place of a ray of a listed pixel, in steps of the camera. A side of a pixel has CRITICAL steps on a lattice, and
 * SHIFT steps on a square grid. */
uvec2 kd_critical_place(uvec2 pixel, uint ray)
{
    if (GENERATOR == 0)
        return pixel * SHIFT + uvec2(ray % max(SHIFT, 1), ray / max(SHIFT, 1));
    return pixel * CRITICAL + uvec2(ray, (ray * GENERATOR + SHIFT) % max(CRITICAL, 1));
}

/* Finds the ray of this invocation of a tracing kernel; false if there is none. at: the ray's index in a plane of the
 * lens map. */
bool kd_this_ray(out uvec2 ray, out uint at)
{
    uint x = gl_GlobalInvocationID.x;
#ifdef KD_BY_PLACE_BINDING
    if (BY_PLACE) {
        bool alone = slice.stage == KD_STAGE_ALONE;
        uint number = x + (alone ? 0u : kd_stage_first(slice.stage)), word = slice.places + number;
        if (x >= kd_stage_count(slice.stage))
            return false;
        /* the sum may wrap round, because the place may be negative */
        ray = kd_place_at(words[word]) + uvec2(slice.origin_x, slice.origin_y);
        at = alone ? (ray.y - slice.band0) * cam.width + ray.x : number;
        return true;
    }
#endif
    if (CRITICAL > 0) {
        at = slice.row0 * CRITICAL + x;
        if (x >= slice.rows * CRITICAL)
            return false;
        ray = kd_critical_place(kd_listed_pixel(at / CRITICAL), at % CRITICAL);
        return true;
    }
    uint row = slice.row0 + gl_WorkGroupID.y;
    ray = uvec2(x, row);
    at = (row - slice.band0) * cam.width + x;
    return x < cam.width;
}

#endif
