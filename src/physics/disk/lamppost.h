/* Illumination of a thin disk by a point source on the axis, tabulated at KD_LAMPPOST_RINGS radii. */
#ifndef KD_PHYSICS_DISK_LAMPPOST_H
#define KD_PHYSICS_DISK_LAMPPOST_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_LAMPPOST_RINGS = 120 };

struct kd_lamppost {
    double first, step; /* ln r of the first node; step in ln r between nodes */
    double log_epsilon[KD_LAMPPOST_RINGS];
    double late[KD_LAMPPOST_RINGS]; /* coordinate time that light takes from the source to each ring, minus r */
};

/* Makes the table for radii from inner, which is the ISCO or larger, to outer. height: height of the source, which must
 * be beyond the horizon. Returns false if light does not reach a ring. No such case is known. */
bool kd_lamppost_init(struct kd_lamppost *lamp, const struct kd_hole *hole, double height, double photon_index,
                      double inner, double outer);

/* Smallest height of a source, in radii of the horizon. */
#define KD_LAMPPOST_LEAST 1.05

double kd_lamppost_at(const struct kd_lamppost *lamp, double r);
/* Coordinate time that the light takes from the source to the ring at r. */
double kd_lamppost_time(const struct kd_lamppost *lamp, double r);

/* Radius at which light that leaves the source at the angle delta meets the plane; 0 if the hole captures it, INFINITY
 * if it escapes. */
double kd_lamppost_reach(const struct kd_hole *hole, double height, double delta);

#endif
