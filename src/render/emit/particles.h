/* The disk may be made of particles. Each has a guiding orbit, one of `radii` circular ones that hold equal shares
 * of the particles, an azimuth, and small epicycles in r and theta, all from a hash of its number and the seed:
 * nothing is stored. A share of them, those with the lowest numbers, falls from the ISCO instead
 * (render/emit/plunging.h), and begins anew at another azimuth, a hash of its number and of how often it has fallen.
 * Where it is at any time t is a closed form. Angular frequencies are known in double, and their phases at t reach
 * the device as 32-bit fractions of a turn, whose sums wrap exactly: no t is too late.
 *
 * Rows of the grid are steps of log r from edge to edge, columns of azimuth. The number found at a node over the
 * number expected there multiplies the light of the smooth disk. Those that fall have a grid of their own, of phases
 * and of azimuths at the ISCO.
 *
 * To first order in the amplitude (J. Binney & S. Tremaine, Galactic Dynamics, section 3.2.3, with the frequencies
 * of Kerr),
 *
 *   ln r = ln r0 + (A/r0) cos(kappa t + psi),  phi = phi0 + Omega t + (dOmega/dr) (A/kappa) sin(kappa t + psi)
 *   latitude = I cos(Omega_theta t + psi'),    A = disk.epicycles u r0 (kappa/Omega)^2,  I = disk.epicycles u',  u,
 *                                              u' in [0, 1]
 *
 * with dOmega/dr at constant E and L, so that nothing diverges where kappa -> 0, at the ISCO, and r - r_isco never
 * changes sign. Pure; the device's part is render/emit/deposit.h. */
#ifndef KD_RENDER_EMIT_PARTICLES_H
#define KD_RENDER_EMIT_PARTICLES_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_particles_push; /* of particles.comp: render/view/layout.h */

#define KD_PARTICLE_RADII 4096u      /* if there are as many particles; 35 to a row of the default grid */
#define KD_PARTICLE_RADII_MAX 65536u /* where rows are many, or some of them nearly empty */
#define KD_PARTICLE_ROWS 4096u

struct kd_particle_grid {
    uint32_t count; /* of particles; 0: the disk is smooth */
    uint32_t radii;
    uint32_t rows, columns;               /* intervals; columns a power of 2 */
    uint32_t plunging;                    /* of the particles; 0: there is no grid for them */
    uint32_t plunge_rows, plunge_columns; /* the same of that grid */
    uint32_t lap_rows, lead_rows; /* from the start of the plunge to its end; before the start, for slow light */
    uint32_t unit;                /* weight of one particle: what a node can hold is 16 bits */
    uint64_t bytes;               /* on the device */
};
/* The grid of a valid scene has cells that are about square, a handful of particles in each. */
struct kd_particle_grid kd_particle_grid(const struct kd_scene *scene);

/* Says which guiding orbit a particle has that does not fall: in order of radius, equal shares but for rounding. */
uint32_t kd_particle_guide(const struct kd_particle_grid *grid, uint32_t particle);

/* Finds the guiding radius inside which there is the share q of the particles. */
double kd_particle_radius(const struct kd_scene *scene, double q);

/* Computes the guiding orbit of a radius k: its radius, angular frequencies in rad/M, and the largest swings: of ln
 * r; of phi in radians. */
struct kd_particle_orbit { double r, omega, kappa, vertical, swing_r, swing_phi; };
struct kd_particle_orbit kd_particle_orbit(const struct kd_scene *scene, uint32_t radii, uint32_t k);

/* A particle's epicycles have shares of the largest swings, and phases at time 0 in radians. */
struct kd_particle_swing { double radial, radial_phase, vertical, vertical_phase; };
struct kd_particle_swing kd_particle_swing(const struct kd_scene *scene, uint32_t particle);

/* Computes the optical depth of the plunging gas in the mean where r |u^r| is 1, in a scene that has any: that of
 * its surface density, in its own frame, over the disk's just outside the ISCO. A particle counts as much inside as
 * outside. */
double kd_particle_plunge_depth(const struct kd_scene *scene);

/* Says how long before scene->top.time the grid is: about the delay of light from a near camera, so that what is
 * left is short. */
double kd_particle_delay(const struct kd_scene *scene);

/* A particle's place is Boyer-Lindquist r in M and phi in turns of 2^32, latitude in radians. */
struct kd_particle_place {
    float r;
    uint32_t phi;
    float latitude;
    bool plunging; /* with the ISCO's energy and angular momentum; else round a guiding orbit */
};

/* The kernel needs tables: orbits of the guides, and behind them what the rows of both grids expect; and grids in
 * words of 32 bits. */
#define KD_PARTICLE_EXPECTED_BYTES (4 * (KD_PARTICLE_ROWS + 64))
uint64_t kd_particle_guides_bytes(const struct kd_particle_grid *grid);
uint64_t kd_particle_tables_bytes(const struct kd_particle_grid *grid);
void kd_particle_tables_fill(void *out, const struct kd_scene *scene, const struct kd_particle_grid *grid, double time);
uint64_t kd_particle_words(const struct kd_particle_grid *grid);
uint64_t kd_particle_plunge_words(const struct kd_particle_grid *grid);
struct kd_particles_push kd_particle_push(const struct kd_scene *scene, const struct kd_particle_grid *grid,
                                          double time);

/* For a list the device gives a row, or the phase of a plunge in turns of 2^32; an azimuth; a latitude. */
struct kd_particle_listed {
    union {
        float row;
        uint32_t phase;
    };
    uint32_t phi;
    float latitude;
};

/* Makes places of that, of the particles first, first + stride, ..., n of them. */
void kd_particle_places_of(const struct kd_scene *scene, const struct kd_particle_grid *grid,
                           const struct kd_particle_listed *got, uint32_t first, uint32_t stride, size_t n,
                           struct kd_particle_place *out);

#endif
