/* The self-test judges a device by these numbers. The numbers are in reference.c, made by
 * tests/oracle/selftest_reference.py: from the metric, by quadrature, by Taylor series in 38 digits; no formula of
 * src/ or shaders/ is in them.
 *
 * A gain is the sum of |x df/dx| over the spin, the inclination, the radius and the two coordinates of a ray, of r
 * and g in terms of their logarithms: how much a relative change of what is given changes the answer. */
#ifndef KD_RENDER_SELFTEST_REFERENCE_H
#define KD_RENDER_SELFTEST_REFERENCE_H

#include "physics/spacetime/observer.h"

#include <stddef.h>

struct kd_selftest_crossing { double r, phi, delay, g, r_gain, phi_gain, delay_gain, g_gain; };

struct kd_selftest_ray {
    const char *set;
    double spin, inclination_deg, radius, alpha, beta;
    int captured;
    double theta, phi, sky_gain; /* direction of escape, NaN if captured */
    int n_crossings;             /* radii of the crossings of orders 0 to 2 */
    struct kd_selftest_crossing crossing[3];
};

struct kd_selftest_orbit { double spin, horizon, photon, bound, isco, efficiency; };

/* The ray in the middle of a camera's picture. */
struct kd_selftest_camera {
    enum kd_observer observer; /* what falls is rain */
    double velocity[3];
    double yaw_deg, pitch_deg;
    struct kd_selftest_ray ray; /* its alpha, beta label the constants that the direction was found to have */
};

/* The azimuth that a ray in the equatorial plane sweeps from infinity to infinity; b = lambda. */
struct kd_selftest_deflection {
    const char *name;
    double spin, b, phi, gain;
};

/* A point of the critical curve: rays nearer to the origin are captured. */
struct kd_selftest_critical {
    const char *name;
    double spin, inclination_deg, alpha, beta;
};

/* An orbit between p/(1+e) and p/(1-e) that leaves the plane by the angle whose cosine is x: constants of motion,
 * and how fast it goes through its radial and polar cycles, azimuth, time and proper time in Mino time. */
struct kd_selftest_bound {
    double spin, p, e, x, energy, momentum, carter, mino_r, mino_theta, mino_phi, mino_t, mino_proper;
};

struct kd_selftest_flux { double spin, r, flux; };

/* Brightness g^4 F / F_max where ray number `ray` first meets the disk. */
struct kd_selftest_pixel {
    int ray;
    double brightness;
};

/* A grey: linear, encoded as sRGB, and by way of the film-like curve. */
struct kd_selftest_grey { double linear, srgb, film[3]; };

struct kd_selftest_reference {
    struct kd_selftest_orbit orbits[8];
    struct kd_selftest_ray rays[32];
    struct kd_selftest_camera cameras[8];
    struct kd_selftest_deflection deflections[8];
    struct kd_selftest_critical criticals[8];
    struct kd_selftest_bound bounds[8];
    struct kd_selftest_flux fluxes[16];
    struct kd_selftest_pixel pixels[16];
    struct kd_selftest_grey greys[16];
    size_t n_orbits, n_rays, n_cameras, n_deflections, n_criticals, n_bounds, n_fluxes, n_pixels, n_greys;
};

extern const struct kd_selftest_reference kd_selftest_reference;

#endif
