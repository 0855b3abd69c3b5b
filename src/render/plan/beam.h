/* A telescope's beam (style.beam_uas) is light convolved with a round Gaussian, before exposure, glare and curves.
 * Any thread.
 *
 * The beam decides how fine the work is, not the picture. Where the Gaussian's standard deviation sigma is
 * KD_BEAM_CELLS cells of two pixels or more, light is put on a grid of square cells, blurred there, and seen through
 * the grid. Both ways are quadratic B-splines, which move nothing and have the variance 1/4 each, in cells; the blur
 * has what is missing of sigma^2. What comes out is off by 3e-4 of the brightest where all light is in one cell, and
 * by less else. Along each axis there is a pass of its own. For a narrower beam cells are pixels, and the weights
 * are the Gaussian's at the pixels' middles. The sum of the weights is 1, and where there is no picture there is no
 * light. */
#ifndef KD_RENDER_PLAN_BEAM_H
#define KD_RENDER_PLAN_BEAM_H

#include "scene/scene.h"

#include <stdint.h>

#define KD_BEAM_CELLS 4 /* cells a standard deviation, at least */

struct kd_beam_grid {
    uint32_t cell;          /* pixels along the side of a cell; 0: there is no beam, or none that pixels show */
    uint32_t columns, rows; /* of the grid; of cells larger than pixels one more on each side of the picture */
    uint32_t height;        /* of the picture: rows of cells before they are put together, one for each of pixels */
    double sigma;           /* of the blur, in cells */
    uint32_t reach;         /* of it, in cells: 5 sigma, beyond which it has 6e-7 of its weight */
};

/* Gives that of a valid scene's picture. */
struct kd_beam_grid kd_beam_of(const struct kd_scene *scene);

/* Bytes of rows of cells, one for each row of pixels; and of one grid. */
static inline uint64_t kd_beam_lines_bytes(const struct kd_beam_grid *beam)
{
    return 16ull * beam->columns * beam->height;
}
static inline uint64_t kd_beam_cells_bytes(const struct kd_beam_grid *beam)
{
    return 16ull * beam->columns * beam->rows;
}
/* Count the bytes of the buffers of a plan: with larger cells two grids, else one. */
static inline uint64_t kd_beam_grids_bytes(const struct kd_beam_grid *beam)
{
    return beam->cell > 1 ? (kd_beam_cells_bytes(beam) + 255) / 256 * 256 + kd_beam_cells_bytes(beam)
                          : kd_beam_cells_bytes(beam);
}

#endif
