/* Cache of the pixels at the critical curve, for the most recent cameras. A picture needs them twice, for its plan and
 * for its lens map, and a view whose time runs needs them for every frame. Any thread. */
#ifndef KD_RENDER_VIEW_CRITICAL_KEPT_H
#define KD_RENDER_VIEW_CRITICAL_KEPT_H

#include "render/view/critical_pixels.h"

#define KD_CRITICAL_KEPT 16                      /* cameras, the latest */
#define KD_CRITICAL_KEPT_BYTES ((size_t)4 << 20) /* of all their lists; a longer one is not kept */

/* Gives what kd_critical_pixels_of does; the caller's to finish. */
enum kd_status kd_critical_kept(const struct kd_scene *scene, struct kd_critical_pixels *out, struct kd_error *error);

#endif
