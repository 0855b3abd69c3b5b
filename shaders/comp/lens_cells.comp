/* Kernel: decides where a lens map is traced ray by ray and where it is interpolated. An invocation processes a cell
 * (ray/cells.glsl) of one level. All nodes of the cell are traced. If the polynomials through the nodes predict two
 * further rays, the cell is smooth. Otherwise its four quarters become cells of the next level, and their nodes are
 * listed. The rays of a cell of the last level are traced singly.
 *
 * The map is analytic in a cell except where orders or fates change. Such changes show in two ways: the nodes have
 * different states, or R at the turning point nearly vanishes, because R is 0 where fates change. The decision depends
 * on the cell's own rays only. So a tile of a picture is divided in the same way as the whole picture.
 *
 * The tolerance is relative, for w, angles and directions alike. Where the map is steep, the rounding of the camera's
 * directions to 32 bits moves the map by more than the tolerance. A test against the tolerance would only measure this
 * noise. So where the map is steep, the tolerance is larger. Its factor is CONDITION times the change of ln w, or of
 * the angle, between a direction and one twice as far from the hole. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_SAMPLE(KD_SPEC_U_, KD_SPEC_B_)
layout(local_size_x = KD_GROUP_SIZE) in;

layout(set = 0, binding = 0) buffer Sample { uint words[]; };
layout(set = 0, binding = 1) buffer Index { uint number[]; };
layout(set = 0, binding = 2) readonly buffer Nodes { float nodes[]; };
#define NODE_AT(i) nodes[i]
#define KD_SAMPLE_CAMERA_BINDING 3
#include "ray/cells.glsl"
#include "ray/places.glsl"

const float CONDITION = 0.3;

/* queue_of: offset of a level's list of cells, which is four times as long as the list of the level before. places_of:
 * offset of the list of places. */
uint queue_of(uint level) { return KD_SAMPLE_QUEUES + blocks() * (((1u << (2u * (level - 1u))) - 1u) / 3u); }
uint places_of_nodes() { return units_of(2u); }
uint places_alone() { return places_of_nodes() + push.room; }

/* Reserves n entries in a list and returns the index of the first one. counts: offset of the list's counts. each:
 * number of entries that a workgroup processes. */
uint take(uint counts, uint n, uint each)
{
    uint first = atomicAdd(words[counts + 3u], n);
    atomicMax(words[counts], (first + n + each - 1u) / each);
    return first;
}

/* True if a cell overlaps the requested rows of the picture. */
bool is_wanted(uvec2 corner, uint side)
{
    ivec2 low = place_of(corner), high = low + ivec2(int(side));
    int row0 = int(push.row0);
    return low.x < int(push.width) && high.x > 0 && low.y < row0 + int(push.rows) && high.y > row0;
}

void list_cell(uint level, uvec2 cell)
{
    if (is_wanted(cell * side_of(level), side_of(level)))
        words[queue_of(level) + take(KD_SAMPLE_CELLS + 4u * (level - 1u), 1u, KD_GROUP_SIZE)] = cell.x | (cell.y << 16);
}

/* Ray i of the two rays that check a cell. They lie next to the middles of two sides, where polynomials have the
 * largest errors. Except on the last level, both are at even places. */
uvec2 check_of(uvec2 corner, uint side, uint i)
{
    return corner + (i == 0u ? uvec2(side / 8u, side / 2u) : uvec2(side / 2u, side / 8u));
}

/* Places of the nodes that are new when a cell is divided, among the 9 x 9 places of its four quarters. edge_of_nine:
 * 16 places on the edge, which adjacent cells may list as well. within_nine: 38 places inside, which only this cell
 * lists; two of them are the rays that checked the cell. */
uvec2 edge_of_nine(uint k)
{
    uint along = 2u * (k % 4u) + 1u, far = 8u * (k / 4u & 1u);
    return k < 8u ? uvec2(along, far) : uvec2(far, along);
}
uvec2 within_nine(uint k)
{
    if (k < 6u)
        return uvec2(k < 3u ? k + 1u : k + 2u, 1u);
    if (k < 27u)
        return uvec2((k - 6u) % 7u + 1u, 3u + 2u * ((k - 6u) / 7u));
    uint i = k < 31u ? k - 27u : k < 34u ? k - 30u : k - 34u;
    return uvec2(2u * i + 1u, k < 31u ? 2u : k < 34u ? 4u : 6u);
}
/* Places of the nodes of a new block, among 5 x 5 places. edge_of_five: 16 on the edge. within_five: 9 inside. */
uvec2 edge_of_five(uint k)
{
    uint i = k % 4u, side = k / 4u;
    return side == 0u ? uvec2(i, 0u) : side == 1u ? uvec2(4u, i) : side == 2u ? uvec2(4u - i, 4u) : uvec2(0u, 4u - i);
}
uvec2 within_five(uint k) { return uvec2(k % 3u + 1u, k / 3u + 1u); }

