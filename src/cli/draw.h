/* These draw one picture for the command line: its format, the plan, a bar of progress, and a device that was lost
 * on the way. Main thread only. */
#ifndef KD_CLI_DRAW_H
#define KD_CLI_DRAW_H

#include "render/output/format.h"
#include "render/render.h"

#include <argp.h>

/* The format that the name of a picture's file ends as (cli/ending.h); NULL: the name says nothing, and is not required
 * to. */
const struct kd_format *kd_cli_picture_format(const struct argp_state *state, const char *option, const char *path,
                                              bool required);

/* Plans and renders what the format needs of a scene; Ctrl-C stops it. *ms: what rendering took. The program ends
 * where the device is lost. *frame is the caller's to finish, also on error. */
enum kd_status kd_cli_draw(struct kd_renderer *renderer, const struct kd_format *format, struct kd_scene *scene,
                           struct kd_plan *plan, struct kd_frame *frame, double *ms, struct kd_error *error);

#endif
