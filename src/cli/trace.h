/* Writes the steps of one ray as text, with the case of its roots, why it ends, and its path. Any thread. */
#ifndef KD_CLI_TRACE_H
#define KD_CLI_TRACE_H

#include "base/buffer.h"
#include "render/explain/motion.h"
#include "render/rays/steps.h"

struct kd_told_steps {
    const struct kd_rays_steps *steps;
    bool points; /* text and CSV have the path's points, and not the steps; JSON has both */
    struct kd_ray_motion motion;
    struct kd_ray_path path;
    struct kd_ray_end end; /* by closed form, as are motion and path */
    char why[320];
};

/* What steps do not say. KD_ENOMEM. Finish *out in any case. */
enum kd_status kd_trace_explain(const struct kd_rays_steps *steps, bool points, struct kd_told_steps *out,
                                struct kd_error *error);
void kd_trace_finish(struct kd_told_steps *trace);

/* A table for eyes; a JSON document; CSV, one line a step or point with empty cells for what does not exist.
 * KD_ENOMEM alone. */
enum kd_status kd_trace_text(const struct kd_told_steps *trace, struct kd_buffer *out);
enum kd_status kd_trace_json(const struct kd_told_steps *trace, struct kd_buffer *out);
enum kd_status kd_trace_csv(const struct kd_told_steps *trace, struct kd_buffer *out);

#endif