/* Makes the ray at place `at` a node. word: offset of the index entry for that place. */
void make_node(uint node, uint word, uvec2 at)
{
    number[word] = node + 1u;
    words[places_of_nodes() + node] = kd_place_word(at);
}

/* Lists the missing nodes of a block, or of the four quarters of a divided cell. Also lists the two rays that check the
 * block, or each quarter. stage: the stage at which all these rays are traced. */
void list_nodes(uint stage, uvec2 corner, uint side, bool divided)
{
    const uint step_ = divided ? side / 8u : side / 4u, within = divided ? 38u : 9u,
               checked = divided ? side / 2u : side, cells = side / checked;
    uint mine = 0u;
    uint k = 0u;
    [[dont_unroll]] do {
        uvec2 at = corner + (divided ? edge_of_nine(k) : edge_of_five(k)) * step_;
        mine |= atomicCompSwap(number[index_of(at / 2u)], 0u, 0xffffffffu) == 0u ? 1u << k : 0u;
    } while (++k < 16u);
    uint node =
        kd_stage_first(stage) + take(4u * stage, uint(bitCount(mine)) + within + 2u * cells * cells, KD_GROUP_SIZE);
    k = 0u;
    [[dont_unroll]] do {
        uvec2 at = corner + (divided ? edge_of_nine(k) : edge_of_five(k)) * step_;
        if ((mine & (1u << k)) != 0u)
            make_node(node++, index_of(at / 2u), at);
    } while (++k < 16u);
    k = 0u;
    [[dont_unroll]] do {
        uvec2 at = corner + (divided ? within_nine(k) : within_five(k)) * step_;
        make_node(node++, index_of(at / 2u), at);
    } while (++k < within);
    k = 0u;
    [[dont_unroll]] do {
        uvec2 cell = corner + uvec2((k / 2u) % cells, k / 2u / cells) * checked, at = check_of(cell, checked, k % 2u);
        make_node(node++, checked == 8u ? index_checks() + 2u * index_of_last(cell / 8u) + k % 2u : index_of(at / 2u),
                  at);
    } while (++k < 2u * cells * cells);
}

/* The node i along the cell's middle row or middle column, for comparison with the checking rays. i = 5 is the checking
 * ray of that line, which is next to the line's first node. */
uint node_along(uvec2 corner, uint side, uint axis, uint i)
{
    uint word = i < 5u       ? index_of_node(corner, side, axis == 0u ? i : 2u, axis == 0u ? 2u : i)
                : side == 8u ? index_checks() + 2u * index_of_last(corner / 8u) + axis
                             : index_of(check_of(corner, side, axis) / 2u);
    return number[word] - 1u;
}

/* Results for one quantity, from both lines of nodes. off: for each component, the larger error of the polynomials at
 * the two checking rays. apart: the larger error of the whole vector. slope2: sum of the squared slopes in the middle.
 * bend: largest second difference between quarters of the side. */
struct kd_line_told {
    vec3 off, slope2, bend;
    float apart;
};
const kd_line_told KD_NOTHING_TOLD = kd_line_told(vec3(0.0), vec3(0.0), vec3(0.0), 0.0);

/* Replaces NaN and infinity by a value that exceeds every tolerance. */
float or_far(float x) { return kd_is_finite(x) ? x : 1e18; }

void tell(inout kd_line_told t, vec3 v[6])
{
    vec3 a = v[0] - v[2], b = v[1] - v[2], d = v[3] - v[2], e = v[4] - v[2];
    vec3 off = abs(v[5] - v[2] - (35.0 * a + 140.0 * b + 28.0 * d - 5.0 * e) / 128.0), slope = 0.5 * (d - b);
    off = vec3(or_far(off.x), or_far(off.y), or_far(off.z));
    t.off = max(t.off, off);
    t.apart = max(t.apart, length(off));
    t.slope2 += slope * slope;
    t.bend = max(t.bend, max(max(abs(a - 2.0 * b), abs(b + d)), abs(e - 2.0 * d)));
}

