/* Polarisation of light from a deep atmosphere of free electrons with a source far below (Milne's problem for
 * Thomson scattering), as a function of the angle of emergence. S. Chandrasekhar, Radiative Transfer (1960),
 * sections 67 and 68, table XXIV. Pure functions, any thread. */
#ifndef KD_PHYSICS_DISK_SCATTERING_H
#define KD_PHYSICS_DISK_SCATTERING_H

#include <stddef.h>

/* Emergent intensity at the cosine mu to the normal, over the mean flux: (I_r, I_l)/F. across, along: polarised across
 * and along the plane of normal and light. */
struct kd_scattered { double across, along; };

/* Fills `out` for n cosines from 0 to 1. Takes some milliseconds, plus microseconds for each. */
void kd_scattered_light(const double *mu, size_t n, struct kd_scattered *out);

/* Functions of the law of diffuse reflection by the same atmosphere (section 70): psi, phi, chi, zeta of the part that
 * is independent of azimuth, and H of the parts in the first and second multiple of the azimuth. */
struct kd_scattering_functions { double psi, phi, chi, zeta, first, second; };
void kd_scattering_functions(const double *mu, size_t n, struct kd_scattering_functions *out);

/* Light of one direction that this atmosphere reflects. Bases of the polarisation are l, in the plane of normal and
 * ray, and r across it, with l x r along the ray and l pointing to lower cosines; I_l + I_r is the intensity, U that at
 * 45 degrees from l towards r. light: I_l, I_r, U times the solid angle, from the cosine mu0 to the normal; out: by the
 * difference of azimuths of the directions of propagation, out minus in, as series of 1, cos, sin, cos 2x, sin 2x of
 * it. */
struct kd_reflected_stokes { double l[5], r[5], u[5]; };
void kd_scattering_reflect(const struct kd_scattering_functions *out_at, double mu,
                           const struct kd_scattering_functions *in_at, double mu0, const double light[3],
                           struct kd_reflected_stokes *out);

/* Degree of polarisation, parallel to the surface: (I_r - I_l)/(I_r + I_l), 0.11713 at mu = 0. */
static inline double kd_scattered_fraction(const struct kd_scattered *light)
{
    return (light->across - light->along) / (light->across + light->along);
}

#endif
