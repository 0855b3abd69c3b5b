#include "vk/buffer.h"

#include "vk/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void buffer_free(struct kd_vk *vk, struct kd_vk_retired *object)
{
    struct kd_vk_buffer *buffer = (struct kd_vk_buffer *)object;
    kd_vk_mapped_forget(&vk->mapped, &buffer->mapped);
    kd_vk_views_finish(&buffer->views, &vk->core);
    vk->core.fn.DestroyBuffer(vk->core.device, buffer->handle, NULL);
    if (buffer->slice.block)
        kd_vk_heap_give(&vk->heap, &vk->core, &buffer->slice);
    vk->n_buffers--;
    free(buffer);
}

/* Takes memory. If there is none, tries once more with the memory of retired buffers. */
static enum kd_status take_memory(struct kd_vk *vk, struct kd_vk_buffer *buffer, const VkMemoryRequirements *needs,
                                  struct kd_error *error)
{
    enum kd_status status =
        kd_vk_heap_take(&vk->heap, &vk->core, buffer->memory, needs->size, needs->alignment, &buffer->slice, error);
    if (status == KD_ENOMEM && vk->retired && !kd_vk_wait(vk, 0, NULL))
        status =
            kd_vk_heap_take(&vk->heap, &vk->core, buffer->memory, needs->size, needs->alignment, &buffer->slice, error);
    return status;
}

static enum kd_status buffer_init(struct kd_vk *vk, struct kd_vk_buffer *buffer, struct kd_error *error)
{
    enum kd_status status;
    VkMemoryRequirements needs;
    const VkBufferCreateInfo info = { .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .size = buffer->size,
                                      .usage = KD_VK_BUFFER_USAGE };
    KD_VK_TRY(&vk->core.fn, CreateBuffer, vk->core.device, &info, NULL, &buffer->handle);
    vk->core.fn.GetBufferMemoryRequirements(vk->core.device, buffer->handle, &needs);
    KD_TRY(take_memory(vk, buffer, &needs, error));
    KD_VK_TRY(&vk->core.fn, BindBufferMemory, vk->core.device, buffer->handle, buffer->slice.block->memory,
              buffer->slice.offset);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_BUFFER, KD_VK_HANDLE(buffer->handle), "%s", buffer->name);
done:
    return status;
}

enum kd_status kd_vk_buffer_create(struct kd_vk *vk, uint64_t size, enum kd_vk_memory memory, const char *name,
                                   struct kd_vk_buffer **out, struct kd_error *error)
{
    *out = NULL;
    enum kd_status status = kd_vk_alive(&vk->core, error);
    if (status)
        return status;
    if (!name)
        name = "unnamed";
    if (!size)
        return kd_error_set(error, KD_EINTERNAL, "buffer '%s' has no bytes", name);
    /* The size is checked before vkCreateBuffer, which need not accept every size. */
    if (size > vk->core.physical.info.max_allocation_bytes)
        return kd_error_set(error, KD_ENOMEM,
                            "buffer '%s' has %.2f MiB; on this device one allocation must have at most %.2f MiB", name,
                            (double)size / 0x1p20, (double)vk->core.physical.info.max_allocation_bytes / 0x1p20);
    struct kd_vk_buffer *buffer = calloc(1, sizeof *buffer);
    if (!buffer)
        return kd_error_set(error, KD_ENOMEM, "buffer '%s': out of host memory", name);
    buffer->retired.free = buffer_free;
    buffer->id = ++vk->next_buffer_id;
    buffer->size = size;
    buffer->memory = memory;
    snprintf(buffer->name, sizeof buffer->name, "%s", name);
    vk->n_buffers++;
    struct kd_error why = { 0 };
    status = buffer_init(vk, buffer, &why);
    if (status) {
        buffer_free(vk, &buffer->retired);
        return kd_error_set(error, status, "buffer '%s': %s", name, why.message);
    }
    buffer->mapped = (struct kd_vk_mapped) { .slice = &buffer->slice, .memory = memory };
    buffer->views = (struct kd_vk_views) { .buffer = buffer->handle, .name = buffer->name };
    if (!buffer->slice.block->coherent && kd_vk_buffer_map(buffer))
        kd_vk_mapped_enter(&vk->mapped, &buffer->mapped);
    /* filled with zeros, because no kernel will write this buffer */
    if (vk->core.compiles_only && memory == KD_VK_READBACK)
        memset(kd_vk_buffer_map(buffer), 0, size);
    *out = buffer;
    return KD_OK;
}

void kd_vk_buffer_destroy(struct kd_vk *vk, struct kd_vk_buffer *buffer)
{
    if (buffer)
        kd_vk_retire(vk, &buffer->retired);
}

void *kd_vk_buffer_map(struct kd_vk_buffer *buffer)
{
    uint8_t *map = buffer->slice.block->map;
    return map && (buffer->slice.block->coherent || buffer->memory != KD_VK_DEVICE) ? map + buffer->slice.offset : NULL;
}

uint64_t kd_vk_buffer_size(const struct kd_vk_buffer *buffer) { return buffer->size; }
