/* Draws on a finished picture: rectangles, letters, and panels that are darkened behind them. Pure functions,
 * any thread. */
#ifndef KD_IMAGE_CANVAS_H
#define KD_IMAGE_CANVAS_H

#include "image/colour_map.h"

#include <stdint.h>

/* RGB without padding, rows from the top; 16 bits are numbers of this machine. */
struct kd_canvas {
    void *pixels;
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
};

#define KD_CANVAS_INK ((struct kd_map_colour) { 0.92, 0.92, 0.92 })

/* One pixel; x and y are inside. Encoded sRGB in [0, 1], rounded; and what is there, to a fifth. */
void kd_canvas_put(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour);
void kd_canvas_darken(const struct kd_canvas *canvas, uint32_t x, uint32_t y);

/* A rectangle that is inside. */
void kd_canvas_fill(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                    struct kd_map_colour colour);

/* Letters of image/font.h, `dot` pixels a dot, from x on as far as they end before `end`; and how wide a text is. */
void kd_canvas_write(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t end, uint32_t dot,
                     const char *text);
uint32_t kd_canvas_text_width(uint32_t dot, const char *text);

/* Pixels of a dot: as many whole ones as let `width` dots go into the picture's width, and make `height` of them a
 * seventh of its height at most, but one at least. */
uint32_t kd_canvas_dot(const struct kd_canvas *canvas, uint32_t width, uint32_t height);

#endif
