/* A telescope's beam (style.beam_uas): light is convolved with a round Gaussian, before exposure, bloom and tone
 * curves. Any thread.
 *
 * The work depends on the beam's resolution, not on the picture's. If the beam's standard deviation sigma is at least
 * KD_BEAM_CELLS cells of two pixels or more, light is gathered on a grid of square cells, blurred there, and
 * interpolated back. Gathering and interpolation use quadratic B-splines, which shift nothing and have a variance of
 * 1/4 each, in cells. The blur supplies the rest of sigma^2. The error is 3e-4 of the brightest value if all light is
 * in one cell, and less otherwise. Each axis is blurred by a pass of its own. For a narrower beam the cells are pixels,
 * weighted by the Gaussian at their centres. The weights add up to 1, and there is no light outside the picture. */
#ifndef KD_RENDER_PLAN_BEAM_H
#define KD_RENDER_PLAN_BEAM_H

#include "scene/scene.h"

#include <stdint.h>

#define KD_BEAM_CELLS 4 /* least number of cells per standard deviation */

struct kd_beam_grid {
    uint32_t cell; /* pixels along the side of a cell; 0: there is no beam, or it is too narrow to be visible */
    /* size of the grid. If cells are larger than pixels, the grid has one more cell on each side of the picture */
    uint32_t columns, rows;
    /* number of rows of the picture. First each row of pixels has its own row of cells; these rows are then summed to
     * the rows of the grid */
    uint32_t height;
    double sigma;   /* standard deviation of the blur, in cells */
    uint32_t reach; /* radius of the blur, in cells: 5 sigma. Only 6e-7 of the weight lies beyond it */
};

/* The grid for a valid scene's picture. */
struct kd_beam_grid kd_beam_of(const struct kd_scene *scene);

/* kd_beam_lines_bytes: bytes of the rows of cells, one for each row of pixels. kd_beam_cells_bytes: bytes of one
 * grid. */
static inline uint64_t kd_beam_lines_bytes(const struct kd_beam_grid *beam)
{
    return 16ull * beam->columns * beam->height;
}
static inline uint64_t kd_beam_cells_bytes(const struct kd_beam_grid *beam)
{
    return 16ull * beam->columns * beam->rows;
}
/* Bytes of a plan's grids: two if cells are larger than pixels, otherwise one. */
static inline uint64_t kd_beam_grids_bytes(const struct kd_beam_grid *beam)
{
    return beam->cell > 1 ? (kd_beam_cells_bytes(beam) + 255) / 256 * 256 + kd_beam_cells_bytes(beam)
                          : kd_beam_cells_bytes(beam);
}

#endif
