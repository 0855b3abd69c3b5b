/* Computes the displayed value of linear light on the host, to measure the remaining error of pixels
 * (kd_frame_residual of frame/job.h). */
#ifndef KD_RENDER_FRAME_RESIDUAL_H
#define KD_RENDER_FRAME_RESIDUAL_H

#include "render/frame/job.h"

/* The displayed value, 0 to 1, of linear light times the gain, as post.comp computes it, without bloom and before
 * rounding. tone_map: KD_TONE_... Pure. */
void kd_frame_shown(const float light[3], double gain, int32_t tone_map, double out[3]);

#endif
