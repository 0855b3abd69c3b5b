/* A body of the playground: a sphere with a mass. Plain values; any thread.
 *
 * Units: G = c = 1 and the hole's mass M = 1. So lengths and times are in M, masses in units of the hole's mass, and
 * speeds in c. Positions are x, y, z with the hole at the origin and its axis along z.
 *
 * Pictures use r, theta, phi of x, y, z as Boyer-Lindquist coordinates (kd_playground_spherical). That is exact with
 * gravity "kerr", which moves bodies in these coordinates. The potential of Paczynski and Wiita has no metric. Its
 * horizon is at 2 and its last stable orbit at 6, as in Schwarzschild's metric, so its r is used as the r of
 * Schwarzschild's metric. The list of approximations mentions this. */
#ifndef KD_PLAYGROUND_BODY_H
#define KD_PLAYGROUND_BODY_H

#include <stdbool.h>
#include <stdint.h>

enum { KD_PLAYGROUND_NAME = 32 };
#define KD_PLAYGROUND_LEAST \
    1e-30 /* smallest non-zero mass or radius of a body; quantities computed from smaller values would leave the range \
             of doubles */

struct kd_playground_body {
    uint32_t id; /* number of the body, from 1 on; never used again */
    char name[KD_PLAYGROUND_NAME];
    double mass, radius, temperature_k;
    double x[3], v[3];
    /* State of a tidal pass (tide.h). whole_mass, whole_radius: mass and radius of the body before the pass; whole_mass
     * is 0 outside a pass. depth: largest r_t/r so far. shed: fraction of the mass that is lost. told: fraction that
     * events have reported. */
    double whole_mass, whole_radius, depth, shed, told;
    uint32_t source;    /* number of the source of this body's debris; used only during a tidal pass */
    double radiated;    /* orbital energy that the body has lost to gravitational waves */
    bool told_inspiral; /* true if an event has reported that the body is inside 6 M */
};

/* Spherical coordinates of a position, with phi from -pi to pi, and components of the velocity along r, theta and phi.
 * On the axis phi is 0. */
struct kd_playground_spherical { double r, theta, phi, v[3]; };
struct kd_playground_spherical kd_playground_spherical(const double x[3], const double v[3]);

#endif