/* Evaluates both lines of nodes for a quantity. VALUE: expression of that quantity for `node`. All nodes share one
 * piece of code, so that a driver compiles it once. */
#define KD_ALONG_BOTH(told, VALUE) \
    uint axis = 0u; \
    [[dont_unroll]] do { \
        vec3 v[6]; \
        uint i = 0u; \
        [[dont_unroll]] do { \
            uint node = node_along(corner, side, axis, i); \
            [[unroll]] for (uint k = 0u; k < 5u; k++) \
                v[k] = v[k + 1u]; \
            v[5] = VALUE; \
        } while (++i < 6u); \
        tell(told, v); \
    } while (++axis < 2u);

/* Distance of the cell's middle from the direction to the hole, in steps between rays. On a sphere or a dome one radian
 * is used instead. Rounding of a direction moves its ray by an amount proportional to this distance. */
float steps_to_hole(uvec2 corner, uint side)
{
    ivec2 middle = place_of(corner + uvec2(side / 2u));
    float x = float(middle.x) - cam.middle_x, y = cam.middle_y - float(middle.y);
    if (cam.sight >= KD_SIGHT_SPHERE)
        return 1.0 / (0.5 * KD_PI * min(cam.turn_x, cam.turn_y));
    float step_ = sqrt(cam.cxx * cam.cxx + cam.cxy * cam.cxy + cam.cxz * cam.cxz);
    vec3 k = vec3(cam.c0x + x * cam.cxx + y * cam.cyx, cam.c0y + x * cam.cxy + y * cam.cyy,
                  cam.c0z + x * cam.cxz + y * cam.cyz);
    return (cam.sight == KD_SIGHT_PLANE ? length(k.xy) : length(k.yz)) / step_;
}

/* True if an island of another image order may lie between the nodes of a cell. An observer among the photon orbits or
 * closer sees such islands, a few degrees wide, next to the horizon of a hole that spins fast. The values at the nodes
 * do not reveal an island that fits between them. */
bool islands_fit_in(uint side)
{
    const float AMONG_ORBITS = 0.25, APART = 2.0 * KD_PI / 180.0;
    if (cam.w0 < AMONG_ORBITS || cam.sight == KD_SIGHT_PLANE)
        return false;
    float ray = cam.sight >= KD_SIGHT_SPHERE
                    ? 0.5 * KD_PI * max(cam.turn_x, cam.turn_y)
                    : length(vec3(cam.cxx, cam.cxy, cam.cxz)) / length(vec3(cam.c0x, cam.c0y, cam.c0z));
    return 0.25 * float(side) * ray > APART;
}

/* True if R at the turning point, which vanishes where fates change, is certainly nonzero between the nodes. least: the
 * least R at the nodes. Between nodes a curve deviates from a straight line by an eighth of its second difference. The
 * margin is four times this deviation, plus twice the error of the polynomials. */
bool curve_is_far(uvec2 corner, uint side, float least)
{
    kd_line_told t = KD_NOTHING_TOLD;
    KD_ALONG_BOTH(t, vec3(curve_of(node), 0.0, 0.0))
    return least > max(0.5 * t.bend.x, 2.0 * t.off.x);
}

/* True if the polynomials predict both checking rays within the tolerance. Errors of w are relative to w, errors of a
 * slope are relative to the steepest slope, and errors of angles are absolute. far: distance of the cell from the
 * direction to the hole, in quarters of the side. */
bool crossing_is_smooth(uvec2 corner, uint side, uint n, float far)
{
    kd_line_told t = KD_NOTHING_TOLD;
    vec3 middle = crossing_of(node_along(corner, side, 0u, 2u), n), least = middle, most = middle;
    KD_ALONG_BOTH(t, crossing_of(node, n); v[5].y = kd_turned(v[5].y - middle.y); least = min(least, v[5]);
                  most = max(most, v[5]))
    float bend = 0.25 * t.bend.x;
    vec3 scale = vec3(middle.x, 1.0, max(max(abs(least.z), abs(most.z)), 1e-30)),
         steep = CONDITION * far * sqrt(t.slope2) / scale;
    bool within = all(lessThanEqual(t.off, push.tolerance * scale * max(vec3(1.0), steep)));
    return within && least.x > bend && most.x + bend < max(cam.horizon, 1.1 * cam.w0);
}

bool sky_is_smooth(uvec2 corner, uint side, float far)
{
    kd_line_told t = KD_NOTHING_TOLD;
    KD_ALONG_BOTH(t, direction_of(node))
    float steep = CONDITION * far * sqrt(t.slope2.x + t.slope2.y + t.slope2.z);
    return t.apart <= push.tolerance * max(1.0, steep);
}

