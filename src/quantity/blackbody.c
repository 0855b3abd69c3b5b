#include "quantity/define.h"

#include "physics/disk/colour.h"
#include "physics/math/constants.h"

#define PARAMETERS(P) P(temperature_k, .unit = "K", .typed = "5772", .least = 100, .most = 1e9, .help = "temperature")
#define OUTPUTS(O) \
    O(x, .unit = "1", .help = "CIE 1931 chromaticity x") \
    O(y, .unit = "1", .help = "CIE 1931 chromaticity y") \
    O(linear_r, .unit = "1", .help = "linear sRGB of luminance 1, not clipped: negative outside the gamut") \
    O(linear_g, .unit = "1", .help = "linear sRGB, green") \
    O(linear_b, .unit = "1", .help = "linear sRGB, blue") \
    O(srgb_r, .unit = "1", .help = "encoded sRGB, 0 to 1: brightest component 1, moved to the edge of the gamut") \
    O(srgb_g, .unit = "1", .help = "encoded sRGB, green") \
    O(srgb_b, .unit = "1", .help = "encoded sRGB, blue") \
    O(peak_nm, .unit = "nm", .help = "wavelength of the largest radiance a unit of wavelength (Wien)") \
    O(peak_hz, .unit = "Hz", .help = "frequency of the largest radiance a unit of frequency") \
    O(radiance, .unit = "W m^-2 sr^-1", .help = "sigma T^4/pi") \
    O(luminous_fraction, .unit = "1", .help = "luminous efficiency: luminance Y over radiance")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "Planck's law; CODATA 2018",
    "CIE 1931 2 degree observer, ISO/CIE 11664-1, 360-830 nm in steps of 5 nm",
    "sRGB: IEC 61966-2-1:1999 with its amendment 1 of 2003, whose matrix of XYZ to RGB begins 3.2406255",
    NULL,
};
static const char *const approximations[] = {
    "colours outside sRGB are moved towards the grey of the same luminance until no component is negative",
    NULL,
};

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    (void)memory, (void)fresh, (void)error;
    double t = p->temperature_k;
    struct kd_colour_xyz c = kd_colour_blackbody(t);
    double sum = c.x + c.y + c.z;
    struct kd_colour_rgb linear = kd_colour_xyz_to_srgb((struct kd_colour_xyz) { c.x / c.y, 1, c.z / c.y });
    struct kd_colour_rgb shown = kd_colour_blackbody_unit(t);
    double most = fmax(shown.r, fmax(shown.g, shown.b));
    *o = (struct outputs) {
        .x = c.x / sum,
        .y = c.y / sum,
        .linear_r = linear.r,
        .linear_g = linear.g,
        .linear_b = linear.b,
        .srgb_r = kd_colour_srgb_encode(shown.r / most),
        .srgb_g = kd_colour_srgb_encode(shown.g / most),
        .srgb_b = kd_colour_srgb_encode(shown.b / most),
        .peak_nm = KD_WIEN_M_K * 1e9 / t,
        .peak_hz = KD_WIEN_HZ_K * t,
        .radiance = KD_STEFAN_BOLTZMANN_SI * pow(t, 4) / M_PI,
        .luminous_fraction = kd_colour_luminous_fraction(t),
    };
    return KD_OK;
}

KD_QUANTITY(blackbody, "blackbody", "colour of a black body: chromaticity, sRGB, peak", .point_us = 8)
