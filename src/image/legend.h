/* Draws a colour bar in the lower left corner of a picture: a title, ticks and numbers on a darkened panel. Pure
 * functions, any thread. */
#ifndef KD_IMAGE_LEGEND_H
#define KD_IMAGE_LEGEND_H

#include "image/canvas.h"

#include <stdint.h>

struct kd_legend {
    const char *title; /* name and unit of the values, in ASCII (image/font.h) */
    enum kd_colour_map map;
    struct kd_map_scale scale;
    uint32_t classes;         /* number of boxes that replace the bar, for CATEGORICAL */
    const char *const *names; /* names of the classes; NULL: their numbers are shown */
};

/* A legend is 144 x 37 dots large. A dot is a whole number of pixels: the largest number with which the legend takes
 * at most a seventh of the picture's height, but at least 1. Returns false and draws nothing if the picture is
 * narrower than KD_LEGEND_LEAST_WIDTH or lower than KD_LEGEND_LEAST_HEIGHT. */
enum { KD_LEGEND_LEAST_WIDTH = 160, KD_LEGEND_LEAST_HEIGHT = 90 };
uint32_t kd_legend_dot(const struct kd_canvas *canvas); /* pixels */
bool kd_legend_draw(const struct kd_canvas *canvas, const struct kd_legend *legend);

/* Numbers on the bar: as many round numbers as fit without touching. room: length of the bar, in widths of a letter.
 * An invalid scale, such as a logarithmic one that starts at 0, gets at most one number. */
struct kd_tick {
    double value;
    char label[12];
};
enum { KD_LEGEND_TICKS = 12 };
size_t kd_legend_ticks(const struct kd_map_scale *scale, double room, struct kd_tick out[KD_LEGEND_TICKS]);

#endif
