/* The disk as particles. Each particle has a guiding orbit, an azimuth, and small epicycles in r and theta. The guiding
 * orbits are `radii` circular ones with equal numbers of particles. All of this follows from a hash of the particle's
 * number and the seed; nothing is stored. The particles with the lowest numbers fall from the ISCO instead
 * (render/emit/plunging.h). Each then starts again at another azimuth, a hash of its number and the count of its falls.
 * The position at any time t is a closed form. Angular frequencies are in double. The phases at t reach the device as
 * 32-bit fractions of a turn. Sums of such phases wrap exactly, so t may be arbitrarily large.
 *
 * The rows of the grid are steps of log r from edge to edge. The columns are steps of azimuth. At a node, the light of
 * the smooth disk is multiplied by the ratio of the counted number of particles to the expected number. Falling
 * particles have a grid of their own, over phase and azimuth at the ISCO.
 *
 * To first order in the amplitude (J. Binney & S. Tremaine, Galactic Dynamics, section 3.2.3, with the frequencies of
 * Kerr),
 *
 *   ln r = ln r0 + (A/r0) cos(kappa t + psi),  phi = phi0 + Omega t + (dOmega/dr) (A/kappa) sin(kappa t + psi)
 *   latitude = I cos(Omega_theta t + psi'),    A = disk.epicycles u r0 (kappa/Omega)^2,  I = disk.epicycles u'
 *
 * with u and u' in [0, 1], and dOmega/dr at constant E and L, so that nothing diverges at the ISCO, where kappa ->
 * 0, and r - r_isco never changes sign. Pure; the device's part is render/emit/deposit.h. */
#ifndef KD_RENDER_EMIT_PARTICLES_H
#define KD_RENDER_EMIT_PARTICLES_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_particles_push; /* push constants of particles.comp: render/view/layout.h */

/* least number of guiding orbits, unless there are fewer particles; a row of the default grid then has 35 orbits */
#define KD_PARTICLE_RADII 4096u
/* largest number of orbits. So many are used if there are many rows or if some rows are nearly empty */
#define KD_PARTICLE_RADII_MAX 65536u
#define KD_PARTICLE_ROWS 4096u

struct kd_particle_grid {
    uint32_t count; /* number of particles; 0: the disk is smooth */
    uint32_t radii;
    uint32_t rows, columns;               /* number of intervals along each axis; columns is a power of 2 */
    uint32_t plunging;                    /* number of falling particles; 0: they have no grid */
    uint32_t plunge_rows, plunge_columns; /* size of the falling particles' grid */
    /* lap_rows: rows from the start of the plunge to its end; lead_rows: rows before the start, for slow light */
    uint32_t lap_rows, lead_rows;
    uint32_t unit;  /* weight of one particle, chosen so that a node fits in 16 bits */
    uint64_t bytes; /* size of all buffers on the device */
};
/* The grid of a valid scene; its cells are about square, with a handful of particles in each. */
struct kd_particle_grid kd_particle_grid(const struct kd_scene *scene);

/* Guiding orbit of a particle that does not fall. Orbits are in order of radius and have equal numbers of particles,
 * except for rounding. */
uint32_t kd_particle_guide(const struct kd_particle_grid *grid, uint32_t particle);

/* The guiding radius inside which a fraction q of the particles lies. */
double kd_particle_radius(const struct kd_scene *scene, double q);

/* Guiding orbit k: its radius, angular frequencies in rad/M, and the largest amplitudes of its epicycles in ln r and in
 * phi, radians. */
struct kd_particle_orbit { double r, omega, kappa, vertical, swing_r, swing_phi; };
struct kd_particle_orbit kd_particle_orbit(const struct kd_scene *scene, uint32_t radii, uint32_t k);

/* A particle's epicycles: fractions of the largest amplitudes, and phases at time 0 in radians. */
struct kd_particle_swing { double radial, radial_phase, vertical, vertical_phase; };
struct kd_particle_swing kd_particle_swing(const struct kd_scene *scene, uint32_t particle);

/* Mean optical depth of the plunging gas where r |u^r| is 1, in a scene that has such gas. A particle has the same
 * opacity inside and outside the ISCO. So the optical depth is proportional to the surface density of the gas in its
 * own frame. It is normalised to the optical depth of the disk just outside the ISCO. */
double kd_particle_plunge_depth(const struct kd_scene *scene);

/* The grid is computed for a time before scene->top.time; returns the difference. With slow light and a camera at a
 * finite radius it is camera.r. This is about the delay of the light, so that the remaining delay is short. Otherwise
 * it is 0. */
double kd_particle_delay(const struct kd_scene *scene);

/* A particle's position: Boyer-Lindquist r in M, phi in units of 2^-32 turn, latitude in radians. */
struct kd_particle_place {
    float r;
    uint32_t phi;
    float latitude;
    /* true if the particle falls with the ISCO's energy and angular momentum; false: it is on a guiding orbit */
    bool plunging;
};

/* Sizes of the kernel's buffers. One buffer has the guiding orbits, followed by the expected numbers for the rows of
 * both grids. The other buffer has both grids in 32-bit words. */
#define KD_PARTICLE_EXPECTED_BYTES (4 * (KD_PARTICLE_ROWS + 64))
uint64_t kd_particle_guides_bytes(const struct kd_particle_grid *grid);
uint64_t kd_particle_tables_bytes(const struct kd_particle_grid *grid);
void kd_particle_tables_fill(void *out, const struct kd_scene *scene, const struct kd_particle_grid *grid, double time);
uint64_t kd_particle_words(const struct kd_particle_grid *grid);
uint64_t kd_particle_plunge_words(const struct kd_particle_grid *grid);
struct kd_particles_push kd_particle_push(const struct kd_scene *scene, const struct kd_particle_grid *grid,
                                          double time);

/* The device's result for a listed particle: a row of the grid, or the phase of a plunge in units of 2^-32; azimuth;
 * latitude. */
struct kd_particle_listed {
    union {
        float row;
        uint32_t phase;
    };
    uint32_t phi;
    float latitude;
};

/* Converts the listed particles to the positions of n particles: first, first + stride, ... */
void kd_particle_places_of(const struct kd_scene *scene, const struct kd_particle_grid *grid,
                           const struct kd_particle_listed *got, uint32_t first, uint32_t stride, size_t n,
                           struct kd_particle_place *out);

#endif
