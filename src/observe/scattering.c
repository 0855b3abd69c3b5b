#include "observe/scattering.h"

#include <math.h>

#define ALPHA 1.38      /* exponent of the phase structure function beyond the inner scale */
#define INNER_CM 800e5  /* inner scale of the turbulence */
#define MAJOR_MAS 1.380 /* FWHM of the kernel at 1 cm, in the limit of long wavelengths */
#define MINOR_MAS 0.703
#define POSITION_DEG 81.9 /* position angle of the major axis, from north to east */
/* ratio of the screen's distance from the observer (kpc) to its distance from the source (kpc) */
#define MAGNIFICATION (2.82 / 5.53)
#define RADIANS_PER_MAS (M_PI / 180 / 3.6e6)
#define C_CM_S 2.99792458e10

enum { BISECTIONS = 60 };

/* Distribution of the wave vector's direction (dipole model of Psaltis et al.), not normalised. angle: angle from the
 * major axis. */
static double weight(double angle, double k) { return pow(1 + k * sin(angle) * sin(angle), -(ALPHA + 2) / 2); }

/* Mean of cos(2 angle) over the distribution, which is the anisotropy for small r. The integrand is periodic and
 * smooth, so 256 points give full precision. */
static double anisotropy(double k)
{
    double sum = 0, norm = 0;
    for (int i = 0; i < 256; i++) {
        const double angle = 2 * M_PI * i / 256, w = weight(angle, k);
        norm += w, sum += w * cos(2 * angle);
    }
    return sum / norm;
}

/* The parameter k of the distribution that gives an anisotropy. The anisotropy grows with k. */
static double find_k(double zeta)
{
    double low = 0, high = 100;
    for (int i = 0; i < BISECTIONS; i++) {
        const double k = (low + high) / 2;
        *(anisotropy(k) < zeta ? &low : &high) = k;
    }
    return (low + high) / 2;
}

void kd_scattering_sgra(struct kd_scattering *out, double frequency_hz)
{
    const double major = MAJOR_MAS * RADIANS_PER_MAS, minor = MINOR_MAS * RADIANS_PER_MAS,
                 ratio2 = (minor / major) * (minor / major), k = find_k((1 - ratio2) / (1 + ratio2));
    double norm = 0;
    for (int i = 0; i < KD_SCATTERING_POINTS; i++)
        norm += out->weight[i] = weight(M_PI * i / KD_SCATTERING_POINTS, k);
    for (int i = 0; i < KD_SCATTERING_POINTS; i++)
        out->weight[i] /= norm;
    /* For small r, D is strength (r/r_in)^2 times the mean of cos^2. This strength gives a Gaussian with the widths of
     * the kernel. */
    out->strength = pow(M_PI * (1 + MAGNIFICATION) * INNER_CM, 2) * (major * major + minor * minor) / (2 * M_LN2);
    out->wavelength_cm = C_CM_S / frequency_hz;
}

/* The function 1F1(-alpha/2; 1/2; -z) - 1. Up to z = 40 it comes from the series of exp(-z) 1F1((1 + alpha)/2; 1/2; z),
 * all of whose terms are positive (Abramowitz & Stegun 13.1.27). Beyond, it comes from the asymptotic series, with an
 * error below 1e-15 (13.5.1). */
static double turbulence(double z)
{
    const double a = (1 + ALPHA) / 2, b = 0.5;
    double term = 1, sum = 0;
    if (z > 40) {
        for (int n = 0; n < 12; n++)
            sum += term, term *= (b - a + n) * (1 - a + n) / ((n + 1) * z);
        return tgamma(b) / tgamma(a) * pow(z, a - b) * sum - 1;
    }
    for (int n = 0; term > 1e-17 * sum; n++)
        term *= (a + n) / (b + n) * z / (n + 1), sum += term;
    return exp(-z) * sum + expm1(-z);
}

double kd_scattering_at(const struct kd_scattering *s, double u, double v)
{
    const double r = hypot(u, v) * s->wavelength_cm / ((1 + MAGNIFICATION) * INNER_CM),
                 angle = atan2(u, v) - POSITION_DEG * (M_PI / 180);
    double mean = 0;
    for (int i = 0; i < KD_SCATTERING_POINTS; i++) {
        const double along = r * cos(M_PI * i / KD_SCATTERING_POINTS - angle) / 2;
        mean += s->weight[i] * turbulence(along * along);
    }
    return exp(-2 / ALPHA * s->strength * s->wavelength_cm * s->wavelength_cm * mean);
}
