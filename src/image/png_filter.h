/* Filters rows of a PNG before compression (PNG specification, third edition, W3C 2025, section 9). Pure, any
 * thread. A row has `stride` bytes, `step` bytes per pixel. The filtered row is one byte longer, because it begins
 * with the filter's number. */
#ifndef KD_IMAGE_PNG_FILTER_H
#define KD_IMAGE_PNG_FILTER_H

#include <stddef.h>
#include <stdint.h>

/* Filter 1: each byte minus the corresponding byte of the pixel to the left. */
void kd_png_filter_sub(uint8_t *restrict to, const uint8_t *restrict row, size_t stride, size_t step);

/* Uses the one of the five filters whose output, as signed numbers, has the smallest sum of magnitudes (section
 * 12.7). If several sums are equal, the first such filter is used. above: the unfiltered row before this one, or
 * zeros for the first row. room: working memory of 5 strides. */
void kd_png_filter_least(uint8_t *restrict to, const uint8_t *row, const uint8_t *above, size_t stride, size_t step,
                         uint8_t *restrict room);

#endif
