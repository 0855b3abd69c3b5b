/* These numbers of synchrotron light are the same everywhere in a picture: the kernels have the rest (shaders/emit/synchrotron.glsl). Pure, any thread. */
#ifndef KD_PHYSICS_SYNCHROTRON_H
#define KD_PHYSICS_SYNCHROTRON_H

/* The kernels' units: e^2/c cm^-3 GHz (e in Gaussian units) of emissivity, W m^-3 Hz^-1 sr^-1, and that over 2h GHz^3/c^2 of absorptivity, 1/m. */
double kd_synchrotron_light_unit(void);
double kd_synchrotron_depth_unit(void);

/* Electrons whose number goes as gamma^-p from gamma_min to gamma_max shine with j = light nu_c sin(theta) (nu/(nu_c sin(theta)))^(-(p - 1)/2) and take away
 * alpha = depth (nu/(nu_c sin(theta)))^(-(p + 2)/2)/nu, in those units for n in cm^-3 and nu, nu_c in GHz (A. Pandya et al. 2016, ApJ 822, 34,
 * equations 33 and 34). p above 1. */
struct kd_synchrotron_power { double log2_light, log2_depth; };
struct kd_synchrotron_power kd_synchrotron_power(double p, double gamma_min, double gamma_max);

#endif
