/* Kernel: fills a lens map from the nodes of its smooth cells (ray/cells.glsl). The polynomials through the nodes give
 * w, azimuth and slope of each ray's crossings, and the direction in which the ray escapes. The polynomials'
 * derivatives give the footprints. An invocation processes a column of rays of a cell. It reduces 25 nodes to five
 * numbers for the column, and these five to one number for each ray. All values are relative to the cell's middle node,
 * so that rounding is relative to the change within the cell.
 *
 * The map is already initialised: the planes of w are 0, and all fates are captured. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_FILL(KD_SPEC_U_, KD_SPEC_B_)
layout(local_size_x = KD_GROUP_SIZE) in;

layout(set = 0, binding = 0) writeonly buffer LensMap { float lens[]; };
#ifdef KD_TEXELS
layout(set = 0, binding = 1) uniform utextureBuffer numbers;
layout(set = 0, binding = 2) uniform textureBuffer nodes;
#define NUMBER_AT(i) texelFetch(numbers, int(i)).r
#define NODE_AT(i) texelFetch(nodes, int(i)).r
#else
layout(set = 0, binding = 1) readonly buffer Index { uint numbers[]; };
layout(set = 0, binding = 2) readonly buffer Nodes { float nodes[]; };
#define NUMBER_AT(i) numbers[i]
#define NODE_AT(i) nodes[i]
#endif
#define KD_SAMPLE_CAMERA_BINDING 3
layout(set = 0, binding = 4) readonly buffer Sample { uint words[]; };
#include "ray/cells.glsl"
#include "ray/ellipse.glsl"

const bool FOOTPRINT = (QUANTITIES & KD_LENS_FOOTPRINT) != 0u, SHAPED = (QUANTITIES & KD_LENS_SHAPE) != 0u,
           SKY_FOOTPRINT = (QUANTITIES & KD_LENS_SKY_FOOTPRINT) != 0u;
const bool STEEP = OF_SKY ? SKY_FOOTPRINT : FOOTPRINT; /* true if footprints, and so derivatives, are needed */

/* Weights of the five nodes along a line at t quarters of the side (Lagrange's polynomials). value: weights for the
 * value at t. slope: weights for the derivative at t. */
struct kd_weights { float value[5], slope[5]; };

kd_weights weigh(float t)
{
    kd_weights o;
    float a = t, b = t - 1.0, c = t - 2.0, d = t - 3.0, e = t - 4.0;
    float ab = a * b, de = d * e, sa = a + b, se = d + e; /* sa and se are the derivatives of ab and de */
    o.value[0] = b * c * de * (1.0 / 24.0);
    o.value[1] = -a * c * de * (1.0 / 6.0);
    o.value[2] = ab * de * 0.25;
    o.value[3] = -ab * c * e * (1.0 / 6.0);
    o.value[4] = ab * c * d * (1.0 / 24.0);
    o.slope[0] = ((b + c) * de + b * c * se) * (1.0 / 24.0);
    o.slope[1] = -((a + c) * de + a * c * se) * (1.0 / 6.0);
    o.slope[2] = (sa * de + ab * se) * 0.25;
    o.slope[3] = -((sa * c + ab) * e + ab * c) * (1.0 / 6.0);
    o.slope[4] = ((sa * c + ab) * d + ab * c) * (1.0 / 24.0);
    return o;
}

/* The cell of a column: its nodes row by row, and their weights in the column. */
struct kd_column {
    uint node[25];
    kd_weights by;
};

/* A quantity reduced to a column: value: its value in the five rows of nodes. slope: its change from column to column
 * in these rows. */
struct kd_lines { vec3 value[5], slope[5]; };

vec3 along(float weight[5], vec3 v[5])
{
    return weight[0] * v[0] + weight[1] * v[1] + weight[2] * v[2] + weight[3] * v[3] + weight[4] * v[4];
}

vec3 value_of(uint node, uint n) { return OF_SKY ? direction_of(node) : crossing_of(node, n); }

kd_lines lines_of(kd_column c, uint n, vec3 middle)
{
    kd_lines l;
    [[unroll]] for (uint j = 0u; j < 5u; j++) {
        vec3 v[5];
        [[unroll]] for (uint i = 0u; i < 5u; i++) {
            v[i] = value_of(c.node[5u * j + i], n) - middle;
            if (!OF_SKY && PHI)
                v[i].y = kd_turned(v[i].y);
        }
        l.value[j] = along(c.by.value, v);
        if (STEEP)
            l.slope[j] = along(c.by.slope, v);
    }
    return l;
}

/* Stores the result of max, because this is faster on lavapipe. lavapipe computes a plain value in the loop that stores
 * it, lane by lane. It computes the result of max for all lanes at once. */
