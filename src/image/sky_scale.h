/* Draws how large a picture is on the sky, in its upper right corner, as radio astronomers do: a bar of a round
 * length, and the beam, a disk as wide as its full width at half maximum. Pure functions, any thread. */
#ifndef KD_IMAGE_SKY_SCALE_H
#define KD_IMAGE_SKY_SCALE_H

#include "image/canvas.h"

#include <stdbool.h>

struct kd_sky_scale {
    double pixel_uas; /* microarcseconds a pixel, above 0 */
    double beam_uas;  /* 0: there is none */
};

/* The length of the bar: 1, 2 or 5 times a power of ten, the largest of up to a quarter of the picture's width. */
double kd_sky_scale_bar(const struct kd_sky_scale *scale, uint32_t width);

/* Letters and lines are those of a legend (image/legend.h). The beam is left out where it is wider than a quarter of
 * the picture's smaller side. False: the picture is too small, as for a legend, and nothing was drawn. */
bool kd_sky_scale_draw(const struct kd_canvas *canvas, const struct kd_sky_scale *scale);

#endif
