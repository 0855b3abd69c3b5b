/* Makes the kernels that explain a picture's pixels, before an explanation is requested. */
#ifndef KD_RENDER_EXPLAIN_AHEAD_H
#define KD_RENDER_EXPLAIN_AHEAD_H

#include "render/frame/compilation.h"

/* Makes a compilation of the kernels that the device lacks to explain any pixel of the scene's picture, on or off the
 * critical curve. The pixel is rendered as POST /v1/pixel renders it for the web page: with one ray a pixel, a
 * numeric exposure, no bloom and no beam. Returns NULL if the device has all of these kernels, or if such a pixel has
 * no plan. Only the thread that owns the device may call this. */
struct kd_compilation *kd_explain_ahead(struct kd_renderer *renderer, const struct kd_scene *scene);

#endif
