#include "physics/disk/colour.h"

#include "physics/math/constants.h"

#include <math.h>

/* Planck's law for a wavelength in m: spectral radiance in W m^-3 sr^-1. */
static double planck(double wavelength, double temperature)
{
    const double h = KD_H_J_S, c = KD_C_M_S, k = KD_K_J_K;
    double x = h * c / (wavelength * k * temperature);
    return x > 700 ? 0 : 2 * h * c * c / (pow(wavelength, 5) * expm1(x));
}

struct kd_colour_xyz kd_colour_blackbody(double temperature)
{
    struct kd_colour_xyz sum = { 0, 0, 0 };
    /* the colour-matching functions vanish at both ends, so the plain sum is the trapezoidal rule */
    for (int i = 0; i < KD_CIE1931_COUNT; i++) {
        double b =
            planck((KD_CIE1931_FIRST_NM + i * KD_CIE1931_STEP_NM) * 1e-9, temperature) * KD_CIE1931_STEP_NM * 1e-9;
        sum.x += b * kd_cie1931[i][0];
        sum.y += b * kd_cie1931[i][1];
        sum.z += b * kd_cie1931[i][2];
    }
    return sum;
}

struct kd_colour_rgb kd_colour_xyz_to_srgb(struct kd_colour_xyz c)
{
    return (struct kd_colour_rgb) {
        3.2406255 * c.x - 1.5372080 * c.y - 0.4986286 * c.z,
        -0.9689307 * c.x + 1.8757561 * c.y + 0.0415175 * c.z,
        0.0557101 * c.x - 0.2040211 * c.y + 1.0569959 * c.z,
    };
}

double kd_colour_srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

struct kd_colour_rgb kd_colour_blackbody_unit(double temperature)
{
    struct kd_colour_xyz xyz = kd_colour_blackbody(temperature);
    /* below about 60 K the visible light underflows; the colour is then the deepest red of the gamut, which is its
     * limit */
    if (!(xyz.y > 0))
        return (struct kd_colour_rgb) { 1 / 0.2126, 0, 0 };
    struct kd_colour_rgb c = kd_colour_xyz_to_srgb((struct kd_colour_xyz) { xyz.x / xyz.y, 1, xyz.z / xyz.y });
    double low = fmin(c.r, fmin(c.g, c.b));
    /* mixes the colour with the grey (1, 1, 1), whose luminance is 1, as c + s (1 - c). s is the least fraction for
     * which no component is negative */
    if (low < 0) {
        double s = low / (low - 1);
        c = (struct kd_colour_rgb) { c.r + s * (1 - c.r), c.g + s * (1 - c.g), c.b + s * (1 - c.b) };
        /* rounding may leave a component slightly below 0 */
        c = (struct kd_colour_rgb) { fmax(c.r, 0), fmax(c.g, 0), fmax(c.b, 0) };
    }
    return c;
}

double kd_colour_luminous_fraction(double temperature)
{
    return kd_colour_blackbody(temperature).y / (KD_STEFAN_BOLTZMANN_SI * pow(temperature, 4) / M_PI);
}
