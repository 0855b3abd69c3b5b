/* The list of open rays, which the kernel could not decide and the host traces again (src/render/frame/settle.c).
 * Binding 1. */
#ifndef KD_OPEN_GLSL
#define KD_OPEN_GLSL

layout(set = 0, binding = 1) buffer Given { uint undecided, given[]; };

/* Adds a ray to the list if it is open. at: index of the ray in a plane of the lens map. */
void kd_leave_open(bool open, uint at)
{
    if (open) {
        uint n = atomicAdd(undecided, 1u);
        if (n < uint(given.length()))
            given[n] = at;
    }
}

/* Margins of a crossing: distances of w from infinity and from the horizon. Beyond these distances rounding can neither
 * create nor remove the crossing. */
struct kd_margins { float far, horizon, edge; };

/* Margins of the crossings of a ray. far, horizon: the scales on which w varies far out and at the horizon. noise:
 * rounding error of R at the turning point. The margin grows as the ray comes closer to the critical curve, where R
 * vanishes at the turning point. */
kd_margins kd_margins_of(kd_turning_point b, float noise, float far, float horizon)
{
    float part = 32.0 * KD_ROUNDOFF + noise / max(abs(b.r), 1e-30);
    return kd_margins(part * far, part * horizon, horizon);
}

/* True if a crossing at w is within the margins, so that rounding may decide it. Also true for NaN. */
bool kd_crossing_is_open(float w, kd_margins off) { return !(abs(w) >= off.far && abs(w - off.edge) >= off.horizon); }

#endif
