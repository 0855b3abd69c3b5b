/* The image of a thin disk next to edge-on, cut into columns of constant alpha and cells along beta. There is no table
 * as in disk_image.h: an exact ray is traced for each place. Double precision; any thread. G = c = M = 1.
 *
 * The disk is opaque and infinitely thin, from `inner` to `outer`. Its plane is transparent beyond `outer` and dark
 * within `inner`. A ray therefore shows the upper face if its first crossing of the plane is on the disk. If that
 * crossing is beyond the outer edge, the ray may show the lower face at its second crossing. At 90 degrees both faces
 * are seen edge on, and their near sides have no width. Each face shows its far side, lifted by the hole's lensing, in
 * one half of the image. */
#ifndef KD_PHYSICS_DISK_DISK_COLUMNS_H
#define KD_PHYSICS_DISK_DISK_COLUMNS_H

#include "physics/disk/disk_image.h"

/* A point of the disk at a place in a column. order: 0 on the upper face, 1 on the lower face. */
struct kd_disk_end {
    double beta, r;
    int order;
};

/* A cell of a column, with the middle at `alpha` and the sides `width` and `length`. end: the points at the first end,
 * in the middle and at the second end, all on one face. At an edge of the disk all three are the same point. slope:
 * dr/dalpha at constant beta, in the middle of the cell. */
struct kd_disk_cell {
    double alpha, width, length, slope;
    struct kd_disk_end end[3];
};

struct kd_disk_columns {
    double inner, outer;
    double split; /* a radius at which cells must end; 0 for no such radius */
    int columns;  /* number of columns in each of the three parts of the image */
    double step;  /* largest change of ln r within a cell */
    void (*add)(void *user, const struct kd_disk_cell *cell);
    void *user;
};

/* Calls `add` for each cell of the image. Stops early if the thread's pause flag is set (base/pause.h). Returns false
 * if an end of the inner ring or of the outer ring is not found. */
bool kd_disk_columns(const struct kd_disk_image *image, const struct kd_disk_columns *columns);

#endif
