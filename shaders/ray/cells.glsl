/* Places of cells and nodes of a sampled lens map, and the contents of a node; shared by its kernels.
 *
 * A cell of level k has KD_CELL_BLOCK / 2^(k - 1) rays along each side. Its nodes are rays of the picture at each
 * quarter of a side: there are 5 x 5, including those on the far sides, which the next cells share. Between the nodes,
 * w and azimuth of each crossing, and the other quantities, are interpolated by polynomials of degree 4 in both
 * directions. Nodes of all levels are at even places, except the rays that check a cell of the last level.
 *
 * This file needs the specialisation constants QUANTITIES and ORDERS, KD_SAMPLE_CAMERA_BINDING, and a macro NODE_AT(i)
 * that reads word i of the nodes' map. */
#ifndef KD_CELLS_GLSL
#define KD_CELLS_GLSL

#include "shared/math.glsl"
#include "ray/planes.glsl"
#include "ray/hole.glsl"

#define F(name) float name;
#define U(name) uint name;
struct kd_sampling { KD_SAMPLE_FIELDS_(F, U) };
struct kd_camera_block { KD_CAMERA_FIELDS_(F, U) };
layout(push_constant) uniform Push { kd_sampling push_; };
layout(set = 0, binding = KD_SAMPLE_CAMERA_BINDING, std140) uniform Camera { kd_camera_block camera_; };
kd_sampling push; /* `push` and the next variable: set before the first branch, as in ray/camera.glsl */
kd_camera_block cam;

const bool PHI = (QUANTITIES & KD_LENS_PHI) != 0u, SLOPE = (QUANTITIES & KD_LENS_SLOPE) != 0u,
           SKY = (QUANTITIES & KD_LENS_SKY_U) != 0u, FATE = (QUANTITIES & KD_LENS_FATE) != 0u;

/* The index has two parts. The first part has a word for each even place: 1 + the number of the node there, or 0 if
 * there is no node. The second part has two words for each cell of the last level: the two rays that check the cell. */
const uint SIDE = 32u; /* number of even places along the side of a block */
uint index_width() { return SIDE * push.blocks_x + 1u; }
uint index_of(uvec2 even) { return even.y * index_width() + even.x; }
uint index_checks() { return index_width() * (SIDE * push.blocks_y + 1u); }
uint index_of_last(uvec2 last) { return last.y * 8u * push.blocks_x + last.x; }

/* Offset in the index of a cell's node (i, j). i and j count quarters of the cell's side, which is `side` rays long. */
uint index_of_node(uvec2 corner, uint side, uint i, uint j)
{
    return index_of((corner + uvec2(i, j) * (side / 4u)) / 2u);
}

/* The picture's ray at a place that is counted from the first block's first ray. */
ivec2 place_of(uvec2 at) { return ivec2(at) + ivec2(int(push.origin_x), int(push.origin_y)); }

uint blocks() { return push.blocks_x * push.blocks_y; }
uint side_of(uint level) { return KD_CELL_BLOCK >> (level - 1u); }

/* Offset of the list of units of a kind: 0 for crossings, 1 for the sky. */
uint units_of(uint kind) { return KD_SAMPLE_QUEUES + blocks() * (KD_SAMPLE_QUEUED + kind * KD_SAMPLE_UNITS); }

/* A unit packed in one word: the cell's corner in units of eight rays, the number of the unit's eight columns within
 * the cell, and the cell's level. */
uint kd_unit(uvec2 corner, uint eight, uint level) { return corner.x + eight | corner.y << 15 | (level - 1u) << 29; }
/* Place of the first of the unit's eight columns, in rays. */
uvec2 kd_unit_corner(uint unit) { return 8u * uvec2(unit & 0x7fffu, (unit >> 15) & 0x3fffu); }
uint kd_unit_level(uint unit) { return (unit >> 29) + 1u; }

/* Values that ray/node.glsl stores after the planes. state_of: state of a node. curve_of: value at a node that vanishes
 * where the fate of rays changes. */
float state_of(uint node) { return NODE_AT(kd_planes_of_all() * push.room + node); }
float curve_of(uint node) { return NODE_AT((kd_planes_of_all() + 1u) * push.room + node); }
uint crossings_of(float state) { return uint(state) & 15u; }
bool captured(float state) { return state >= KD_NODE_CAPTURED; }

/* Values of a node, as ray/node.glsl stores them. crossing_of: w, azimuth and slope of a crossing. direction_of: unit
 * vector of the ray's end in the sky. */
vec3 crossing_of(uint node, uint n)
{
    return vec3(NODE_AT(n * push.room + node), PHI ? NODE_AT((kd_plane(KD_LENS_PHI) + n) * push.room + node) : 0.0,
                SLOPE ? NODE_AT((kd_plane(KD_LENS_SLOPE) + n) * push.room + node) : 0.0);
}
vec3 direction_of(uint node)
{
    return vec3(NODE_AT(kd_plane(KD_LENS_SKY_PHI) * push.room + node),
                NODE_AT(kd_plane(KD_LENS_FATE) * push.room + node),
                NODE_AT(kd_plane(KD_LENS_SKY_U) * push.room + node));
}

#endif
