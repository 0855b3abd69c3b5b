/* Buffers shared by the kernels that search stars. They hold the list of stars in cells, and the kernels' output: pairs
 * of a ray and a star, and rays still to be searched. The bindings are 3 to 6. This file needs sky_map.glsl. */
#ifndef KD_STAR_LIST_GLSL
#define KD_STAR_LIST_GLSL

#include "shared/faces.h"
/* word 0: number of pairs; from word 2 on: two words for each pair, the ray and the star */
layout(set = 0, binding = 3) buffer Pairs { uint pairs[]; };
#ifdef KD_TEXELS
layout(set = 0, binding = 4) uniform textureBuffer stars;
vec4 star_row(uint k) { return texelFetch(stars, int(k)); }
/* index of each fine cell's first star, then of each coarse cell's */
layout(set = 0, binding = 5) uniform utextureBuffer cells;
uint cell_at(uint of) { return texelFetch(cells, int(of)).r; }
#else
layout(set = 0, binding = 4) readonly buffer Stars { vec4 stars[]; };
vec4 star_row(uint k) { return stars[k]; }
layout(set = 0, binding = 5) readonly buffer Cells { uint cells[]; };
uint cell_at(uint of) { return cells[of]; }
#endif
layout(set = 0, binding = 6) buffer Listed
{
    uint listed[];
}; /* number of tiles, number of rays, list of up to push.tiles tiles, list of rays */

/* The cells of a face of the cube that lie in a rectangle. */
struct kd_cells {
    int first, side;
    ivec2 low, high;
};

kd_cells kd_cells_of(uint face, vec2 low, vec2 high)
{
    bool far = max(high.x - low.x, high.y - low.y) > KD_FACE_FAR;
    int side = far ? KD_FACE_COARSE : KD_FACE_FINE,
        first = (far ? KD_FACE_TABLE(KD_FACE_FINE) : 0) + int(face) * side * side;
    return kd_cells(first, side, kd_face_cell(low.x, low.y, float(side)), kd_face_cell(high.x, high.y, float(side)));
}

/* Position in an iteration over the stars of a rectangle of cells. k: the next star. end: end of the stars of the
 * current cell. */
struct kd_star_walk {
    ivec2 cell;
    uint k, end;
    bool done;
};

kd_star_walk kd_star_walk_from(kd_cells c, bool any) { return kd_star_walk(ivec2(c.low.x - 1, c.low.y), 0u, 0u, !any); }

/* Moves to the next cell, which may be empty, if the current one has no more stars. */
void kd_star_next_cell(kd_cells c, inout kd_star_walk walk)
{
    if (walk.k >= walk.end) {
        bool row = walk.cell.x >= c.high.x;
        walk.done = walk.done || (row && walk.cell.y >= c.high.y);
        walk.cell = ivec2(row ? c.low.x : walk.cell.x + 1, row ? walk.cell.y + 1 : walk.cell.y);
        uint of = uint(c.first + min(walk.cell.y, c.side - 1) * c.side + walk.cell.x);
        walk.k = cell_at(of);
        walk.end = cell_at(of + 1u);
    }
}

#endif
