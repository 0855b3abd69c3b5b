/* The polarisation of light from a deep atmosphere of free electrons whose source lies far below (Milne's problem for
 * Thomson scattering), by the angle at which it emerges. S. Chandrasekhar, Radiative Transfer (1960), sections 67 and
 * 68, table XXIV. Pure functions, any thread. */
#ifndef KD_PHYSICS_DISK_SCATTERING_H
#define KD_PHYSICS_DISK_SCATTERING_H

#include <stddef.h>

/* What comes out at the cosine mu to the normal: intensity across the plane of normal and light, and along it, over
 * the mean flux: (I_r, I_l)/F. */
struct kd_scattered { double across, along; };

/* Fill `out` for n cosines from 0 to 1. Microseconds for each, and some milliseconds. */
void kd_scattered_light(const double *mu, size_t n, struct kd_scattered *out);

/* The part of the light that is polarised, along the surface: (I_r - I_l)/(I_r + I_l), 0.11713 at mu = 0. */
static inline double kd_scattered_fraction(const struct kd_scattered *light)
{
    return (light->across - light->along) / (light->across + light->along);
}

#endif
