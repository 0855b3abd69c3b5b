/* These are views of a buffer as texels. A buffer keeps those that it was bound with, as most are bound again and
 * again, and takes them along when it is freed. */
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
    uint64_t ticket; /* last submission that uses it, recorded or under way */
};

/* Beyond so many, an idle view of the buffer gives its place to a new one. */
#define KD_VK_VIEWS_KEPT 8

/* A view of these bytes, for the submission that is being recorded. */
enum kd_status kd_vk_view_get(struct kd_vk *vk, struct kd_vk_buffer *buffer, VkFormat format, uint64_t offset,
                              uint64_t range, VkBufferView *out, struct kd_error *error);
/* Before the buffer is destroyed, which nothing uses any more. */
void kd_vk_views_finish(struct kd_vk *vk, struct kd_vk_buffer *buffer);

#endif
