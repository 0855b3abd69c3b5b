#include "image/colour_map.h"

#include <math.h>

/* A colour in linear sRGB; the values may be outside [0, 1]. */
struct linear { double r, g, b; };

/* The inverse of f(t) in CIE 15:2004. f(t) is t^(1/3) above (6/29)^3, and the tangent at that point below. */
static double inverse_f(double t)
{
    const double d = 6.0 / 29;
    return t > d ? t * t * t : 3 * d * d * (t - 4.0 / 29);
}

/* Converts from CIELAB, with the white and the matrix of sRGB (IEC 61966-2-1). */
static struct linear of_lab(double lightness, double chroma, double hue)
{
    double fy = (lightness + 16) / 116;
    double x = 0.95047 * inverse_f(fy + chroma * cos(hue) / 500), y = inverse_f(fy);
    double z = 1.08883 * inverse_f(fy - chroma * sin(hue) / 200);
    return (struct linear) {
        3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
        -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
        0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
    };
}

/* True if the colour is inside sRGB. A tolerance is needed for the white of the matrix, which is (1, 1, 1) only to
 * 1e-6. */
static bool shows(struct linear c)
{
    return fmin(fmin(c.r, c.g), c.b) >= -2e-6 && fmax(fmax(c.r, c.g), c.b) <= 1 + 2e-6;
}

/* Maximum chroma inside sRGB for this lightness and hue, found by bisection to 1e-5. */
static double most_chroma(double lightness, double hue)
{
    double low = 0, high = 140;
    for (int i = 0; i < 24; i++) {
        double middle = 0.5 * (low + high);
        bool inside = shows(of_lab(lightness, middle, hue));
        low = inside ? middle : low;
        high = inside ? high : middle;
    }
    return low;
}

static double encode(double c)
{
    c = fmin(fmax(c, 0), 1);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

/* hue: in degrees. */
static struct kd_map_colour colour(double lightness, double chroma, double hue)
{
    struct linear c = of_lab(lightness, chroma, hue * (M_PI / 180));
    return (struct kd_map_colour) { encode(c.r), encode(c.g), encode(c.b) };
}

static double chroma_of(double lightness, double hue, double limit)
{
    return fmin(0.98 * most_chroma(lightness, hue * (M_PI / 180)), limit);
}

static struct kd_map_colour sequential(double x)
{
    double lightness = 8 + 86 * x, hue = 310 - 208 * x, most = chroma_of(lightness, hue, 140);
    /* a smooth approximation of the minimum of `most` and 58 */
    return colour(lightness, pow(pow(most, -6) + pow(58, -6), -1.0 / 6), hue);
}

static struct kd_map_colour heat(double x)
{
    double lightness = 100 * x, hue = 36 + 64 * x * x;
    return colour(lightness, chroma_of(lightness, hue, 140), hue);
}

static struct kd_map_colour diverging(double x)
{
    double far = fabs(2 * x - 1), hue = x > 0.5 ? 285 : 40, lightness = 94 - 58 * far;
    return colour(lightness, chroma_of(lightness, hue, chroma_of(36, hue, 140) * far), hue);
}

/* At L* 70 the maximum chroma is at least 38.4 for all hues. */
static struct kd_map_colour cyclic(double x) { return colour(70, 38, x < 1 ? 360 * x : 0); }

static struct kd_map_colour categorical(double x)
{
    /* adjacent classes get different lightness, so that they differ in grey as well */
    static const double lightnesses[] = { 82, 62, 72 };
    double n = fmax(floor(x), 0), lightness = lightnesses[(int)fmod(n, 3)], hue = 80 + 137.50776 * n;
    return colour(lightness, chroma_of(lightness, hue, 140), hue);
}

struct kd_map_colour kd_colour_map_at(enum kd_colour_map map, double x)
{
    double inside = fmin(fmax(x, 0), 1);
    switch (map) {
    case KD_MAP_SEQUENTIAL: return sequential(inside);
    case KD_MAP_HEAT: return heat(inside);
    case KD_MAP_DIVERGING: return diverging(inside);
    case KD_MAP_CYCLIC: return cyclic(inside);
    case KD_MAP_CATEGORICAL: break;
    }
    return categorical(x);
}

void kd_colour_map_fill(struct kd_map_table *table, enum kd_colour_map map)
{
    for (size_t i = 0; i < KD_MAP_ENTRIES; i++)
        table->at[i] = kd_colour_map_at(map, map == KD_MAP_CATEGORICAL ? (double)i : (double)i / (KD_MAP_ENTRIES - 1));
}

double kd_map_scale_place(const struct kd_map_scale *scale, double value)
{
    if (scale->low == scale->high)
        return 0;
    return scale->logarithmic ? log(value / scale->low) / log(scale->high / scale->low)
                              : (value - scale->low) / (scale->high - scale->low);
}
