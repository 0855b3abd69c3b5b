/* Texel views of a buffer. A buffer caches the views that it was bound with, since most are bound repeatedly, and frees
 * them with itself. */
#ifndef KD_VK_VIEW_H
#define KD_VK_VIEW_H

#include "vk/functions.h"

#include <stdint.h>

struct kd_vk;
struct kd_vk_buffer;

struct kd_vk_view {
    struct kd_vk_view *next; /* of the same buffer */
    VkBufferView handle;
    VkFormat format;
    uint64_t offset, range;
    uint64_t ticket; /* last submission that uses it, recorded or submitted */
};

/* When a buffer has more views than this, an idle one is replaced. */
#define KD_VK_VIEWS_KEPT 8

/* Returns a view of these bytes for the submission being recorded. */
enum kd_status kd_vk_view_get(struct kd_vk *vk, struct kd_vk_buffer *buffer, VkFormat format, uint64_t offset,
                              uint64_t range, VkBufferView *out, struct kd_error *error);
/* Frees the views before the buffer is destroyed; the device no longer uses it. */
void kd_vk_views_finish(struct kd_vk *vk, struct kd_vk_buffer *buffer);

#endif
