/* Chooses the pixels that need more rays, by how they are displayed. Pure; any thread. */
#ifndef KD_RENDER_FRAME_CHOOSE_H
#define KD_RENDER_FRAME_CHOOSE_H

#include "base/error.h"
#include "render/view/critical_pixels.h"

/* A picture as it is shown, 16 bits a channel, three channels; and of each pixel its kind: from `done` on it is out
 * of the question. */
struct kd_shown {
    const uint16_t *pixels;
    const uint8_t *kinds;
    uint8_t done;
    uint32_t width, height;
};

/* Pixels row by row, and of each how much it seems to need it. */
struct kd_choice {
    struct kd_critical_pixels list;
    uint32_t *scores;
    size_t room;
};
enum kd_status kd_choice_add(struct kd_choice *choice, struct kd_pixel pixel, uint32_t score,
                             struct kd_error *error); /* KD_ENOMEM */
void kd_choice_finish(struct kd_choice *choice);

/* Choose the pixels whose second difference comes to twice pixel_error of white in any channel, across, down or
 * along a diagonal. Where the picture is straight from pixel to pixel a ray in the middle of each is right, whatever
 * the slope. Beyond the edge of the picture it is dark: whatever shines there may end there.
 *
 * Where a picture is so smooth that the others hold more than KD_CHOOSE_LEFT of the sum of squares of all second
 * differences, which goes with the sum of squares of errors, as many of the next largest are chosen as leave just
 * that, down to KD_CHOOSE_FLOOR of the bound. KD_ENOMEM. */
#define KD_CHOOSE_LEFT 2e-4
#define KD_CHOOSE_FLOOR 0.1
enum kd_status kd_choose_bent(const struct kd_shown *now, double pixel_error, struct kd_choice *out,
                              struct kd_error *error);

/* Choose the pixels next to those of n lists that changed by pixel_error or more: what one ray in each pixel missed
 * here may go on there. before: what was shown, as now->pixels. KD_ENOMEM. */
enum kd_status kd_choose_beside(const struct kd_shown *now, const uint16_t *before,
                                const struct kd_critical_pixels *lists, size_t n, double pixel_error,
                                struct kd_choice *out, struct kd_error *error);

/* Leave the first that have the largest scores, at most so many. */
void kd_choose_largest(struct kd_choice *choice, uint64_t most);

#endif
