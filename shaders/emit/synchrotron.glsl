/* Synchrotron emission and absorption of electrons in a magnetic field, per length at one frequency and angle. All
 * values are logarithms to base 2, because their powers of ten and their exponentials do not fit a float.
 *
 * Thermal electrons follow A. Pandya, Z. Zhang, M. Chandra & C. F. Gammie 2016 (ApJ 822, 34, equation 31), who use the
 * fit of P. K. Leung, C. F. Gammie & S. C. Noble 2011 (ApJ 737, 21), with nu_c = eB/(2 pi m_e c), nu_s = (2/9) nu_c
 * Theta^2 sin(theta) and X = nu/nu_s:
 *
 *   j = n e^2 nu_c/c (sqrt(2) pi/27) sin(theta) (X^(1/2) + 2^(11/12) X^(1/6))^2 exp(-X^(1/3)),
 *   alpha = j/B_nu (Kirchhoff)
 *
 * Electrons of a power law n(gamma) ~ gamma^-p from gamma_min to gamma_max (equations 33 and 34) have j ~ nu^(-(p-1)/2)
 * and alpha ~ nu^(-(p+4)/2). The host combines the constant factors into two numbers. */
#ifndef KD_SYNCHROTRON_GLSL
#define KD_SYNCHROTRON_GLSL

/* Electrons. density, heat, field: log2 of their density in cm^-3, of Theta = kT/(m_e c^2), and of the field in gauss.
 * cosine: cosine of the angle between field and light in the frame of the matter. sine2: square of the sine of this
 * angle. */
struct kd_electrons { float density, heat, field, cosine, sine2; };
/* light: log2 of the emissivity. Its unit is e^2/c cm^-3 GHz (e in Gaussian units), which is 7.69558e-22 W m^-3 Hz^-1
 * sr^-1. depth: log2 of the absorptivity. Its unit is the unit of emissivity divided by 2h GHz^3/c^2, which is 52.191
 * m^-1. steep: relative change of light per relative change of the field. */
struct kd_radiates { float light, depth, steep; };

#define KD_LOG2_E 1.44269504
#define KD_LOG2_GYRO -8.48074447    /* log2 of e/(2 pi m_e c), which is 2.79924899e-3 GHz per gauss */
#define KD_LOG2_QUANTUM -36.8464093 /* log2 of h GHz/(m_e c^2) */
#define KD_LOG2_THERMAL -2.60339137 /* log2 of sqrt(2) pi/27 */
#define KD_LOG2_LEAST -1000.0       /* value in place of log2 of 0 */

/* log2(e^x - 1), given log2(x). */
float kd_log2_expm1(float log2_x)
{
    float x = exp2(min(log2_x, 24.0));
    return x < 0.02 ? log2_x + KD_LOG2_E * x * (0.5 + x * (1.0 / 24.0)) : x > 16.0 ? KD_LOG2_E * x : log2(exp(x) - 1.0);
}

/* log2 of B_nu in units of 2h GHz^3/c^2, given log2 of the frequency in GHz and of Theta. */
float kd_log2_planck(float frequency, float heat)
{
    return 3.0 * frequency - kd_log2_expm1(frequency - heat + KD_LOG2_QUANTUM);
}

kd_radiates kd_synchrotron_thermal(kd_electrons e, float frequency)
{
    float turn = e.field + KD_LOG2_GYRO, slant = 0.5 * log2(max(e.sine2, 1e-30));
    float x = clamp(frequency - turn - 2.0 * e.heat - slant + 2.169925, -300.0, 60.0), third = exp2(x * (1.0 / 3.0));
    float shape = x * (1.0 / 3.0) + 2.0 * log2(exp2(x * (1.0 / 3.0)) + 1.887748625) - KD_LOG2_E * third;
    float light = e.density + turn + slant + KD_LOG2_THERMAL + shape;
    return kd_radiates(light, light - kd_log2_planck(frequency, e.heat), min(third, 40.0) * (1.0 / 3.0));
}

kd_radiates kd_synchrotron_by_power(kd_electrons e, float frequency, float index, float light, float depth)
{
    float turn = e.field + KD_LOG2_GYRO, slant = 0.5 * log2(max(e.sine2, 1e-30)), x = frequency - turn - slant;
    return kd_radiates(e.density + turn + slant + light - 0.5 * (index - 1.0) * x,
                       e.density - frequency + depth - 0.5 * (index + 2.0) * x, 0.5 * (index + 1.0));
}
#endif
