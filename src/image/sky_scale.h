/* Draws the angular scale of a picture in its upper right corner, as is usual in radio astronomy. It consists of a
 * bar of a round length, and of the beam, a disk whose diameter is the beam's full width at half maximum. Pure
 * functions, any thread. */
#ifndef KD_IMAGE_SKY_SCALE_H
#define KD_IMAGE_SKY_SCALE_H

#include "image/canvas.h"

#include <stdbool.h>

struct kd_sky_scale {
    double pixel_uas; /* microarcseconds per pixel, above 0 */
    double beam_uas;  /* full width at half maximum of the beam; 0: there is no beam */
};

/* Length of the bar in microarcseconds: the largest number 1, 2 or 5 times a power of ten that is at most a quarter
 * of the picture's width. */
double kd_sky_scale_bar(const struct kd_sky_scale *scale, uint32_t width);

/* Letters and lines have the same size as in a legend (image/legend.h). The beam is left out if it is wider than a
 * quarter of the picture's smaller side. Returns false, and draws nothing, if the picture is too small for a legend. */
bool kd_sky_scale_draw(const struct kd_canvas *canvas, const struct kd_sky_scale *scale);

#endif
