/* This kernel decides where a lens map is followed ray by ray and where it is interpolated. An invocation is a cell
 * (ray/cells.glsl) of one level, all of whose nodes are followed: if the polynomials through them tell two more rays of
 * it, it is done; else its four quarters are cells of the next level, whose nodes are listed, and a cell of the last
 * level is followed ray by ray. The map is analytic in a cell but where orders or fates change, and whether they do the
 * nodes say. What a cell becomes depends on its own rays alone: a tile's cells are those of its picture.
 *
 * The tolerance is relative, of w, an angle and a direction alike; where the map is so steep that the rounding of the
 * camera's directions to 32 bits moves it more, it is CONDITION of that: of the change of ln w, or of the angle, that
 * a direction twice as far from the hole would have. A strict one fails by noise. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_SAMPLE(KD_SPEC_U_, KD_SPEC_B_)
layout(local_size_x = KD_GROUP_SIZE) in;

layout(set = 0, binding = 0) buffer Sample { uint words[]; };
layout(set = 0, binding = 1) buffer Index { uint number[]; };
layout(set = 0, binding = 2) readonly buffer Nodes { float nodes[]; };
#define KD_SAMPLE_CAMERA_BINDING 3
#define NODE_AT(i) nodes[i]
#include "ray/cells.glsl"
#include "ray/places.glsl"

const float CONDITION = 0.3;

/* The lists of cells, those of a level four times as long as those of the level before; and places. */
uint queue_of(uint level) { return KD_SAMPLE_QUEUES + blocks() * (((1u << (2u * (level - 1u))) - 1u) / 3u); }
uint places_of_nodes() { return units_of(2u); }
uint places_alone() { return places_of_nodes() + push.room; }

/* Takes so many numbers of a list whose counts begin there, and asks for workgroups of so many each. */
uint take(uint counts, uint n, uint each)
{
    uint first = atomicAdd(words[counts + 3u], n);
    atomicMax(words[counts], (first + n + each - 1u) / each);
    return first;
}

/* Part of the picture, or of the rows of it that are wanted. */
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

/* The two rays that a cell is checked by, next to the middles of two of its sides: where polynomials are furthest off.
 * Of all levels but the last they lie at even places. */
uvec2 check_of(uvec2 corner, uint side, uint i)
{
    return corner + (i == 0u ? uvec2(side / 8u, side / 2u) : uvec2(side / 2u, side / 8u));
}

/* Places that become nodes where a cell is divided: among 9 x 9 those 16 on the edge that were none, which the cells
 * beside it may list as well, and 38 within, all of which it lists itself; two there were what the cell was checked by.
 */
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
/* And where a block is begun: 16 and 9 of 5 x 5. */
uvec2 edge_of_five(uint k)
{
    uint i = k % 4u, side = k / 4u;
    return side == 0u ? uvec2(i, 0u) : side == 1u ? uvec2(4u, i) : side == 2u ? uvec2(4u - i, 4u) : uvec2(0u, 4u - i);
}
uvec2 within_five(uint k) { return uvec2(k % 3u + 1u, k / 3u + 1u); }

/* This makes a place a node. word: of the index. */
void make_node(uint node, uint word, uvec2 at)
{
    number[word] = node + 1u;
    words[places_of_nodes() + node] = kd_place_word(at);
}

/* Lists the nodes of a cell's four quarters, or of a block, that are none yet, and the two rays by which each of these
 * is checked. stage: of these rays. */
void list_nodes(uint stage, uvec2 corner, uint side, bool divided)
{
    const uint step_ = divided ? side / 8u : side / 4u, within = divided ? 38u : 9u,
               checked = divided ? side / 2u : side, cells = side / checked;
    uint mine = 0u;
    for (uint k = 0u; k < 16u; k++) {
        uvec2 at = corner + (divided ? edge_of_nine(k) : edge_of_five(k)) * step_;
        mine |= atomicCompSwap(number[index_of(at / 2u)], 0u, 0xffffffffu) == 0u ? 1u << k : 0u;
    }
    uint node =
        kd_stage_first(stage) + take(4u * stage, uint(bitCount(mine)) + within + 2u * cells * cells, KD_GROUP_SIZE);
    for (uint k = 0u; k < 16u; k++) {
        uvec2 at = corner + (divided ? edge_of_nine(k) : edge_of_five(k)) * step_;
        if ((mine & (1u << k)) != 0u)
            make_node(node++, index_of(at / 2u), at);
    }
    for (uint k = 0u; k < within; k++) {
        uvec2 at = corner + (divided ? within_nine(k) : within_five(k)) * step_;
        make_node(node++, index_of(at / 2u), at);
    }
    for (uint k = 0u; k < 2u * cells * cells; k++) {
        uvec2 cell = corner + uvec2((k / 2u) % cells, k / 2u / cells) * checked, at = check_of(cell, checked, k % 2u);
        make_node(node++, checked == 8u ? index_checks() + 2u * index_of_last(cell / 8u) + k % 2u : index_of(at / 2u),
                  at);
    }
}

