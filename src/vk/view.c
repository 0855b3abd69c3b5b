#include "vk/view.h"

#include "vk/buffer.h"
#include "vk/device.h"

#include <stdlib.h>

static struct kd_vk_view *find(const struct kd_vk_buffer *buffer, VkFormat format, uint64_t offset, uint64_t range)
{
    struct kd_vk_view *view = buffer->views;
    while (view && (view->format != format || view->offset != offset || view->range != range))
        view = view->next;
    return view;
}

/* Destroys idle views until fewer than KD_VK_VIEWS_KEPT are left. Views in use stay. */
static void thin_out(struct kd_vk *vk, struct kd_vk_buffer *buffer)
{
    uint32_t n = 0;
    for (struct kd_vk_view **link = &buffer->views; *link;) {
        struct kd_vk_view *view = *link;
        if (++n < KD_VK_VIEWS_KEPT || view->ticket > vk->done) {
            link = &view->next;
            continue;
        }
        *link = view->next;
        vk->fn.DestroyBufferView(vk->device, view->handle, NULL);
        free(view);
    }
}

enum kd_status kd_vk_view_get(struct kd_vk *vk, struct kd_vk_buffer *buffer, VkFormat format, uint64_t offset,
                              uint64_t range, VkBufferView *out, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_vk_view *view = find(buffer, format, offset, range);
    if (!view) {
        const VkBufferViewCreateInfo info = { .sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                              .buffer = buffer->handle,
                                              .format = format,
                                              .offset = offset,
                                              .range = range };
        thin_out(vk, buffer);
        view = calloc(1, sizeof *view);
        if (!view)
            return kd_error_set(error, KD_ENOMEM, "no memory for a view of '%s'", buffer->name);
        KD_VK_TRY(&vk->fn, CreateBufferView, vk->device, &info, NULL, &view->handle);
        kd_vk_debug_name(vk, VK_OBJECT_TYPE_BUFFER_VIEW, KD_VK_HANDLE(view->handle), "texels of %s", buffer->name);
        view->format = format;
        view->offset = offset;
        view->range = range;
        view->next = buffer->views;
        buffer->views = view;
    }
    view->ticket = kd_vk_current(vk);
    *out = view->handle;
done:
    if (status)
        free(view);
    return status;
}

void kd_vk_views_finish(struct kd_vk *vk, struct kd_vk_buffer *buffer)
{
    while (buffer->views) {
        struct kd_vk_view *view = buffer->views;
        buffer->views = view->next;
        vk->fn.DestroyBufferView(vk->device, view->handle, NULL);
        free(view);
    }
}
