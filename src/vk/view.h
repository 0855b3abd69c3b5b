/* Texel views of a buffer. A buffer caches the views with which it was bound, because most of them are used again. The
 * views are freed when the buffer is destroyed. */
#ifndef KD_VK_VIEW_H
#define KD_VK_VIEW_H

#include "vk/core.h"

#include <stdint.h>

struct kd_vk_view {
    struct kd_vk_view *next; /* next view of the same buffer */
    VkBufferView handle;
    VkFormat format;
    uint64_t offset, range;
    uint64_t ticket; /* number of the last submission that uses the view, recorded or submitted */
};

struct kd_vk_views {
    struct kd_vk_view *first;
    VkBuffer buffer;
    const char *name; /* of the buffer */
};

/* If a buffer has this many views, a new view replaces an idle one. */
#define KD_VK_VIEWS_KEPT 8

/* Returns a view of these bytes for the submission with this number. Submissions up to `done` have finished. */
enum kd_status kd_vk_view_get(struct kd_vk_views *views, const struct kd_vk_core *core, VkFormat format,
                              uint64_t offset, uint64_t range, uint64_t value, uint64_t done, VkBufferView *out,
                              struct kd_error *error);
/* Frees all views before the buffer is destroyed. The device must not use them any more. */
void kd_vk_views_finish(struct kd_vk_views *views, const struct kd_vk_core *core);

#endif
