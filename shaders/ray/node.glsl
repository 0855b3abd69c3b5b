/* Stores a traced ray in the form that the next pass reads: a node of a sampled map (ray/cells.glsl), or a ray of the
 * map. Needs ray/place.glsl and ray/open.glsl. */
#ifndef KD_NODE_GLSL
#define KD_NODE_GLSL

#include "ray/hole.glsl"

/* Converts a ray to a node, which holds only quantities that are smooth from ray to ray. The azimuths of a captured ray
 * lose the logarithm that diverges at the horizon. A unit vector replaces the angles in the sky and the fate: x, y and
 * z in the planes of SKY_PHI, FATE and SKY_U. */
void kd_finish_node(uint at, uint crossings, bool captured, float curve)
{
    lens[slice.list + at] = float(crossings) + (captured ? KD_NODE_CAPTURED : 0.0);
    lens[slice.list + slice.stride + at] = curve;
    if (PHI && captured)
        for (uint n = 0u; n < ORDERS; n++)
            lens[at + (kd_plane(KD_LENS_PHI) + n) * slice.stride] +=
                cam.spin * kd_fall(lens[at + n * slice.stride], cam.root);
    if (SKY) {
        float u = lens[at + kd_plane(KD_LENS_SKY_U) * slice.stride], s = sqrt(max(1.0 - u * u, 0.0));
        kd_phasor phi = kd_cos_sin(lens[at + kd_plane(KD_LENS_SKY_PHI) * slice.stride]);
        lens[at + kd_plane(KD_LENS_SKY_PHI) * slice.stride] = s * phi.c;
        lens[at + kd_plane(KD_LENS_FATE) * slice.stride] = s * phi.s;
    }
}

/* Completes a ray or a node. An open ray is listed for the host. An open node is not listed: its state says that it is
 * open, and the rays of its cells are traced singly. curve: value at this ray of a smooth function that vanishes where
 * fates change. */
void kd_finish_ray(bool open, uint at, uint crossings, bool captured, float curve)
{
    const bool node = BY_PLACE && slice.stage != KD_STAGE_ALONE;
    if (node)
        kd_finish_node(at, crossings, captured, curve);
    if (node && open)
        lens[slice.list + at] = KD_NODE_OPEN;
    if (!node)
        kd_leave_open(open, at);
}

#endif
