/* Lists all approximations, of pictures and of rays, for docs/approximations.md and GET /v1/approximations. Any
 * thread. */
#ifndef KD_RENDER_EXPLAIN_APPROXIMATIONS_H
#define KD_RENDER_EXPLAIN_APPROXIMATIONS_H

#include "base/buffer.h"
#include "base/error.h"

/* Append the page, or the JSON document {"approximations": [{"name", "of", "sentence"}]}. The only error is
 * KD_ENOMEM. */
enum kd_status kd_approximations_page(struct kd_buffer *page);
enum kd_status kd_approximations_json(struct kd_buffer *out);

#endif
