/* This keeps the rays that a kernel leaves open, for the host to follow them again (src/render/frame/settle.c).
 * Binding 1. */
#ifndef KD_OPEN_GLSL
#define KD_OPEN_GLSL

layout(set = 0, binding = 1) buffer Given { uint undecided, given[]; };

/* at: of the ray in a plane of the lens map. A loop, for lavapipe skips work only by leaving one, and counts for
 * each lane by itself. */
void kd_leave_open(bool open, uint at)
{
    for (; open; open = false) {
        uint n = atomicAdd(undecided, 1u);
        if (n < KD_GIVEN_MOST)
            given[n] = at;
    }
}

/* Of the scale of w: what rounding may do to a ray's crossings. It grows as the ray comes closer to the critical
 * curve, where R at the barrier vanishes. */
float kd_open_within(kd_barrier b, float epsilon)
{
    return min(epsilon * (32.0 + b.noise / max(abs(b.r), 1e-30)), 0.05);
}

/* Says whether rounding may have made, or missed, a crossing of the plane that a ray finds at w: next to infinity or
 * to the horizon. `far`: the scale of w far out, the sine of the angle to the hole; off: as above. */
bool kd_crossing_is_open(float w, float far, float horizon, float off)
{
    return min(abs(w) - off * min(far, horizon), abs(w - horizon) - off * horizon) < 0.0;
}

#endif
