/* Follows eight paths side by side, for lists of orbits: it gives the numbers of eight scalar paths to the last
 * bit, several times as fast, since one path waits for its own sums most of the time. Any thread. */
#ifndef KD_PHYSICS_ORBIT_ORBIT_LANES_H
#define KD_PHYSICS_ORBIT_ORBIT_LANES_H

#include "physics/orbit/orbit_path.h"

#define KD_ORBIT_LANES 8

struct kd_orbit_lanes {
    struct kd_orbit_path *path[KD_ORBIT_LANES]; /* all of them different */
    double h[KD_ORBIT_LANES];
    uint64_t steps[KD_ORBIT_LANES]; /* each its own number; 0: not this one, but its path must be there */
    struct kd_orbit_drift
        *worst[KD_ORBIT_LANES]; /* after each step the greatest absolute values go there; all NULL: nobody looks */
    /* After a step in which w ceased to grow, with the path up to date; may be NULL. */
    void (*periastron)(void *user, int lane);
    void *user;
};

/* Whether a path can be one of eight: bound, by Yoshida's method, with L != 0. */
bool kd_orbit_lanes_take(const struct kd_orbit_path *path);

void kd_orbit_lanes_run(struct kd_orbit_lanes *lanes);

#endif
