/* Colour maps. Lightness L* (CIE 1976) follows the table below, and hues are those of CIELAB, inside the gamut of sRGB
 * (CIE 15:2004, IEC 61966-2-1). Each colour is computed, without a table or a fit. Pure functions, any thread.
 *
 *   SEQUENTIAL   L* from 8 to 94 at a constant rate, violet, blue, green, yellow: also ordered in grey
 *   HEAT         L* from 0 to 100 at a constant rate, black, red, orange, white: for brightness
 *   DIVERGING    L* from 36 at both ends to 94 at x = 1/2, red, white, blue: for values with a middle, such as 1 for g;
 *                red is below the middle
 *   CYCLIC       L* 70 throughout, hue once round: for angles; both ends have the same colour
 *   CATEGORICAL  hues by the golden angle: x is the number of a class, 0, 1, 2, ... */
#ifndef KD_IMAGE_COLOUR_MAP_H
#define KD_IMAGE_COLOUR_MAP_H

#include <stdbool.h>
#include <stddef.h>

enum kd_colour_map { KD_MAP_SEQUENTIAL, KD_MAP_HEAT, KD_MAP_DIVERGING, KD_MAP_CYCLIC, KD_MAP_CATEGORICAL };

/* A colour in encoded sRGB, each value in [0, 1]. */
struct kd_map_colour { double r, g, b; };

/* Returns the colour at x. x is clamped to [0, 1]. For CATEGORICAL, x is the number of a class, 0 or more. Takes 2
 * us. */
struct kd_map_colour kd_colour_map_at(enum kd_colour_map map, double x);

/* A table of the colours of kd_colour_map_at, for use with many pixels. The error is at most 1/150 in each channel.
 * For CATEGORICAL, at[i] is the colour of class i. Making the table takes 2 ms. */
enum { KD_MAP_ENTRIES = 1024 };
struct kd_map_table { struct kd_map_colour at[KD_MAP_ENTRIES]; };
void kd_colour_map_fill(struct kd_map_table *table, enum kd_colour_map map);
static inline struct kd_map_colour kd_map_table_at(const struct kd_map_table *table, double x)
{
    x = x > 0 ? x < 1 ? x : 1 : 0;
    return table->at[(size_t)(x * (KD_MAP_ENTRIES - 1) + 0.5)];
}

/* The mapping from values to positions on the map. */
struct kd_map_scale {
    double low, high; /* values at the ends of the map; on a logarithmic scale both must be above 0 */
    bool logarithmic;
};
/* Position on the map: 0 for the value `low`, 1 for `high`. Values outside are not clamped. The result is 0 if low
 * equals high. */
double kd_map_scale_place(const struct kd_map_scale *scale, double value);

#endif
