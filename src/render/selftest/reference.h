/* Reference numbers of the self-test. They are in reference.c. tests/oracle/selftest_reference.py makes that file from
 * the metric, by quadrature and by Taylor series in 38 digits, without any formula of src/ or shaders/.
 *
 * A gain is the change of an answer f for a relative change of the input. It is the sum of |x df/dx| over the spin, the
 * inclination, the radius and the two coordinates of a ray. For r and g, f is the logarithm. */
#ifndef KD_RENDER_SELFTEST_REFERENCE_H
#define KD_RENDER_SELFTEST_REFERENCE_H

#include "physics/spacetime/observer.h"

#include <stddef.h>

struct kd_selftest_crossing { double r, phi, delay, g, r_gain, phi_gain, delay_gain, g_gain; };

struct kd_selftest_ray {
    const char *set;
    double spin, inclination_deg, radius, alpha, beta;
    int captured;
    double theta, phi, sky_gain; /* direction of escape, NAN if captured */
    int n_crossings;             /* number of crossings of orders 0 to 2 */
    struct kd_selftest_crossing crossing[3];
    KD_HOLE_MORE_MEMBERS
};

struct kd_selftest_orbit { double spin, horizon, photon, bound, isco, efficiency; };

/* The ray in the middle of a camera's picture. */
struct kd_selftest_camera {
    enum kd_observer observer; /* a falling observer starts from rest at infinity ("rain") */
    double velocity[3];
    double yaw_deg, pitch_deg;
    struct kd_selftest_ray ray; /* alpha and beta stand for the constants of motion of the camera's middle ray */
};

/* Azimuth swept by a ray in the equatorial plane from infinity to infinity; b = lambda. */
struct kd_selftest_deflection {
    const char *name;
    double spin, b, phi, gain;
};

/* A point of the critical curve: rays closer to the origin are captured. */
struct kd_selftest_critical {
    const char *name;
    double spin, inclination_deg, alpha, beta;
};

/* A bound orbit between p/(1+e) and p/(1-e) whose inclination to the plane has the cosine x. Members: its constants
 * of motion, and its rates in Mino time, namely those of the radial and polar cycles, of azimuth, of time and of
 * proper time. */
struct kd_selftest_bound {
    double spin, p, e, x, energy, momentum, carter, mino_r, mino_theta, mino_phi, mino_t, mino_proper;
};

struct kd_selftest_flux { double spin, r, flux; };

/* Brightness g^4 F / F_max at the first crossing of ray number `ray` with the disk. */
struct kd_selftest_pixel {
    int ray;
    double brightness;
};

/* A grey in three encodings: linear, as sRGB, and as sRGB after the film-like curve. */
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