/* The nodes that a cell's polynomials are checked by: along its middle row and its middle column, the middle one twice;
 * and the two rays. */
struct kd_cross { uint at[12]; };
uint node_of_cross(kd_cross c, uint axis, uint i) { return c.at[5u * axis + i]; }
uint check_node(kd_cross c, uint axis) { return c.at[10u + axis]; }

kd_cross cross_of(uvec2 corner, uint side)
{
    kd_cross c;
    for (uint i = 0u; i < 5u; i++) {
        c.at[i] = number[index_of_node(corner, side, i, 2u)] - 1u;
        c.at[5u + i] = number[index_of_node(corner, side, 2u, i)] - 1u;
    }
    for (uint i = 0u; i < 2u; i++)
        c.at[10u + i] = number[side == 8u ? index_checks() + 2u * index_of_last(corner / 8u) + i
                                          : index_of(check_of(corner, side, i) / 2u)] -
                        1u;
    return c;
}

/* What an axis of a cross tells of a quantity: what its polynomial is off by at the ray next to its first node, the
 * slope in the middle and the largest second difference, both of a quarter of the side. */
struct kd_line_told { vec3 off, slope, bend; };

kd_line_told told_of(vec3 v[6])
{
    kd_line_told t;
    vec3 a = v[0] - v[2], b = v[1] - v[2], d = v[3] - v[2], e = v[4] - v[2];
    t.off = v[5] - v[2] - (35.0 * a + 140.0 * b + 28.0 * d - 5.0 * e) / 128.0;
    t.slope = 0.5 * (d - b);
    t.bend = max(max(abs(a - 2.0 * b), abs(b + d)), abs(e - 2.0 * d));
    return t;
}

bool is_told(vec3 off, vec3 most) { return all(lessThanEqual(off, most)); } /* false of what is no number */

/* How far a step from ray to ray is from the direction to the hole, at most: what rounding moves a ray by is a part of
 * that. In such steps. */
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

/* Whether the polynomials of a quantity tell both rays. scale: what the tolerance is relative to. */
bool tells(kd_line_told x, kd_line_told y, vec3 scale, float far)
{
    vec3 steep = CONDITION * far * sqrt(x.slope * x.slope + y.slope * y.slope) / scale,
         most = push.tolerance * scale * max(vec3(1.0), steep);
    return is_told(abs(x.off), most) && is_told(abs(y.off), most);
}

/* Between nodes a curve leaves them by an eighth of its second difference: whether what vanishes where fates change,
 * and is this at least at the nodes, can vanish between them. Four times that, and twice what the polynomials miss. */
bool curve_is_far(kd_cross c, float least)
{
    float bend = 0.0, middle = curve_of(c.at[2]);
    for (uint axis = 0u; axis < 2u; axis++) {
        vec3 v[6];
        for (uint i = 0u; i < 6u; i++)
            v[i] = vec3(curve_of(i < 5u ? node_of_cross(c, axis, i) : check_node(c, axis)) - middle, 0.0, 0.0);
        kd_line_told t = told_of(v);
        bend = max(bend, max(0.5 * t.bend.x, 2.0 * abs(t.off.x)));
    }
    return least > bend;
}

bool crossing_is_smooth(kd_cross c, uint n, uint side, float far)
{
    kd_line_told t[2];
    vec3 middle = crossing_of(c.at[2], n);
    float least = middle.x, most = middle.x, steepest = abs(middle.z);
    for (uint axis = 0u; axis < 2u; axis++) {
        vec3 v[6];
        for (uint i = 0u; i < 6u; i++) {
            v[i] = crossing_of(i < 5u ? node_of_cross(c, axis, i) : check_node(c, axis), n);
            least = min(least, v[i].x);
            most = max(most, v[i].x);
            steepest = max(steepest, abs(v[i].z));
            v[i].y = turned(v[i].y - middle.y);
        }
        t[axis] = told_of(v);
    }
    /* Between nodes a curve leaves them by an eighth of its second difference. */
    float bend = 0.25 * max(t[0].bend.x, t[1].bend.x);
    return least > bend && most + bend < max(cam.horizon, 1.1 * cam.w0) &&
           tells(t[0], t[1], vec3(middle.x, 1.0, max(steepest, 1e-30)), 4.0 * far / float(side));
}

