/* Shared by the picture tests: one renderer, scenes from text, pixels as numbers. One thread. */
#ifndef KD_TESTS_STUDIO_H
#define KD_TESTS_STUDIO_H

#include "render/render.h"

#include <stdbool.h>

#define SKIPPED 77

/* Opens a device and returns 0. Otherwise prints the reason and returns SKIPPED if there is no device, 1 if it failed.
 * KERRD_TEST_DEVICE chooses a device. */
int studio_open(void);
void studio_close(void);

/* True if kernels can compute in double precision. Otherwise prints that the test of `what` is skipped. */
bool studio_has_float64(const char *what);

/* A picture of the sky, for sky.image. It shows longitude as colour, a grid every 30 degrees, and discs of 12 degrees:
 * orange at l = 0, red at 90, green at 180, blue at 270, white at the north pole. The hash is made up. */
#define STUDIO_SKY "736b792d6f662d7468652d73747564696f2d0000000000000000000000000001"

/* A preset (NULL: "smooth") with a JSON document merged over it. An invalid scene ends the program. */
struct kd_scene studio_scene(const char *preset, const char *json);

/* Renders, or ends the program with the error. Free with kd_frame_finish. */
struct kd_frame studio_render(const struct kd_scene *scene);
/* Renders the scene of a document, formatted as by printf, over the preset "smooth". */
struct kd_frame studio_shoot(const char *json, ...) __attribute__((format(printf, 1, 2)));

/* One sample of the colour channel c = 0, 1, 2: as a fraction of full scale, and as linear light (the inverse of the
 * sRGB curve). */
double studio_value(const struct kd_frame *frame, uint32_t x, uint32_t y, int c);
double studio_light(const struct kd_frame *frame, uint32_t x, uint32_t y, int c);
/* Luminance of a pixel by the weights of linear sRGB; -1 if a channel may be clipped. */
double studio_luminance(const struct kd_frame *frame, uint32_t x, uint32_t y);
bool studio_black(const struct kd_frame *frame, uint32_t x, uint32_t y); /* exactly black */

#endif
