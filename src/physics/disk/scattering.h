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

/* Degree of polarisation, parallel to the surface: (I_r - I_l)/(I_r + I_l), 0.11713 at mu = 0. */
static inline double kd_scattered_fraction(const struct kd_scattered *light)
{
    return (light->across - light->along) / (light->across + light->along);
}

#endif
