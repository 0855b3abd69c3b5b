/* Cache of the pixels at the critical curve, for the most recent cameras. A picture needs these pixels for its plan and
 * for its lens map. A view in which time runs needs them for every frame. Any thread. */
#ifndef KD_RENDER_VIEW_CRITICAL_CACHE_H
#define KD_RENDER_VIEW_CRITICAL_CACHE_H

#include "render/view/critical_pixels.h"

#define KD_CRITICAL_KEPT 16                       /* number of cameras; the least recently used one is evicted */
#define KD_CRITICAL_CACHE_BYTES ((size_t)4 << 20) /* total size of the lists; a longer list is not cached */

/* Gets the list of kd_critical_pixels_of, from the cache if possible. The caller must finish the list. */
enum kd_status kd_critical_cache(const struct kd_scene *scene, struct kd_critical_pixels *out, struct kd_error *error);

#endif
