/* This writes docs/approximations.md: every sentence that a plan may have, by emitter. Any thread. */
#ifndef KD_RENDER_PLAN_REFERENCE_H
#define KD_RENDER_PLAN_REFERENCE_H

#include "base/buffer.h"
#include "base/error.h"

/* Appends the page. Fails with KD_ENOMEM alone. */
enum kd_status kd_plan_reference(struct kd_buffer *page);

#endif
