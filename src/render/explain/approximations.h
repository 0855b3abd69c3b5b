/* The list of all approximations, of pictures and of rays: docs/approximations.md and GET /v1/approximations. Any
 * thread. */
#ifndef KD_RENDER_EXPLAIN_APPROXIMATIONS_H
#define KD_RENDER_EXPLAIN_APPROXIMATIONS_H

#include "base/buffer.h"
#include "base/error.h"

/* Append the page, and the document {"approximations": [{"name", "of", "sentence"}]}. They fail with KD_ENOMEM
 * alone. */
enum kd_status kd_approximations_page(struct kd_buffer *page);
enum kd_status kd_approximations_json(struct kd_buffer *out);

#endif