void put(uint at, uint plane, float value) { lens[at + plane * push.stride] = max(value, -KD_FOOTPRINT_EDGE); }

/* The cell's polynomials at a ray. v: the value. i, j: changes of the value from ray to ray along x and y. */
struct kd_patch_at { vec3 v, i, j; };

void put_crossing(uint at, uint n, kd_patch_at s, bool falls)
{
    put(at, n, s.v.x);
    if (PHI)
        put(at, kd_plane(KD_LENS_PHI) + n, falls ? s.v.y - cam.spin * kd_fall(s.v.x, cam.root) : s.v.y);
    if (SLOPE)
        put(at, kd_plane(KD_LENS_SLOPE) + n, s.v.z);
    if (FOOTPRINT) { /* slopes are converted to the metric of the disk, including the azimuth's logarithm */
        float r = 1.0 / s.v.x, drag = falls ? cam.spin / kd_horizons(s.v.x, cam.root) : 0.0;
        vec2 i = vec2(r * r * s.i.x, r * (s.i.y - drag * s.i.x)), j = vec2(r * r * s.j.x, r * (s.j.y - drag * s.j.x));
        kd_oval o = kd_oval_of(i.x * i.x + j.x * j.x, i.y * i.y + j.y * j.y, i.x * i.y + j.x * j.y);
        put(at, kd_plane(KD_LENS_FOOTPRINT) + n, o.size);
        if (SHAPED)
            put(at, kd_plane(KD_LENS_SHAPE) + n, o.shape);
    }
}

void put_end(uint at, kd_patch_at s)
{
    put(at, kd_plane(KD_LENS_SKY_U), s.v.z * inversesqrt(dot(s.v, s.v)));
    put(at, kd_plane(KD_LENS_SKY_PHI), kd_atan2(s.v.y, s.v.x));
    put(at, kd_plane(KD_LENS_FATE), KD_FATE_ESCAPED);
    if (SKY_FOOTPRINT)
        put(at, kd_plane(KD_LENS_SKY_FOOTPRINT), kd_longest(dot(s.i, s.i), dot(s.j, s.j), dot(s.i, s.j)));
}

/* The rays of a column: index in a plane of the first ray; place of the first ray, in quarters of the cell; number of
 * rays; and distance between rays. */
struct kd_rows {
    uint at, n;
    float from, unit;
};

void fill_rows(kd_lines l, kd_rows rows, vec3 middle, uint n, bool falls)
{
    uint at = rows.at, k = 0u;
    do {
        kd_weights by = weigh(rows.from + float(k) * rows.unit);
        kd_patch_at s;
        s.v = middle + along(by.value, l.value);
        if (STEEP) {
            s.i = rows.unit * along(by.value, l.slope);
            s.j = rows.unit * along(by.slope, l.value);
        }
        if (OF_SKY)
            put_end(at, s);
        else
            put_crossing(at, n, s, falls);
        at += push.width;
    } while (++k < rows.n);
}

void main()
{
    push = push_;
    cam = camera_;
    const uint kind = OF_SKY ? 1u : 0u, number = gl_GlobalInvocationID.x / 8u;
    if (number >= words[KD_SAMPLE_FILLS + 4u * kind + 3u])
        return;
    uint unit = words[units_of(kind) + number], side = side_of(kd_unit_level(unit));
    uvec2 ray = kd_unit_corner(unit) + uvec2(gl_GlobalInvocationID.x % 8u, 0u), corner = ray / side * side;
    ivec2 place = place_of(ray);
    int first = max(place.y, int(push.row0)), end = min(place.y + int(side), int(push.row0 + push.rows));
    if (place.x < 0 || place.x >= int(push.width) || first >= end)
        return;
    kd_rows rows;
    rows.unit = 4.0 / float(side);
    rows.from = float(first - place.y) * rows.unit;
    rows.n = uint(end - first);
    rows.at = uint(first - int(push.band0)) * push.width + uint(place.x);
    kd_column c;
    [[unroll]] for (uint k = 0u; k < 25u; k++)
        c.node[k] = NUMBER_AT(index_of_node(corner, side, k % 5u, k / 5u)) - 1u;
    c.by = weigh(float(ray.x - corner.x) * rows.unit);
    const float state = state_of(c.node[12]);
    const uint last = OF_SKY ? 1u : min(crossings_of(state), ORDERS);
    uint n = 0u;
    do { /* this loop tests at its end, for the reason given in lens_closed.comp */
        vec3 middle = value_of(c.node[12], n);
        fill_rows(lines_of(c, n, middle), rows, middle, n, captured(state));
    } while (++n < last);
}