/* True if a cell is smooth: all of its rays have the same number of crossings and the same fate, and its polynomials
 * predict the rays between its nodes. */
bool is_smooth(uvec2 corner, uint side, out float state)
{
    state = state_of(node_along(corner, side, 0u, 2u));
    bool same = state != KD_NODE_OPEN && state_of(node_along(corner, side, 0u, 5u)) == state &&
                state_of(node_along(corner, side, 1u, 5u)) == state;
    float least = 1e30;
    uint k = 0u;
    [[dont_unroll]] do {
        uint node = number[index_of_node(corner, side, k % 5u, k / 5u)] - 1u;
        least = min(least, abs(curve_of(node)));
        same = same && state_of(node) == state;
    } while (++k < 25u);
    same = same && curve_is_far(corner, side, least);
    const float far = 4.0 * steps_to_hole(corner, side) / float(side);
    const uint crossings = same ? min(crossings_of(state), ORDERS) : 0u;
    uint n = 0u;
    [[dont_unroll]] do {
        same = same && (n >= crossings || crossing_is_smooth(corner, side, n, far));
    } while (++n < crossings);
    return same && (!SKY || captured(state) || sky_is_smooth(corner, side, far));
}

/* Lists the units of one kind (crossings or the sky) of a smooth cell, to be filled by interpolation. */
void list_units(uint kind, uvec2 corner, uint level)
{
    const uint n = side_of(level) / 8u,
               word = units_of(kind) + take(KD_SAMPLE_FILLS + 4u * kind, n, KD_GROUP_SIZE / 8u);
    uint i = 0u;
    [[dont_unroll]] do {
        words[word + i] = kd_unit(corner / 8u, i, level);
    } while (++i < n);
}

/* Lists the rays of a cell of the last level, to be traced singly. */
void follow_alone(uvec2 corner)
{
    ivec2 place = place_of(corner), low = max(place, ivec2(0, int(push.row0))),
          high = min(place + 8, ivec2(int(push.width), int(push.row0 + push.rows))), n = high - low;
    uint word = places_alone() + take(4u * KD_STAGE_ALONE, uint(n.x * n.y), KD_GROUP_SIZE);
    int k = 0;
    [[dont_unroll]] do {
        if (k < n.x * n.y)
            words[word++] = kd_place_word(uvec2(low - place_of(uvec2(0u)) + ivec2(k % n.x, k / n.x)));
    } while (++k < n.x * n.y);
}

/* Processes a cell of a level. At level 0 the cell is a block, which becomes a cell of level 1. */
void look_at(uvec2 cell, uint level)
{
    const bool begins = level == 0u;
    uint side = begins ? KD_CELL_BLOCK : side_of(level), cells = begins ? 1u : 2u;
    uvec2 corner = cell * side;
    float state = 0.0;
    bool smooth_ = !begins && !islands_fit_in(side) && is_smooth(corner, side, state);
    if (smooth_ && crossings_of(state) > 0u)
        list_units(0u, corner, level);
    if (smooth_ && SKY && !captured(state))
        list_units(1u, corner, level);
    if (!smooth_ && level == KD_CELL_LEVELS)
        follow_alone(corner);
    if (!smooth_ && level < KD_CELL_LEVELS) {
        list_nodes(level, corner, side, !begins);
        uint k = 0u;
        [[dont_unroll]] do {
            list_cell(level + 1u, cells * cell + uvec2(k % 2u, k / 2u));
        } while (++k < cells * cells);
    }
}

void main()
{
    push = push_;
    cam = camera_;
    uint i = gl_GlobalInvocationID.x;
    if (push.level == 0u && i == 0u) /* the dispatch has one workgroup along each of the other axes */
        [[dont_unroll]]
        for (uint k = 0u; k < KD_SAMPLE_COUNTED / 4u; k++) {
            words[4u * k + 1u] = 1u;
            words[4u * k + 2u] = 1u;
        }
    const bool begins = push.level == 0u;
    if (i >= (begins ? blocks() : words[KD_SAMPLE_CELLS + 4u * (push.level - 1u) + 3u]))
        return;
    uint entry = begins ? 0u : words[queue_of(push.level) + i];
    look_at(begins ? uvec2(i % push.blocks_x, i / push.blocks_x) : uvec2(entry & 0xffffu, entry >> 16), push.level);
}
