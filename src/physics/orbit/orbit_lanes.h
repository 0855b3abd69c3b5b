/* Follows eight paths side by side in SIMD lanes, for lists of orbits. The results are the same, bit for bit, as those
 * of eight scalar paths. Eight scalar paths take several times as long, because in a single path each sum must wait for
 * the sum before it. Any thread. */
#ifndef KD_PHYSICS_ORBIT_ORBIT_LANES_H
#define KD_PHYSICS_ORBIT_ORBIT_LANES_H

#include "physics/orbit/orbit_path.h"

#define KD_ORBIT_LANES 8

struct kd_orbit_lanes {
    struct kd_orbit_path *path[KD_ORBIT_LANES]; /* the paths, which must all be different */
    double h[KD_ORBIT_LANES];
    /* number of steps of each path; a path with 0 steps is not moved, but its pointer must be set */
    uint64_t steps[KD_ORBIT_LANES];
    /* For each path: memory for the largest absolute drifts after any step. If all pointers are NULL, drifts are not
     * computed. */
    struct kd_orbit_drift *worst[KD_ORBIT_LANES];
    /* Function that is called after a step in which w of a lane stopped growing; may be NULL. The lane's path is up to
     * date during the call. */
    void (*periastron)(void *user, int lane);
    void *user;
};

/* True if a path can be one of the lanes: it is bound, uses Yoshida's method, and has L != 0. */
bool kd_orbit_lanes_take(const struct kd_orbit_path *path);

void kd_orbit_lanes_run(struct kd_orbit_lanes *lanes);

#endif
