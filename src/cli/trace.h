/* Writes the steps of one ray, together with its roots, its end and its path. Any thread. */
#ifndef KD_CLI_TRACE_H
#define KD_CLI_TRACE_H

#include "base/buffer.h"
#include "render/explain/motion.h"
#include "render/rays/steps.h"

struct kd_described_steps {
    const struct kd_rays_steps *steps;
    bool points; /* text and CSV: true if they have the points of the path instead of the steps; JSON has both */
    struct kd_ray_motion motion;
    struct kd_ray_path path;
    struct kd_ray_end end; /* end of the ray, computed in closed form, as motion and path are */
    char why[320];
};

/* Computes everything except the steps. KD_ENOMEM: out of memory. The caller must finish *out in any case. */
enum kd_status kd_trace_explain(const struct kd_rays_steps *steps, bool points, struct kd_described_steps *out,
                                struct kd_error *error);
void kd_trace_finish(struct kd_described_steps *trace);

/* Append the steps as a table in text, as a JSON document, or as CSV. CSV has one line for each step or point;
 * missing values are empty cells. KD_ENOMEM. */
enum kd_status kd_trace_text(const struct kd_described_steps *trace, struct kd_buffer *out);
enum kd_status kd_trace_json(const struct kd_described_steps *trace, struct kd_buffer *out);
enum kd_status kd_trace_csv(const struct kd_described_steps *trace, struct kd_buffer *out);

#endif
