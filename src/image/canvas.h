/* Draws on a finished picture: rectangles, text, and darkened panels as a background. Pure functions, any thread. */
#ifndef KD_IMAGE_CANVAS_H
#define KD_IMAGE_CANVAS_H

#include "image/colour_map.h"

#include <stdint.h>

/* An RGB picture without padding, rows from the top. 16-bit samples are in native byte order. */
struct kd_canvas {
    void *pixels;
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
};

#define KD_CANVAS_INK ((struct kd_map_colour) { 0.92, 0.92, 0.92 })

/* kd_canvas_put sets one pixel to a colour (encoded sRGB in [0, 1], rounded). kd_canvas_mix blends a colour into the
 * pixel; `share` is the weight of the new colour, 0 to 1. kd_canvas_darken reduces the pixel to a fifth of its
 * value. x and y must be inside the canvas. */
void kd_canvas_mix(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour, double share);
void kd_canvas_put(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour);
void kd_canvas_darken(const struct kd_canvas *canvas, uint32_t x, uint32_t y);

/* Fills a rectangle, which must be inside the canvas. */
void kd_canvas_fill(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                    struct kd_map_colour colour);

/* kd_canvas_write writes a UTF-8 text that starts at x, with the letters of image/font.h. A dot of a letter is `dot`
 * pixels wide, and edges are smooth. Letters that would extend beyond `end` are left out. kd_canvas_text_width
 * returns the width of a text. */
void kd_canvas_write(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t end, uint32_t dot,
                     const char *text);
uint32_t kd_canvas_text_width(uint32_t dot, const char *text);

/* Returns the size of a dot in pixels. It is the largest size with which `width` dots fit into the picture's width,
 * and `height` dots take at most a seventh of its height. It is at least 1. */
uint32_t kd_canvas_dot(const struct kd_canvas *canvas, uint32_t width, uint32_t height);

#endif
