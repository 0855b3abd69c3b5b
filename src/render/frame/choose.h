/* Chooses the pixels that need more rays, from their displayed values. Pure; any thread. */
#ifndef KD_RENDER_FRAME_CHOOSE_H
#define KD_RENDER_FRAME_CHOOSE_H

#include "base/error.h"
#include "render/view/critical_pixels.h"

/* A displayed picture with three channels of 16 bits, and the kind of each pixel. Pixels whose kind is `done` or
 * greater are never chosen. */
struct kd_shown {
    const uint16_t *pixels;
    const uint8_t *kinds;
    uint8_t done;
    uint32_t width, height;
};

/* Pixels row by row, each with a score. The score is high if the pixel needs more rays. */
struct kd_choice {
    struct kd_critical_pixels list;
    uint32_t *scores;
    size_t room;
};
enum kd_status kd_choice_add(struct kd_choice *choice, struct kd_pixel pixel, uint32_t score,
                             struct kd_error *error); /* the only error is KD_ENOMEM */
void kd_choice_finish(struct kd_choice *choice);

/* Chooses pixels whose second difference reaches twice pixel_error of white in any channel, across, down or diagonally.
 * The second difference decides because on a linear gradient one ray at the pixel's centre is already exact, whatever
 * the slope. Pixels outside the picture count as dark, because light may end at the edge.
 *
 * The sum of squares of errors is proportional to the sum of squares of second differences. In a smooth picture the
 * pixels that are not chosen may have more than the fraction KD_CHOOSE_LEFT of that sum. Then the pixels with the next
 * largest differences are chosen as well, until only this fraction remains. Pixels with less than KD_CHOOSE_FLOOR of
 * the bound are never chosen. The only error is KD_ENOMEM. */
#define KD_CHOOSE_LEFT 2e-4
#define KD_CHOOSE_FLOOR 0.1
enum kd_status kd_choose_bent(const struct kd_shown *now, double pixel_error, struct kd_choice *out,
                              struct kd_error *error);

/* Chooses the neighbours of pixels that changed by pixel_error or more, because a feature that one ray a pixel
 * missed may continue there. lists: n lists of the pixels that may have changed. before: the earlier picture, in the
 * layout of now->pixels. The only error is KD_ENOMEM. */
enum kd_status kd_choose_beside(const struct kd_shown *now, const uint16_t *before,
                                const struct kd_critical_pixels *lists, size_t n, double pixel_error,
                                struct kd_choice *out, struct kd_error *error);

/* Keeps the `most` pixels with the largest scores. Scores in the same of 1024 bins count as equal; among equal scores
 * the first pixels are kept. */
void kd_choose_largest(struct kd_choice *choice, uint64_t most);

#endif
