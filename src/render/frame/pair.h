/* A pair of pictures, one for each eye, side by side: two renders, one after the other. Render thread only. */
#ifndef KD_RENDER_FRAME_PAIR_H
#define KD_RENDER_FRAME_PAIR_H

#include "render/frame/frame.h"

struct kd_pair {
    struct kd_renderer *renderer;
    const struct kd_scene *scene; /* its camera.stereo is "pair" */
    const struct kd_plan *plan;   /* of both */
    bool aside;                   /* as kd_render_aside; nothing can be seen of it before it is done */
    kd_progress_fn progress;
    void *user;
};
/* *out is twice as wide as plan->width, the left eye's picture on the left, both at the exposure of that one; flux and centroid are not measured. */
enum kd_status kd_frame_pair(const struct kd_pair *pair, struct kd_frame *out, struct kd_error *error);

#endif
