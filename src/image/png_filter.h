/* Rows of a PNG are filtered before compression (PNG specification, third edition, W3C 2025, section 9). Pure, any
 * thread.
 *
 * A row is `stride` bytes, `step` of them a pixel; filtered it is one byte more, the filter's number in front. */
#ifndef KD_IMAGE_PNG_FILTER_H
#define KD_IMAGE_PNG_FILTER_H

#include <stddef.h>
#include <stdint.h>

/* Each byte less that of the pixel to the left: filter 1. */
void kd_png_filter_sub(uint8_t *restrict to, const uint8_t *restrict row, size_t stride, size_t step);

/* By the one of the five whose bytes, as signed numbers, are least in sum (section 12.7); of equal ones the first.
 * above: the row before, as it was; for the first one zeros. room: 5 strides. */
void kd_png_filter_least(uint8_t *restrict to, const uint8_t *row, const uint8_t *above, size_t stride, size_t step,
                         uint8_t *restrict room);

#endif
