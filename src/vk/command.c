/* Records dispatches, copies and fills, with their barriers and timestamps (vk.h). */
#include "vk/barrier.h"
#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/kind.h"
#include "vk/pipeline.h"
#include "vk/submit.h"

#include <inttypes.h>

enum { COUNTS_BYTES = 12 }; /* size of the counts of an indirect dispatch */

/* Bytes of a binding. A binding of texels has only complete texels. */
static uint64_t size_of(const struct kd_vk_binding *binding, enum kd_vk_kind kind)
{
    uint64_t size = binding->size ? binding->size : binding->buffer->size - binding->offset;
    uint32_t texel = kd_vk_kind_info(kind)->texel_bytes;
    return texel ? size / texel * texel : size;
}

static bool inside(const struct kd_vk_buffer *buffer, uint64_t offset, uint64_t size)
{
    return offset <= buffer->size && size <= buffer->size - offset;
}

/* Size in bytes of the largest binding of a kind on this device. */
static uint64_t most_of(const struct kd_vk *vk, enum kd_vk_kind kind)
{
    const struct kd_vk_info *info = &vk->core.physical.info;
    uint32_t texel = kd_vk_kind_info(kind)->texel_bytes;
    return texel ? info->max_texels * texel : kind == KD_VK_UNIFORM ? info->max_uniform_bytes : info->max_binding_bytes;
}

/* Checks the rules that differ from kind to kind. */
static enum kd_status check_kind(const struct kd_vk *vk, const char *pass, uint32_t index,
                                 const struct kd_vk_binding *binding, enum kd_vk_kind kind, struct kd_error *error)
{
    uint64_t size = size_of(binding, kind), most = most_of(vk, kind);
    uint32_t texel = kd_vk_kind_info(kind)->texel_bytes;
    if (binding->write && kind != KD_VK_STORAGE)
        return kd_error_set(error, KD_EINTERNAL, "%s: binding %u, '%s', is written, but is not a storage buffer", pass,
                            index, binding->buffer->name);
    if (!size || (binding->size && size != binding->size))
        return kd_error_set(error, KD_EINTERNAL, "%s: binding %u, '%s', must span whole texels of %u bytes", pass,
                            index, binding->buffer->name, texel);
    if (size > most)
        return kd_error_set(error, KD_ETOOBIG,
                            "%s: binding %u spans %" PRIu64
                            " bytes of '%s'; on this device it must have at most %" PRIu64,
                            pass, index, size, binding->buffer->name, most);
    return KD_OK;
}

static enum kd_status check_binding(const struct kd_vk *vk, const char *pass, uint32_t index,
                                    const struct kd_vk_binding *binding, enum kd_vk_kind kind, struct kd_error *error)
{
    if (!binding->buffer)
        return kd_error_set(error, KD_EINTERNAL, "%s: binding %u has no buffer", pass, index);
    if (binding->offset % KD_VK_ALIGNMENT || binding->offset >= binding->buffer->size ||
        !inside(binding->buffer, binding->offset, binding->size))
        return kd_error_set(error, KD_EINTERNAL,
                            "%s: binding %u, bytes %" PRIu64 "+%" PRIu64 " of '%s' (%" PRIu64
                            " bytes), must lie inside it and begin at a multiple of %u",
                            pass, index, binding->offset, binding->size, binding->buffer->name, binding->buffer->size,
                            KD_VK_ALIGNMENT);
    return check_kind(vk, pass, index, binding, kind, error);
}

static enum kd_status check_dispatch(const struct kd_vk *vk, const struct kd_vk_dispatch *dispatch, const char *pass,
                                     struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (!dispatch->pipeline)
        return kd_error_set(error, KD_EINTERNAL, "%s: a dispatch without a pipeline", pass);
    for (int i = 0; i < 3; i++)
        if (dispatch->groups[i] > vk->core.physical.properties.limits.maxComputeWorkGroupCount[i])
            return kd_error_set(
                error, KD_ETOOBIG, "%s: %u groups along axis %d; on this device there must be at most %u", pass,
                dispatch->groups[i], i, vk->core.physical.properties.limits.maxComputeWorkGroupCount[i]);
    if (dispatch->counts && (dispatch->counts_at % 4 || !inside(dispatch->counts, dispatch->counts_at, COUNTS_BYTES)))
        return kd_error_set(error, KD_EINTERNAL,
                            "%s: counts at %" PRIu64 " of '%s' (%" PRIu64
                            " bytes) must lie inside it, at a multiple of 4",
                            pass, dispatch->counts_at, dispatch->counts->name, dispatch->counts->size);
    if (dispatch->pipeline->push_bytes && !dispatch->push)
        return kd_error_set(error, KD_EINTERNAL, "%s: the push constants are missing", pass);
    for (uint32_t i = 0; i < dispatch->pipeline->n_buffers && !status; i++)
        status = check_binding(vk, pass, i, &dispatch->bindings[i], dispatch->pipeline->kinds[i], error);
    return status;
}

