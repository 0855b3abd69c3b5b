/* Colour of a black body. It is computed from Planck's law by the CIE 1931 observer, and converted to linear sRGB.
 * Double precision, pure, any thread. */
#ifndef KD_PHYSICS_DISK_COLOUR_H
#define KD_PHYSICS_DISK_COLOUR_H

#define KD_CIE1931_COUNT 95
#define KD_CIE1931_FIRST_NM 360.0
#define KD_CIE1931_STEP_NM 5.0
extern const double kd_cie1931[KD_CIE1931_COUNT][3];

struct kd_colour_xyz { double x, y, z; };
struct kd_colour_rgb { double r, g, b; };

/* CIE XYZ of a black body's spectral radiance B_lambda(T). It is integrated over wavelength and is in W m^-2 sr^-1,
 * without the factor 683 lm/W. temperature: T in K, above 0. */
struct kd_colour_xyz kd_colour_blackbody(double temperature);

/* Converts to linear sRGB. Components are not clipped and can be negative. The matrix is that of IEC 61966-2-1:1999
 * with the digits of its amendment 1 of 2003. It is the inverse of the standard's four-digit matrix from RGB to XYZ.
 * The second row of that matrix gives the luminance: 0.2126, 0.7152, 0.0722. (The chromaticities of primaries and white
 * give a matrix that differs from the fourth digit on: its first element is 3.2409699, or 3.2404542 with another D65.)
 */
struct kd_colour_rgb kd_colour_xyz_to_srgb(struct kd_colour_xyz xyz);

/* The sRGB transfer function: encodes a linear component in [0, 1] (IEC 61966-2-1). */
double kd_colour_srgb_encode(double linear);

/* Colour of a black body as linear sRGB of luminance 1. Below about 1900 K the colour is outside the sRGB gamut. It is
 * then moved towards the grey of the same luminance until no component is negative. */
struct kd_colour_rgb kd_colour_blackbody_unit(double temperature);

/* Luminance Y divided by the total radiance sigma T^4 / pi: the fraction of a black body's light that the eye sees. */
double kd_colour_luminous_fraction(double temperature);

#endif
