/* Says which rays of the rim (rim.h) are followed: those of some grids, next to one another, each so fine that
 * the sky goes by KD_RIM_STEP at most from ray to ray. Next to the equator of a fast hole it goes by hundreds of
 * times as far as elsewhere, on the way to the critical curve as well as along it. What is out of the picture, or
 * where the brightest star would not be seen, has none.
 *
 * A grid has the images of its own part of the rim, a rectangle of turns and logarithms; next to its borders, to
 * neighbours as well as to none, it shares them: its share is that of a rectangle of the size of 2 * KD_RIM_SHARED_U
 * and 2 * KD_RIM_SHARED_L about an image's place that lies within its part. So all shares add up to 1. Double
 * precision; pure, any thread. */
#ifndef KD_RENDER_VIEW_RIM_GRID_H
#define KD_RENDER_VIEW_RIM_GRID_H

#include "render/view/rim.h"

#define KD_RIM_STEP 0.1      /* rad */
#define KD_RIM_STEP_MOST 0.3 /* where there would be more than KD_RIM_RAYS otherwise */
#define KD_RIM_RAYS \
    (1u << 19)           /* at most, of all grids; where that is not enough either, only brighter images have any */
#define KD_RIM_GRIDS 192 /* at most */
#define KD_RIM_GRID_RAYS (1u << 16) /* at most, of one */
#define KD_RIM_HALO 3               /* rays beyond the part, on each side */
#define KD_RIM_SHARED_U 0.5
#define KD_RIM_SHARED_L 0.05

/* Ray (x, y) is at the turn u + x du and the logarithm l - y dl. */
struct kd_rim_grid {
    double u, du, l, dl;
    uint32_t columns, rows;
    double low_u, high_u, low_l, high_l; /* its part: from low_u up to high_u, from low_l up to high_l; the last ones
                                            down to -INFINITY, the first ones up to INFINITY */
    uint32_t first, table;               /* numbers of the buffer: that its rays begin at, that its table begins at */
};

struct kd_rim_grids {
    uint32_t n, rays;
    uint32_t numbers; /* that the buffer holds */
    double step;      /* rad */
    double faintest;  /* sr: that a pixel of them shows, at most, on an average about a place */
    struct kd_rim_grid of[KD_RIM_GRIDS];
};

/* None where there is no rim, or none of it is seen. Some 3 to 15 ms. */
void kd_rim_grids_of(const struct kd_scene *scene, const struct kd_rim *rim, struct kd_rim_grids *out);

/* Whether there would be too many rays even KD_RIM_STEP_MOST apart: then images are left out that are brighter than
 * elsewhere. Some 5 ms of a fast hole, none of others. */
bool kd_rim_is_thinned(const struct kd_scene *scene, const struct kd_rim *rim);

/* What a pixel may show of the sky, sr, and Sirius still be seen there, and some more, as that varies. */
#define KD_RIM_FAINTEST (3.3 * KD_RIM_BRIGHTEST / KD_STAR_LEAST)

/* The buffer holds the rim's edges, KD_RIM_EDGES numbers, then of each grid where its rays come from (rim_sky.h),
 * three planes of numbers, and its table: KD_RIM_TABLE numbers, which say where its part is, in its own columns and
 * rows, and of each column the curve's point, x and y, and how that goes by with the column. A grid begins where a
 * buffer may be bound. */
#define KD_RIM_TABLE 6
#define KD_RIM_ALIGN 64u
static inline uint32_t kd_rim_grid_rays(const struct kd_rim_grid *grid) { return grid->columns * grid->rows; }
static inline uint64_t kd_rim_bytes_most(void)
{
    return 4ull * (3ull * KD_RIM_RAYS + KD_RIM_GRIDS * (2 * KD_RIM_ALIGN + KD_RIM_TABLE) + KD_RIM_EDGES +
                   4ull * KD_RIM_RAYS / 8);
}

#endif