static struct kd_vk_access access_of(struct kd_vk *vk, struct kd_vk_buffer *buffer, uint64_t begin, uint64_t end,
                                     VkPipelineStageFlags stage, bool write)
{
    kd_vk_mapped_use(&buffer->mapped, kd_vk_current(vk), write);
    return (struct kd_vk_access) { .buffer = buffer->id,
                                   .begin = begin,
                                   .end = end,
                                   .stage = stage,
                                   .write = write,
                                   .host = kd_vk_buffer_map(buffer) != NULL };
}

static enum kd_status bind_buffers(struct kd_vk *vk, struct kd_vk_slot *slot, const struct kd_vk_dispatch *dispatch,
                                   struct kd_error *error)
{
    VkDescriptorSet set;
    VkDescriptorBufferInfo buffers[KD_VK_MAX_BINDINGS];
    VkBufferView views[KD_VK_MAX_BINDINGS];
    VkWriteDescriptorSet writes[KD_VK_MAX_BINDINGS];
    const struct kd_vk_pipeline *pipeline = dispatch->pipeline;
    if (!pipeline->n_buffers)
        return KD_OK;
    enum kd_status status = kd_vk_descriptors_take(&vk->core, &slot->descriptors, pipeline->set_layout, &set, error);
    if (status)
        return status;
    for (uint32_t i = 0; i < pipeline->n_buffers; i++) {
        const struct kd_vk_binding *b = &dispatch->bindings[i];
        const struct kd_vk_kind_info *kind = kd_vk_kind_info(pipeline->kinds[i]);
        buffers[i] = (VkDescriptorBufferInfo) { b->buffer->handle, b->offset, size_of(b, pipeline->kinds[i]) };
        writes[i] = (VkWriteDescriptorSet) { .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                             .dstSet = set,
                                             .dstBinding = i,
                                             .descriptorCount = 1,
                                             .descriptorType = kind->descriptor,
                                             .pBufferInfo = &buffers[i],
                                             .pTexelBufferView = &views[i] };
        if (kind->texel_bytes &&
            (status = kd_vk_view_get(&b->buffer->views, &vk->core, kind->format, b->offset, buffers[i].range,
                                     kd_vk_current(vk), vk->done, &views[i], error)))
            return status;
    }
    vk->core.fn.UpdateDescriptorSets(vk->core.device, pipeline->n_buffers, writes, 0, NULL);
    vk->core.fn.CmdBindDescriptorSets(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline->layout, 0, 1, &set, 0,
                                      NULL);
    return KD_OK;
}

static void order_dispatch(struct kd_vk *vk, struct kd_vk_slot *slot, const struct kd_vk_dispatch *dispatch)
{
    struct kd_vk_access accesses[KD_VK_MAX_BINDINGS + 1];
    uint32_t n = dispatch->pipeline->n_buffers;
    for (uint32_t i = 0; i < n; i++) {
        const struct kd_vk_binding *b = &dispatch->bindings[i];
        accesses[i] = access_of(vk, b->buffer, b->offset, b->offset + size_of(b, dispatch->pipeline->kinds[i]),
                                VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, b->write);
        b->buffer->retired.ticket = kd_vk_current(vk);
    }
    if (dispatch->counts) {
        accesses[n++] = access_of(vk, dispatch->counts, dispatch->counts_at, dispatch->counts_at + COUNTS_BYTES,
                                  VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, false);
        dispatch->counts->retired.ticket = kd_vk_current(vk);
    }
    kd_vk_barrier_before(&vk->core.fn, &vk->hazards, slot->commands, accesses, n);
}

static void dispatch_groups(struct kd_vk *vk, VkCommandBuffer commands, const struct kd_vk_dispatch *dispatch)
{
    const uint32_t *groups = dispatch->groups;
    if (vk->core.compiles_only)
        vk->core.fn.CmdDispatch(commands, 0, 0, 0);
    else if (dispatch->counts)
        vk->core.fn.CmdDispatchIndirect(commands, dispatch->counts->handle, dispatch->counts_at);
    else
        vk->core.fn.CmdDispatch(commands, groups[0] + !groups[0], groups[1] + !groups[1], groups[2] + !groups[2]);
}

