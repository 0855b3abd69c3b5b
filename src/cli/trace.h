/* This writes the steps of one ray as text. Any thread. */
#ifndef KD_CLI_TRACE_H
#define KD_CLI_TRACE_H

#include "base/buffer.h"
#include "render/rays/steps.h"

/* A table for eyes; a JSON document; CSV, one line a step with empty cells for what does not exist. KD_ENOMEM alone. */
enum kd_status kd_trace_text(const struct kd_rays_steps *steps, struct kd_buffer *out);
enum kd_status kd_trace_json(const struct kd_rays_steps *steps, struct kd_buffer *out);
enum kd_status kd_trace_csv(const struct kd_rays_steps *steps, struct kd_buffer *out);

#endif
