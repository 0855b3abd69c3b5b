/* The image of a thin disk next to edge-on, cut into columns of constant alpha and cells along beta. It has no table
 * (disk_image.h): each place of it is an exact ray. Double precision; any thread. G = c = M = 1.
 *
 * The disk is opaque and infinitely thin, from `inner` to `outer`; its plane is transparent beyond `outer` and dark
 * within `inner`. So a ray shows the upper face at its first crossing of the plane, or, past the outer edge, the lower
 * face at its second. At 90 degrees both faces appear edge on: their near sides have no width, and each shows its far
 * side, lifted by the hole's lensing, in one half of the image. */
#ifndef KD_PHYSICS_DISK_DISK_COLUMNS_H
#define KD_PHYSICS_DISK_DISK_COLUMNS_H

#include "physics/disk/disk_image.h"

/* A place of a column. order: 0 on the upper face, 1 on the lower face. */
struct kd_disk_end {
    double beta, r;
    int order;
};

/* A cell of a column about `alpha`, `width` times `length` large. end: one end, the middle and the other end, all on
 * one face; at an edge of the disk they are the same place. slope: dr/dalpha at one beta, in the middle. */
struct kd_disk_cell {
    double alpha, width, length, slope;
    struct kd_disk_end end[3];
};

struct kd_disk_columns {
    double inner, outer;
    double split; /* a radius at which cells end, or 0 */
    int columns;  /* in each of three parts of the image */
    double step;  /* largest change of ln r in a cell */
    void (*add)(void *user, const struct kd_disk_cell *cell);
    void *user;
};

/* Calls `add` for each cell. Ends early if the thread's pause (base/pause.h) asks for it. Returns false if an end of
 * the inner or of the outer ring is not found. */
bool kd_disk_columns(const struct kd_disk_image *image, const struct kd_disk_columns *columns);

#endif
