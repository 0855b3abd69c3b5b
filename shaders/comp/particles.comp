/* Kernel: computes the positions of the disk's particles at one time. Each position follows from the particle's number
 * in closed form. The kernel adds the particles to the grid or writes them to a list (src/render/emit/particles.h).
 *
 * Phases are 32-bit fractions of a turn, so that sums wrap exactly. A particle's weight is divided among the four nodes
 * around it. A word of the grid has 16 bits for its own node and 16 bits for the node to the right; particles between
 * the two nodes contribute to both. Two additions therefore suffice for a particle. Falling particles are on a grid of
 * phase and azimuth at the ISCO (src/render/emit/plunging.h). */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_PARTICLES(KD_SPEC_U_, KD_SPEC_B_)
#include "shared/math.glsl"
#include "shared/hash.glsl"

layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
struct kd_guide { KD_GUIDE_FIELDS_(F, U) };
layout(push_constant) uniform Push { KD_PARTICLES_FIELDS_(F, U) } push;
layout(set = 0, binding = 0) readonly buffer Guides { kd_guide guides[]; };
layout(set = 0, binding = 1) buffer Grid { uint grid[]; };

/* Cosine and sine of a particle's phase, times its random amplitude in [0, 1]. Over all particles, the points
 * (amplitude, phase) are uniform in the unit disc. */
kd_phasor swing(uint random, uint phase)
{
    kd_phasor t = kd_cos_sin(float(int(random + phase)) * (KD_PI / 2147483648.0));
    float u = sqrt(float(kd_hash(random ^ push.key) >> 8) * (1.0 / 16777216.0));
    t.c *= u;
    t.s *= u;
    return t;
}

/* Adds a particle to the grid that starts at word `first`. */
void share_out(float row, uint phi, uint first, uint rows, uint columns_log2)
{
    if (row < 0.0 || row > float(rows)) /* skips a particle that is at present beyond the edge of the grid */
        return;
    uint i = min(uint(row), rows - 1), j = phi >> (32 - columns_log2);
    uint upper = uint((row - float(i)) * float(push.unit) + 0.5), lower = push.unit - upper;
    float right = float((phi << columns_log2) >> 8) * (1.0 / 16777216.0);
    uint lower_right = uint(float(lower) * right + 0.5), upper_right = uint(float(upper) * right + 0.5);
    uint at = first + (i << columns_log2) + j;
    atomicAdd(grid[at], (lower - lower_right) | lower_right << 16);
    atomicAdd(grid[at + (1 << columns_log2)], (upper - upper_right) | upper_right << 16);
}

/* Random number of a plunging particle on a lap. A particle that reaches the end of the plunge starts again on the next
 * lap, at another azimuth. The grid extends beyond both ends of the curve, where it holds particles of the previous and
 * next laps. */
uint launch(uint random, uint lap) { return kd_hash(random + kd_hash(lap)) + push.turn; }

void plunge(uint random, uint n)
{
    uint own = kd_hash(random + 0x9e3779b9u), phase = own + push.phase, lap = push.lap + (phase < own ? 1 : 0);
    if (LIST) {
        grid[3 * n] = phase;
        grid[3 * n + 1] = launch(random, lap);
        grid[3 * n + 2] = 0;
        return;
    }
    uint back = (push.lead_rows + push.lap_rows - 1) / push.lap_rows;
    float row = float(push.lead_rows) + (float(phase >> 8) * (1.0 / 16777216.0) - float(back)) * float(push.lap_rows);
    for (lap += back; row <= float(push.plunge_rows); row += float(push.lap_rows), lap--)
        share_out(row, launch(random, lap), push.plunge_at, push.plunge_rows, push.plunge_columns_log2);
}

void main()
{
    uint n = gl_GlobalInvocationID.x;
    if (n >= push.count)
        return;
    uint i = push.first + n * push.stride, k, low, random = kd_hash(i ^ push.key);
    if (PLUNGE && (!LIST || i < push.plunging)) {
        plunge(random, n);
        return;
    }
    /* Each invocation processes the same number of particles. Particles are in order of radius, so that neighbouring
     * invocations access the same part of the grid. */
    umulExtended(2 * (i - push.plunging) + 1, push.per_particle, k, low);
    uint phi = random + guides[k].phi;
    float row = guides[k].row;
    if (SWING) {
        kd_phasor t = swing(kd_hash(random + 0x9e3779b9u), guides[k].radial);
        row += guides[k].swing_row * t.c;
        phi += uint(int(guides[k].swing_phi * t.s * 4294967296.0));
    }
    if (LIST) {
        grid[3 * n] = floatBitsToUint(row);
        grid[3 * n + 1] = phi;
        grid[3 * n + 2] =
            SWING ? floatBitsToUint(push.tilt * swing(kd_hash(random + 0x3c6ef372u), guides[k].vertical).c) : 0;
    } else {
        share_out(row, phi, 0, push.rows, push.columns_log2);
    }
}
