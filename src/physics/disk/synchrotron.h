/* Constants of synchrotron emission that are the same for a whole picture; the kernels compute the rest
 * (shaders/emit/synchrotron.glsl). Pure, any thread. */
#ifndef KD_PHYSICS_DISK_SYNCHROTRON_H
#define KD_PHYSICS_DISK_SYNCHROTRON_H

/* kd_synchrotron_light_unit: the kernels' unit of emissivity, e^2/c cm^-3 GHz (e in Gaussian units), in W m^-3 Hz^-1
 * sr^-1. The next function: the kernels' unit of absorptivity in 1/m, which is the unit of emissivity divided by 2h
 * GHz^3/c^2. */
double kd_synchrotron_light_unit(void);
double kd_synchrotron_depth_unit(void);

/* Factors for electrons with a power law gamma^-p from gamma_min to gamma_max. They emit j = light nu_c sin(theta)
 * (nu/(nu_c sin(theta)))^(-(p - 1)/2) and absorb alpha = depth (nu/(nu_c sin(theta)))^(-(p + 2)/2)/nu, in the kernels'
 * units, for n in cm^-3 and nu, nu_c in GHz (A. Pandya et al. 2016, ApJ 822, 34, equations 33 and 34). p > 1. */
struct kd_synchrotron_power { double log2_light, log2_depth; };
struct kd_synchrotron_power kd_synchrotron_power(double p, double gamma_min, double gamma_max);

/* Constants for electrons of a kappa distribution of width w = Theta (kappa - 3)/kappa, with kappa > 3 (equations 35 to
 * 44, valid for kappa up to 7.5). Let z = kappa w and X = nu/(nu_c z^2 sin(theta)). In the same units as above, the
 * low-frequency and the high-frequency laws
 *
 *   j: nu_c sin(theta) light (X^(1/3) | X^(-(kappa - 2)/2)),   alpha: depth/(nu z^3) (F(z) X^(-2/3) | X^(-(kappa +
 *     1)/2)),
 *
 * are joined as (low^-s + high^-s)^(-1/s). The members named `_sharp` are s; all others are log2 of the constants. */
struct kd_synchrotron_kappa { double light_low, light_high, light_sharp, depth_low, depth_high, depth_sharp; };
struct kd_synchrotron_kappa kd_synchrotron_kappa(double kappa);

/* Constants for Q and V of the same electrons (equations 35 to 44). They multiply the low-frequency or the
 * high-frequency law of I. All are log2 of the constants, except the exponents s. j is the emissivity, alpha the
 * absorptivity.
 *
 *   Q, low:  the law of I times 1/2 for j and 25/48 for alpha.
 *   V, low:  the law of I times light_v_low or depth_v_low, times (sin^-n - 1)^m X^(-7/20)/w;
 *            n, m = 12/5, 12/25 for j and 57/25, 223/500 for alpha.
 *   V, high: the law of I times light_v_high or depth_v_high, times (sin^-n - 1)^m X^(-1/2)/w (alpha: w^(116/125));
 *            n, m = 5/2, 11/25 for j and 41/20, 1/2 for alpha.
 *
 * The two laws of V of j are joined with the exponent s of I. */
struct kd_synchrotron_kappa_polarised {
    double light_q_high, light_q_sharp, light_v_low, light_v_high, depth_q_high, depth_q_sharp, depth_v_low,
        depth_v_high, depth_v_sharp;
};
struct kd_synchrotron_kappa_polarised kd_synchrotron_kappa_polarised(double kappa);

/* Fills a table of log2 of F(z) = z^a 2F1(a, kappa + 1; a + 1; -z), with a = kappa - 1/3. Its n points are at log2(z) =
 * first + i step. first must be below -8. */
void kd_synchrotron_kappa_table(double kappa, double first, double step, int n, double *out);

#endif
