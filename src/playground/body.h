/* A body of the playground is a sphere with a mass. Plain values; any thread.
 *
 * Units: G = c = 1 and the hole's mass M = 1, so that lengths and times are in M, masses in masses of the hole,
 * speeds in c. Places are x, y, z with the hole at the origin and its axis along z.
 *
 * Whoever draws a body takes r, theta, phi of its x, y, z for Boyer-Lindquist r, theta, phi
 * (kd_playground_spherical). That is exact with gravity "kerr", which moves bodies in these coordinates. The
 * potential of Paczynski and Wiita has no metric behind it: its r, in which the horizon is 2 and the last stable
 * orbit 6 as in Schwarzschild's, is put in the place of Schwarzschild's, an approximation that is told. */
#ifndef KD_PLAYGROUND_BODY_H
#define KD_PLAYGROUND_BODY_H

#include <stdbool.h>
#include <stdint.h>

enum { KD_PLAYGROUND_NAME = 32 };
#define KD_PLAYGROUND_LEAST \
    1e-30 /* mass and radius of a body, if it has any: what follows from less would leave the range of numbers */

struct kd_playground_body {
    uint32_t id; /* from 1; never given twice */
    char name[KD_PLAYGROUND_NAME];
    double mass, radius, temperature_k;
    double x[3], v[3];
    /* A pass through the tides: mass and radius before it, the deepest r_t/r so far, the share of the mass that is
     * gone and that which an event has told (tide.h). whole_mass is 0 where no pass is under way. */
    double whole_mass, whole_radius, depth, shed, told;
    uint32_t source;    /* of its debris, by number; meaningful in a pass */
    double radiated;    /* energy that gravitational waves have taken from its motion */
    bool told_inspiral; /* an event has told that it is inside 6 M */
};

/* (r, theta, phi) of a place, phi from -pi to pi, and the components of a velocity along these directions. On the
 * axis phi is 0. */
struct kd_playground_spherical { double r, theta, phi, v[3]; };
struct kd_playground_spherical kd_playground_spherical(const double x[3], const double v[3]);

#endif
