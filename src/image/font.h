/* Letters of legends, as dots on a grid of 5 x 7: digits, letters and signs of numbers and units, ASCII. Other
 * characters are drawn as a box. Constant data, any thread. */
#ifndef KD_IMAGE_FONT_H
#define KD_IMAGE_FONT_H

#include <stdbool.h>
#include <stdint.h>

enum { KD_FONT_WIDTH = 5, KD_FONT_HEIGHT = 7, KD_FONT_ADVANCE = 6 };

bool kd_font_has(char c);
bool kd_font_dot(char c, int x, int y); /* x from the left, y from the top */

#endif
