/* Letters of legends: digits, letters and signs of numbers and units. A letter is given as dots on a grid of 5 x 7, and
 * drawn as the strokes that join neighbouring dots. Letters are Unicode code points; one without a shape is drawn as a
 * box. Constant data, any thread. */
#ifndef KD_IMAGE_FONT_H
#define KD_IMAGE_FONT_H

#include <stdbool.h>
#include <stdint.h>

enum { KD_FONT_WIDTH = 5, KD_FONT_HEIGHT = 7, KD_FONT_ADVANCE = 6 };

/* Returns the letter that begins at *text, and moves *text behind it. A byte that begins no UTF-8 sequence is a letter
 * without a shape. *text must not be at the end. */
uint32_t kd_font_next(const char **text);

bool kd_font_has(uint32_t letter);
bool kd_font_dot(uint32_t letter, int x, int y); /* x from the left, y from the top; false outside the grid */

/* Distance of a point from the nearest stroke of a letter, in dots. The middle of the first dot is at (0, 0).
 * Distances above 1 are returned as 1. */
double kd_font_distance(uint32_t letter, double x, double y);

#endif
