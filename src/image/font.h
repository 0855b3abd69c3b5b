/* Letters for legends: digits, letters, and the signs of numbers and units. A letter is stored as dots on a grid of
 * 5 x 7, and is drawn as strokes that join neighbouring dots. Letters are given as Unicode code points; a letter
 * without a shape is drawn as a box. Constant data, any thread. */
#ifndef KD_IMAGE_FONT_H
#define KD_IMAGE_FONT_H

#include <stdbool.h>
#include <stdint.h>

enum { KD_FONT_WIDTH = 5, KD_FONT_HEIGHT = 7, KD_FONT_ADVANCE = 6 };

/* Returns the letter at *text, and advances *text past it. A byte that does not start a UTF-8 sequence counts as a
 * letter without a shape. *text must not be at the end. */
uint32_t kd_font_next(const char **text);

bool kd_font_has(uint32_t letter);
/* x is counted from the left, y from the top; false outside the grid */
bool kd_font_dot(uint32_t letter, int x, int y);

/* Distance of a point from the nearest stroke of a letter, in dots, limited to 1. The centre of the first dot is at
 * (0, 0). */
double kd_font_distance(uint32_t letter, double x, double y);

#endif
