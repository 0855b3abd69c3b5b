/* Renders one picture for the command line. Chooses the format, plans the picture, shows the progress bar, and
 * handles a lost device. Main thread only. */
#ifndef KD_CLI_DRAW_H
#define KD_CLI_DRAW_H

#include "render/output/format.h"
#include "render/render.h"

#include <argp.h>

/* Returns the format that belongs to the extension of a picture's file (cli/ending.h). Returns NULL if the name has
 * no extension and none is required. */
const struct kd_format *kd_cli_picture_format(const struct argp_state *state, const char *option, const char *path,
                                              bool required);

/* Plans a scene and renders what the format needs. Ctrl-C stops the rendering. *ms: render time. If the device is
 * lost, this function exits. The caller must finish *frame, even after an error. */
enum kd_status kd_cli_draw(struct kd_renderer *renderer, const struct kd_format *format, struct kd_scene *scene,
                           struct kd_plan *plan, struct kd_frame *frame, double *ms, struct kd_error *error);
/* Like kd_cli_draw, but the caller provides the plan. */
enum kd_status kd_cli_draw_planned(struct kd_renderer *renderer, const struct kd_scene *scene,
                                   const struct kd_plan *plan, struct kd_frame *frame, double *ms,
                                   struct kd_error *error);

#endif
