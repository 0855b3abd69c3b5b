/* Polarisation of light from a deep atmosphere of free electrons with a source far below (Milne's problem for Thomson
 * scattering), as a function of the angle of emergence (S. Chandrasekhar, Radiative Transfer, 1960, sections 67 and 68,
 * table XXIV). Pure functions, any thread. */
#ifndef KD_PHYSICS_DISK_SCATTERING_H
#define KD_PHYSICS_DISK_SCATTERING_H

#include <stddef.h>

/* Emergent intensity at the cosine mu to the normal, divided by the mean flux F. across: I_r/F, for light polarised
 * across the plane of normal and light. along: I_l/F, for light polarised along this plane. */
struct kd_scattered { double across, along; };

/* Fills `out` for n cosines mu from 0 to 1. Takes some milliseconds, plus some microseconds for each cosine. */
void kd_scattered_light(const double *mu, size_t n, struct kd_scattered *out);

/* Functions of mu in Chandrasekhar's law of diffuse reflection (section 70), for the same atmosphere. psi, phi, chi and
 * zeta describe the term that is independent of azimuth. first and second are H(mu) of the terms in the azimuth and in
 * twice the azimuth. */
struct kd_scattering_functions { double psi, phi, chi, zeta, first, second; };
void kd_scattering_functions(const double *mu, size_t n, struct kd_scattering_functions *out);

/* Reflects light that arrives at the cosine mu0 to the normal and leaves at the cosine mu. Polarisation refers to two
 * directions: l in the plane of normal and ray, and r across this plane. l x r points along the ray, and l points to
 * lower cosines. The intensity is I_l + I_r. U is positive at 45 degrees from l towards r.
 *
 * light: I_l, I_r and U of the light that arrives, times its solid angle.
 * out: I_l, I_r and U of the light that leaves, each as a series in 1, cos x, sin x, cos 2x, sin 2x. Here x is the
 * azimuth of the outgoing direction of propagation minus the azimuth of the incoming one. */
struct kd_reflected_stokes { double l[5], r[5], u[5]; };
void kd_scattering_reflect(const struct kd_scattering_functions *out_at, double mu,
                           const struct kd_scattering_functions *in_at, double mu0, const double light[3],
                           struct kd_reflected_stokes *out);

/* Degree of polarisation, parallel to the surface: (I_r - I_l)/(I_r + I_l). It is 0.11713 at mu = 0. */
static inline double kd_scattered_fraction(const struct kd_scattered *light)
{
    return (light->across - light->along) / (light->across + light->along);
}

#endif
