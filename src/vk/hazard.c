#include "vk/hazard.h"

static bool conflict(const struct kd_vk_access *a, const struct kd_vk_access *b)
{
    return a->buffer == b->buffer && (a->write || b->write) && a->begin < b->end && b->begin < a->end;
}

static bool conflicts(const struct kd_vk_hazards *hazards, const struct kd_vk_access *accesses, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < hazards->count; j++)
            if (conflict(&accesses[i], &hazards->list[j]))
                return true;
    return false;
}

static VkAccessFlags writes(VkPipelineStageFlags stages)
{
    return (stages & VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT ? VK_ACCESS_SHADER_WRITE_BIT : 0u) |
           (stages & VK_PIPELINE_STAGE_TRANSFER_BIT ? VK_ACCESS_TRANSFER_WRITE_BIT : 0u);
}

/* Makes a barrier against all listed accesses. For reads only the stage matters, because a write after a read needs
 * ordering but no flush. */
static struct kd_vk_barrier everything(const struct kd_vk_hazards *hazards)
{
    struct kd_vk_barrier barrier = {
        .dst_stages =
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
        .dst_access = VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                      VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
    };
    for (size_t i = 0; i < hazards->count; i++) {
        barrier.src_stages |= hazards->list[i].stage;
        if (hazards->list[i].write)
            barrier.src_access |= writes(hazards->list[i].stage);
    }
    return barrier;
}

/* Extends an entry whose range touches that of the access, or appends a new entry. If ranges touch, their union is
 * exact, so that tiles written side by side remain one entry. */
static void enter(struct kd_vk_hazards *hazards, const struct kd_vk_access *access)
{
    for (size_t i = 0; i < hazards->count; i++) {
        struct kd_vk_access *old = &hazards->list[i];
        if (old->buffer == access->buffer && old->stage == access->stage && old->write == access->write &&
            old->begin <= access->end && access->begin <= old->end) {
            if (access->begin < old->begin)
                old->begin = access->begin;
            if (access->end > old->end)
                old->end = access->end;
            return;
        }
    }
    hazards->list[hazards->count++] = *access;
}

bool kd_vk_hazards_add(struct kd_vk_hazards *hazards, const struct kd_vk_access *accesses, size_t n,
                       struct kd_vk_barrier *barrier)
{
    bool full = hazards->count + n > KD_VK_MAX_ACCESSES;
    bool needed = full || conflicts(hazards, accesses, n);
    if (needed) {
        *barrier = everything(hazards);
        hazards->count = 0;
    }
    for (size_t i = 0; i < n; i++) {
        enter(hazards, &accesses[i]);
        if (accesses[i].write && accesses[i].host)
            hazards->host_stages |= accesses[i].stage;
    }
    return needed;
}

bool kd_vk_hazards_to_host(struct kd_vk_hazards *hazards, struct kd_vk_barrier *barrier)
{
    if (!hazards->host_stages)
        return false;
    *barrier = (struct kd_vk_barrier) { .src_stages = hazards->host_stages,
                                        .src_access = writes(hazards->host_stages),
                                        .dst_stages = VK_PIPELINE_STAGE_HOST_BIT,
                                        .dst_access = VK_ACCESS_HOST_READ_BIT };
    hazards->host_stages = 0;
    return true;
}
