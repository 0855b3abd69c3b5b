/* The displayed value of linear light on the host, for measuring the remaining error of pixels (kd_frame_residual of
 * frame/job.h). */
#ifndef KD_RENDER_FRAME_RESIDUAL_H
#define KD_RENDER_FRAME_RESIDUAL_H

#include "render/frame/job.h"

/* Linear light times the gain, as post.comp displays it, without bloom and before rounding: 0 to 1. tone_map:
 * KD_TONE_... Pure. */
void kd_frame_shown(const float light[3], double gain, int32_t tone_map, double out[3]);

#endif
