#include "vk/view.h"

#include <stdlib.h>

static struct kd_vk_view *find(const struct kd_vk_views *views, VkFormat format, uint64_t offset, uint64_t range)
{
    struct kd_vk_view *view = views->first;
    while (view && (view->format != format || view->offset != offset || view->range != range))
        view = view->next;
    return view;
}

/* Destroys idle views until fewer than KD_VK_VIEWS_KEPT are left. Views in use stay. */
static void thin_out(struct kd_vk_views *views, const struct kd_vk_core *core, uint64_t done)
{
    uint32_t n = 0;
    for (struct kd_vk_view **link = &views->first; *link;) {
        struct kd_vk_view *view = *link;
        if (++n < KD_VK_VIEWS_KEPT || view->ticket > done) {
            link = &view->next;
            continue;
        }
        *link = view->next;
        core->fn.DestroyBufferView(core->device, view->handle, NULL);
        free(view);
    }
}

enum kd_status kd_vk_view_get(struct kd_vk_views *views, const struct kd_vk_core *core, VkFormat format,
                              uint64_t offset, uint64_t range, uint64_t value, uint64_t done, VkBufferView *out,
                              struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_vk_view *view = find(views, format, offset, range);
    if (!view) {
        const VkBufferViewCreateInfo info = { .sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                              .buffer = views->buffer,
                                              .format = format,
                                              .offset = offset,
                                              .range = range };
        thin_out(views, core, done);
        view = calloc(1, sizeof *view);
        if (!view)
            return kd_error_set(error, KD_ENOMEM, "no memory for a view of '%s'", views->name);
        KD_VK_TRY(&core->fn, CreateBufferView, core->device, &info, NULL, &view->handle);
        kd_vk_name(core, VK_OBJECT_TYPE_BUFFER_VIEW, KD_VK_HANDLE(view->handle), "texels of %s", views->name);
        view->format = format;
        view->offset = offset;
        view->range = range;
        view->next = views->first;
        views->first = view;
    }
    view->ticket = value;
    *out = view->handle;
done:
    if (status)
        free(view);
    return status;
}

void kd_vk_views_finish(struct kd_vk_views *views, const struct kd_vk_core *core)
{
    while (views->first) {
        struct kd_vk_view *view = views->first;
        views->first = view->next;
        core->fn.DestroyBufferView(core->device, view->handle, NULL);
        free(view);
    }
}
