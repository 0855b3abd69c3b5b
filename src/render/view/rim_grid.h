/* Chooses the rays of the rim (rim.h). They are on several adjacent grids. Each grid is so fine that the sky shifts by
 * at most KD_RIM_STEP from ray to ray. Next to the equator of a fast hole the sky shifts hundreds of times as fast as
 * elsewhere, both towards the critical curve and along it. No rays are spent outside the picture, or where even the
 * brightest star would not be seen.
 *
 * A grid owns the images in its part of the rim, a rectangle in the coordinates u and l. Grids share an image near
 * their border. A rectangle of 2 * KD_RIM_SHARED_U by 2 * KD_RIM_SHARED_L is centred on the image. A grid's share is
 * the fraction of this rectangle within the grid's part. Thus all shares add up to 1. Double precision; pure, any
 * thread. */
#ifndef KD_RENDER_VIEW_RIM_GRID_H
#define KD_RENDER_VIEW_RIM_GRID_H

#include "render/view/rim.h"

#define KD_RIM_STEP 0.1      /* rad */
#define KD_RIM_STEP_MOST 0.3 /* step that is used if KD_RIM_STEP would take more than KD_RIM_RAYS rays */
/* limit of rays in all grids together; if even KD_RIM_STEP_MOST needs more rays, only brighter images are searched */
#define KD_RIM_RAYS (1u << 19)
#define KD_RIM_GRIDS 192            /* largest number of grids */
#define KD_RIM_GRID_RAYS (1u << 16) /* limit of rays of one grid */
#define KD_RIM_TILE_RAYS 3          /* side of a tile of the star search on a grid */
#define KD_RIM_HALO 3               /* number of extra rays on each side of the part */
/* largest distance, in steps, from a ray to an image that it finds (star_images.comp, share) */
#define KD_RIM_REACH 0.601
#define KD_RIM_SHARED_U 0.5
#define KD_RIM_SHARED_L 0.05

/* A range of columns or rows. */
struct kd_rim_span { uint32_t first, end; };

/* One grid. Ray (x, y) is at the turn u + x du and the logarithm l - y dl. */
struct kd_rim_grid {
    double u, du, l, dl;
    uint32_t columns, rows;
    /* the part of the rim that belongs to the grid, from low to high; infinite at the outermost and innermost
     * borders */
    double low_u, high_u, low_l, high_l;
    /* columns and rows in which images are searched; all, unless kd_rim_grids_keep set them. x[1] may be empty. */
    struct kd_rim_span x[2], y;
    uint32_t first, table; /* offsets of the grid's rays and of its table in the buffer, counted in numbers */
};

struct kd_rim_grids {
    uint32_t n, rays;
    uint32_t numbers; /* size of the buffer, in numbers */
    double step;      /* rad */
    /* largest solid angle of the sky, in sr, that a pixel of the grids shows, averaged around a place */
    double faintest;
    struct kd_rim_grid of[KD_RIM_GRIDS];
};

/* Makes the grids; n is 0 if there is no rim or no part of it is seen. Takes 3 to 15 ms. */
void kd_rim_grids_of(const struct kd_scene *scene, const struct kd_rim *rim, struct kd_rim_grids *out);

/* Keeps the grids whose images may light pixels of the scene's tile, and drops the others. In the grids that remain,
 * only those columns and rows are searched whose images may light the tile. The tile's light stays the same to the
 * bit. */
void kd_rim_grids_keep(const struct kd_scene *scene, const struct kd_rim *rim, struct kd_rim_grids *grids);

/* True if even KD_RIM_STEP_MOST takes too many rays, so that fainter images are left out. Takes about 5 ms for a hole
 * that spins fast, and no time for any other. */
bool kd_rim_is_thinned(const struct kd_scene *scene, const struct kd_rim *rim);

/* Largest solid angle of the sky, sr, that a pixel may show with Sirius still visible. It has some margin, because the
 * brightness varies. */
#define KD_RIM_FAINTEST (3.3 * KD_RIM_BRIGHTEST / KD_STAR_LEAST)

/* Layout of the buffer: the rim's edges (KD_RIM_EDGES numbers), then for each grid the directions of its rays
 * (rim_sky.h), three planes of numbers, and its table. A table has KD_RIM_TABLE numbers for the borders of the grid's
 * part, in the grid's columns and rows. Then it has, for each column, the curve's point x, y and the derivative of that
 * point by column. A grid begins at an offset where a buffer may be bound. */
#define KD_RIM_TABLE 6
#define KD_RIM_ALIGN 64u
static inline uint32_t kd_rim_grid_rays(const struct kd_rim_grid *grid) { return grid->columns * grid->rows; }
static inline uint64_t kd_rim_bytes_most(void)
{
    return 4ull * (3ull * KD_RIM_RAYS + KD_RIM_GRIDS * (2 * KD_RIM_ALIGN + KD_RIM_TABLE) + KD_RIM_EDGES +
                   4ull * KD_RIM_RAYS / 8);
}

#endif