bool sky_is_smooth(kd_cross c, uint side, float far)
{
    kd_line_told t[2];
    vec3 middle = direction_of(c.at[2]);
    for (uint axis = 0u; axis < 2u; axis++) {
        vec3 v[6];
        for (uint i = 0u; i < 6u; i++)
            v[i] = direction_of(i < 5u ? node_of_cross(c, axis, i) : check_node(c, axis)) - middle;
        t[axis] = told_of(v);
    }
    vec3 dx = t[0].slope, dy = t[1].slope;
    float steep = CONDITION * 4.0 * far / float(side) * sqrt(dot(dx, dx) + dot(dy, dy)),
          most = push.tolerance * max(1.0, steep);
    return length(t[0].off) <= most && length(t[1].off) <= most;
}

/* Whether all rays of a cell cross as often and end alike, and its polynomials tell those between its nodes. */
bool is_smooth(uvec2 corner, uint side, out float state)
{
    kd_cross c = cross_of(corner, side);
    state = state_of(c.at[2]);
    bool same = state != KD_NODE_OPEN && state_of(c.at[10]) == state && state_of(c.at[11]) == state;
    float least = 1e30;
    for (uint k = 0u; k < 25u; k++) {
        uint node = number[index_of_node(corner, side, k % 5u, k / 5u)] - 1u;
        least = min(least, abs(curve_of(node)));
        same = same && state_of(node) == state;
    }
    same = same && curve_is_far(c, least);
    float far = steps_to_hole(corner, side);
    const uint crossings = same ? min(crossings_of(state), ORDERS) : 0u;
    for (uint n = 0u; n < crossings; n++)
        same = same && crossing_is_smooth(c, n, side, far);
    return same && (!SKY || captured(state) || sky_is_smooth(c, side, far));
}

/* Lists a cell's units of a kind. */
void list_units(uint kind, uvec2 corner, uint level)
{
    const uint n = side_of(level) / 8u,
               word = units_of(kind) + take(KD_SAMPLE_FILLS + 4u * kind, n, KD_GROUP_SIZE / 8u);
    for (uint i = 0u; i < n; i++)
        words[word + i] = kd_unit(corner / 8u, i, level);
}

/* A cell of the last level whose rays are followed one by one. */
void follow_alone(uvec2 corner)
{
    ivec2 place = place_of(corner), low = max(place, ivec2(0, int(push.row0))),
          high = min(place + 8, ivec2(int(push.width), int(push.row0 + push.rows))), n = high - low;
    uint word = places_alone() + take(4u * KD_STAGE_ALONE, uint(n.x * n.y), KD_GROUP_SIZE);
    for (int k = 0; k < n.x * n.y; k++)
        words[word++] = kd_place_word(uvec2(low - place_of(uvec2(0u)) + ivec2(k % n.x, k / n.x)));
}

/* The first level: a block is a cell. */
void begin(uint block)
{
    uvec2 cell = uvec2(block % push.blocks_x, block / push.blocks_x);
    list_nodes(0u, cell * KD_CELL_BLOCK, KD_CELL_BLOCK, false);
    list_cell(1u, cell);
}

void look_at(uint entry, uint level)
{
    uint side = side_of(level);
    uvec2 cell = uvec2(entry & 0xffffu, entry >> 16), corner = cell * side;
    float state;
    if (is_smooth(corner, side, state)) {
        if (crossings_of(state) > 0u)
            list_units(0u, corner, level);
        if (SKY && !captured(state))
            list_units(1u, corner, level);
    } else if (level == KD_CELL_LEVELS) {
        follow_alone(corner);
    } else {
        list_nodes(level, corner, side, true);
        for (uint k = 0u; k < 4u; k++)
            list_cell(level + 1u, 2u * cell + uvec2(k % 2u, k / 2u));
    }
}

void main()
{
    push = push_;
    cam = camera_;
    uint i = gl_GlobalInvocationID.x;
    if (push.level == 0u && i == 0u) /* workgroups along the other axes */
        for (uint k = 0u; k < KD_SAMPLE_COUNTED / 4u; k++) {
            words[4u * k + 1u] = 1u;
            words[4u * k + 2u] = 1u;
        }
    if (push.level == 0u) {
        if (i < blocks())
            begin(i);
    } else if (i < words[KD_SAMPLE_CELLS + 4u * (push.level - 1u) + 3u]) {
        look_at(words[queue_of(push.level) + i], push.level);
    }
}
