/* Illumination of a thin disk by a point source on the axis, tabulated at KD_LAMPPOST_RINGS radii. */
#ifndef KD_PHYSICS_DISK_LAMPPOST_H
#define KD_PHYSICS_DISK_LAMPPOST_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_LAMPPOST_RINGS = 120 };

struct kd_lamppost {
    double first, step; /* ln r of the first node, and the even step in ln r */
    double log_epsilon[KD_LAMPPOST_RINGS];
    double late[KD_LAMPPOST_RINGS]; /* coordinate time of the light from source to ring, minus r */
};

/* height: beyond the horizon. The table covers the radii from inner, which is the ISCO or larger, to outer. Returns
 * false if light does not reach a ring, which has not been observed. */
bool kd_lamppost_init(struct kd_lamppost *lamp, const struct kd_hole *hole, double height, double photon_index,
                      double inner, double outer);

/* Smallest height of a source, in radii of the horizon. */
#define KD_LAMPPOST_LEAST 1.05

double kd_lamppost_at(const struct kd_lamppost *lamp, double r);
/* Coordinate time that the light takes from the source to the ring at r. */
double kd_lamppost_time(const struct kd_lamppost *lamp, double r);

/* Radius at which light that leaves the source at delta meets the plane; 0: captured by the hole; INFINITY: it
 * escapes. */
double kd_lamppost_reach(const struct kd_hole *hole, double height, double delta);

#endif
