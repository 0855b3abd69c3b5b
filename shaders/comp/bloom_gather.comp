/* Kernel: spreads the light of blocks of pixels as a quadratic B-spline on the finest grid. A block contributes to its
 * own cell and to the eight cells round it, weighted by the position of the block's centre in its cell. The spread
 * light therefore moves with the block, and has the same width everywhere. Contributions beyond the edge of the picture
 * are mirrored inside; in a picture of all directions they go to the opposite edge. An invocation makes two cells along
 * each side, which share what they read. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/interface.h"
#include "shared/spec.h"
#include "shared/bloom.glsl"
KD_SPEC_BLOOM_GATHER(KD_SPEC_U_, KD_SPEC_B_)

layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Push { KD_BLOOM_GATHER_FIELDS_(F, U) } push;
#ifdef KD_TEXELS
layout(set = 0, binding = 0) uniform textureBuffer blocks;
vec3 light(int at) { return texelFetch(blocks, at).rgb; }
#else
layout(set = 0, binding = 0) readonly buffer Blocks { vec4 blocks[]; };
vec3 light(int at) { return blocks[at].rgb; }
#endif
layout(set = 0, binding = 1) writeonly buffer Cells { vec4 cells[]; };

/* Numbers along one axis: of the picture's pixels, of the pixels in a block, of the picture's blocks, and of the grid's
 * cells. */
struct kd_bloom_axis { uint pixels, block, blocks, cells; };
/* Index of a block, and the block's weights for two adjacent cells along an axis. */
struct kd_tap {
    int at;
    float a, b;
};

/* Index of the first block that contributes to cell i or to the next cell. Such a block has its centre at most 1.5
 * cells from the centre of one of the two cells. The contributing blocks are adjacent. */
int first_tap(kd_bloom_axis axis, int i, bool around)
{
    float step_ = float(axis.cells * axis.block) / float(axis.pixels);
    return int(ceil((float(i) - 1) / step_ - 0.5)) -
           (around && RAGGED ? 1 : 0); /* beyond the left edge, the next block is the narrow block at the right edge */
}

/* The tap (index and weights) for block `within`. at: distance of the block's centre from the centre of cell i, in
 * cells. */
kd_tap tap_of(kd_bloom_axis axis, int within, float at)
{
    float scale = float(axis.cells) / float(axis.pixels);
    return kd_tap(clamp(within, 0, int(axis.blocks) - 1), scale * bloom_weight(at), scale * bloom_weight(at - 1));
}

/* The tap for block k. An index beyond an edge stands for the mirror image of a block. The last block may be narrower
 * than the others. Its centre is then before the centre of a full block, and the mirror images are moved accordingly.
 */
kd_tap tap(kd_bloom_axis axis, int i, int k)
{
    int count = int(axis.blocks), behind = k - count, within = k < 0 ? -1 - k : behind < 0 ? k : count - 1 - behind;
    float scale = float(axis.cells) / float(axis.pixels),
          at = (float(k) + 0.5) * (scale * float(axis.block)) - (float(i) + 0.5);
    if (RAGGED) {
        float narrow = 0.5 * scale * float(axis.blocks * axis.block - axis.pixels);
        at -= behind < -1 ? 0.0 : behind == -1 ? narrow : behind == 0 ? 3 * narrow : 4 * narrow;
    }
    return tap_of(axis, within, at);
}

/* The tap for block k in a picture of all directions. A block beyond an edge is the block at the opposite edge. */
kd_tap tap_around(kd_bloom_axis axis, int i, int k)
{
    int count = int(axis.blocks), within = bloom_column(k, count, true),
        turns = k < 0 ? (k + 1) / count - 1 : k / count;
    float scale = float(axis.cells) / float(axis.pixels),
          narrow = within == count - 1 ? 0.5 * float(axis.blocks * axis.block - axis.pixels) : 0.0;
    float middle = (float(within) + 0.5) * float(axis.block) - narrow + float(turns * int(axis.pixels));
    return tap_of(axis, within, scale * middle - (float(i) + 0.5));
}

void main()
{
    kd_bloom_axis across = kd_bloom_axis(push.pixels_x, push.block_x, push.blocks_x, push.cells_x);
    kd_bloom_axis along = kd_bloom_axis(push.pixels_y, push.block_y, push.blocks_y, push.cells_y);
    uvec2 place = bloom_place(gl_GlobalInvocationID.x, (push.cells_x + 1) / 2);
    int x = 2 * int(place.x), y = 2 * int(place.y);
    if (y >= int(push.cells_y))
        return;
    int first_x = first_tap(across, x, AROUND), first_y = first_tap(along, y, false);
    kd_tap taps[KD_BLOOM_TAPS];
    for (int i = 0; i < int(TAPS_X); i++)
        if (AROUND)
            taps[i] = tap_around(across, x, first_x + i);
        else
            taps[i] = tap(across, x, first_x + i);
    vec3 upper_left = vec3(0), upper_right = vec3(0), lower_left = vec3(0), lower_right = vec3(0);
    for (int j = 0; j < int(TAPS_Y); j++) {
        kd_tap row = tap(along, y, first_y + j);
        int at = row.at * int(push.blocks_x);
        vec3 left = vec3(0), right = vec3(0);
        for (int i = 0; i < int(TAPS_X); i++) {
            vec3 c = light(at + taps[i].at);
            left += taps[i].a * c;
            right += taps[i].b * c;
        }
        upper_left += row.a * left;
        upper_right += row.a * right;
        lower_left += row.b * left;
        lower_right += row.b * right;
    }
    int n = y * int(push.cells_x) + x;
    bool more = x + 1 < int(push.cells_x), below = y + 1 < int(push.cells_y);
    cells[n] = vec4(upper_left, 0);
    if (more)
        cells[n + 1] = vec4(upper_right, 0);
    if (below)
        cells[n + int(push.cells_x)] = vec4(lower_left, 0);
    if (more && below)
        cells[n + int(push.cells_x) + 1] = vec4(lower_right, 0);
}
