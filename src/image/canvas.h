/* Draws on a finished picture: rectangles, text, and darkened panels for a background. Pure functions, any thread. */
#ifndef KD_IMAGE_CANVAS_H
#define KD_IMAGE_CANVAS_H

#include "image/colour_map.h"

#include <stdint.h>

/* RGB without padding, rows from the top; 16-bit samples are in native byte order. */
struct kd_canvas {
    void *pixels;
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
};

#define KD_CANVAS_INK ((struct kd_map_colour) { 0.92, 0.92, 0.92 })

/* One pixel; x and y must be inside. Put: encoded sRGB in [0, 1], rounded; darken: to a fifth of the present value. */
void kd_canvas_put(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour);
void kd_canvas_darken(const struct kd_canvas *canvas, uint32_t x, uint32_t y);

/* A rectangle, which must be inside. */
void kd_canvas_fill(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                    struct kd_map_colour colour);

/* Text in the letters of image/font.h, `dot` pixels a dot, from x on, without letters that would end beyond `end`;
 * and the width of a text. */
void kd_canvas_write(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t end, uint32_t dot,
                     const char *text);
uint32_t kd_canvas_text_width(uint32_t dot, const char *text);

/* Pixels a dot: a whole number such that `width` dots fit the picture's width and `height` dots take at most a
 * seventh of its height, but at least 1. */
uint32_t kd_canvas_dot(const struct kd_canvas *canvas, uint32_t width, uint32_t height);

#endif