enum kd_status kd_vk_dispatch(struct kd_vk *vk, const struct kd_vk_dispatch *dispatch, struct kd_error *error)
{
    struct kd_vk_slot *slot;
    const char *pass = dispatch->pass ? dispatch->pass : dispatch->pipeline ? dispatch->pipeline->name : "unnamed";
    enum kd_status status;
    KD_TRY(check_dispatch(vk, dispatch, pass, error));
    KD_TRY(kd_vk_submit_slot(vk, &slot, error));
    KD_TRY(bind_buffers(vk, slot, dispatch, error));
    const struct kd_vk_pipeline *pipeline = dispatch->pipeline;
    kd_vk_timing_pass(&vk->timing, &vk->core, &slot->stamps, slot->commands, pass);
    order_dispatch(vk, slot, dispatch);
    vk->core.fn.CmdBindPipeline(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline->handle);
    if (pipeline->push_bytes)
        vk->core.fn.CmdPushConstants(slot->commands, pipeline->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     pipeline->push_bytes, dispatch->push);
    dispatch_groups(vk, slot->commands, dispatch);
    /* The pipeline is const for callers only; this layer may write it. */
    ((struct kd_vk_pipeline *)pipeline)->retired.ticket = kd_vk_current(vk);
done:
    return status;
}

enum kd_status kd_vk_copy(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *to, uint64_t to_offset,
                          struct kd_vk_buffer *from, uint64_t from_offset, uint64_t size, struct kd_error *error)
{
    struct kd_vk_slot *slot;
    if (!pass)
        pass = "copy";
    if (!inside(to, to_offset, size) || !inside(from, from_offset, size))
        return kd_error_set(error, KD_EINTERNAL,
                            "%s: %" PRIu64 " bytes from %" PRIu64 " of '%s' (%" PRIu64 ") to %" PRIu64
                            " of '%s' (%" PRIu64 ") reach outside",
                            pass, size, from_offset, from->name, from->size, to_offset, to->name, to->size);
    if (to == from && to_offset < from_offset + size && from_offset < to_offset + size)
        return kd_error_set(error, KD_EINTERNAL, "%s: the two ranges of '%s' overlap", pass, to->name);
    if (!size)
        return kd_vk_alive(&vk->core, error);
    if (vk->core.compiles_only && to->memory == KD_VK_READBACK)
        return kd_vk_fill(vk, pass, to, to_offset / 4 * 4, size / 4 * 4, 0, error);
    enum kd_status status = kd_vk_submit_slot(vk, &slot, error);
    if (status)
        return status;
    const struct kd_vk_access accesses[] = {
        access_of(vk, from, from_offset, from_offset + size, VK_PIPELINE_STAGE_TRANSFER_BIT, false),
        access_of(vk, to, to_offset, to_offset + size, VK_PIPELINE_STAGE_TRANSFER_BIT, true),
    };
    const VkBufferCopy region = { from_offset, to_offset, size };
    kd_vk_timing_pass(&vk->timing, &vk->core, &slot->stamps, slot->commands, pass);
    kd_vk_barrier_before(&vk->core.fn, &vk->hazards, slot->commands, accesses, 2);
    vk->core.fn.CmdCopyBuffer(slot->commands, from->handle, to->handle, 1, &region);
    to->retired.ticket = from->retired.ticket = kd_vk_current(vk);
    return KD_OK;
}

enum kd_status kd_vk_fill(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *buffer, uint64_t offset,
                          uint64_t size, uint32_t value, struct kd_error *error)
{
    struct kd_vk_slot *slot;
    if (!inside(buffer, offset, size) || offset % 4 || size % 4)
        return kd_error_set(error, KD_EINTERNAL,
                            "fill: bytes %" PRIu64 "+%" PRIu64 " of '%s' (%" PRIu64
                            " bytes) must lie inside it, in multiples of 4",
                            offset, size, buffer->name, buffer->size);
    if (!size)
        return kd_vk_alive(&vk->core, error);
    enum kd_status status = kd_vk_submit_slot(vk, &slot, error);
    if (status)
        return status;
    const struct kd_vk_access access =
        access_of(vk, buffer, offset, offset + size, VK_PIPELINE_STAGE_TRANSFER_BIT, true);
    kd_vk_timing_pass(&vk->timing, &vk->core, &slot->stamps, slot->commands, pass);
    kd_vk_barrier_before(&vk->core.fn, &vk->hazards, slot->commands, &access, 1);
    vk->core.fn.CmdFillBuffer(slot->commands, buffer->handle, offset, size, value);
    buffer->retired.ticket = kd_vk_current(vk);
    return KD_OK;
}

size_t kd_vk_times(const struct kd_vk *vk, struct kd_vk_time out[KD_VK_MAX_PASSES])
{
    return kd_vk_timing_totals(&vk->timing, out);
}

void kd_vk_times_reset(struct kd_vk *vk) { kd_vk_timing_reset(&vk->timing); }
