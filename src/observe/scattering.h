/* Interstellar scattering towards Sagittarius A*: the factor by which the ensemble-average kernel multiplies a
 * visibility (D. Psaltis et al. 2018, arXiv:1805.01242; parameters of M. D. Johnson et al. 2018, ApJ 865, 104, for the
 * dipole model). Any thread.
 *
 *     V = V_source exp(-D(b/(1 + M))/2)
 *
 * Here b is the baseline. M is the distance of the screen from the observer divided by the distance of the screen from
 * the source. D is the phase structure function, which is ehtim's Dphi_exact: the mean of 4 C/alpha (1F1(-alpha/2; 1/2;
 * -(b cos)^2/(2 r_in)^2) - 1) over the directions of the wave vector. Refractive noise is not part of the kernel. */
#ifndef KD_OBSERVE_SCATTERING_H
#define KD_OBSERVE_SCATTERING_H

/* Number of directions in the mean, over half a turn. The integrand is periodic and smooth, so the relative error of
 * the mean is at most 1e-9 for baselines on Earth. */
enum { KD_SCATTERING_POINTS = 192 };

struct kd_scattering { double weight[KD_SCATTERING_POINTS], strength, wavelength_cm; };

void kd_scattering_sgra(struct kd_scattering *out, double frequency_hz);
/* Factor for a baseline. u, v: baseline in wavelengths, to the east and to the north. Takes some 0.03 ms. */
double kd_scattering_at(const struct kd_scattering *scattering, double u, double v);

#endif
