#include "vk/submit.h"

#include "vk/barrier.h"
#include "vk/device.h"
#include "base/clock.h"

#include <inttypes.h>
#include <time.h>

static uint64_t now_ns(void) { return (uint64_t)(kd_clock_ms() * 1e6); }

static struct kd_vk_slot *slot_of(struct kd_vk *vk, uint64_t value) { return &vk->slots[value % KD_VK_SLOTS]; }

static enum kd_status slot_init(struct kd_vk *vk, uint32_t index, struct kd_error *error)
{
    enum kd_status status;
    struct kd_vk_slot *slot = &vk->slots[index];
    const VkCommandPoolCreateInfo pool = { .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                           .queueFamilyIndex = vk->core.physical.family };
    KD_VK_TRY(&vk->core.fn, CreateCommandPool, vk->core.device, &pool, NULL, &slot->pool);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_COMMAND_POOL, KD_VK_HANDLE(slot->pool), "slot %u", index);
    const VkCommandBufferAllocateInfo buffer = { .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                 .commandPool = slot->pool,
                                                 .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                 .commandBufferCount = 1 };
    KD_VK_TRY(&vk->core.fn, AllocateCommandBuffers, vk->core.device, &buffer, &slot->commands);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_COMMAND_BUFFER, KD_VK_HANDLE(slot->commands), "slot %u", index);
done:
    return status;
}

enum kd_status kd_vk_submit_init(struct kd_vk *vk, struct kd_error *error)
{
    enum kd_status status;
    const VkSemaphoreTypeCreateInfo type = { .sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                             .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE };
    const VkSemaphoreCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type };
    KD_VK_TRY(&vk->core.fn, CreateSemaphore, vk->core.device, &info, NULL, &vk->timeline);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_SEMAPHORE, KD_VK_HANDLE(vk->timeline), "timeline");
    for (uint32_t i = 0; i < KD_VK_SLOTS; i++)
        KD_TRY(slot_init(vk, i, error));
done:
    return status;
}

void kd_vk_submit_finish(struct kd_vk *vk)
{
    for (uint32_t i = 0; i < KD_VK_SLOTS; i++) {
        struct kd_vk_slot *slot = &vk->slots[i];
        kd_vk_descriptors_finish(&vk->core, &slot->descriptors);
        kd_vk_timing_finish(&vk->core, &slot->stamps);
        vk->core.fn.DestroyCommandPool(vk->core.device, slot->pool, NULL); /* also frees the pool's command buffer */
    }
    vk->core.fn.DestroySemaphore(vk->core.device, vk->timeline, NULL);
}

/* Returns the error of a failed call. If it is a device error, marks the device as lost. */
static enum kd_status failed(struct kd_vk *vk, struct kd_error *error, VkResult result, const char *call)
{
    enum kd_status status = kd_vk_result_error(error, result, call);
    return status == KD_EDEVICE ? kd_vk_lose(&vk->core, error, "%s: %s", call, kd_vk_result_name(result)) : status;
}

/* Called when the timeline has reached a value. Collects the submissions that have finished. */
static enum kd_status reached(struct kd_vk *vk, uint64_t value, struct kd_error *error)
{
    if (value <= vk->done)
        return KD_OK;
    for (uint64_t v = vk->done + 1; v <= value; v++)
        kd_vk_timing_collect(&vk->timing, &vk->core, &slot_of(vk, v)->stamps);
    vk->done = value;
    vk->progress_ns = now_ns();
    kd_vk_retired_free(&vk->retired, vk, vk->done);
    VkResult result = kd_vk_mapped_invalidate(vk->mapped, &vk->core, vk->done);
    return result < 0 ? failed(vk, error, result, "vkInvalidateMappedMemoryRanges") : KD_OK;
}

static enum kd_status poll_timeline(struct kd_vk *vk, struct kd_error *error)
{
    uint64_t value = 0;
    VkResult result = vk->core.fn.GetSemaphoreCounterValue(vk->core.device, vk->timeline, &value);
    if (result < 0)
        return failed(vk, error, result, "vkGetSemaphoreCounterValue");
    /* A dying driver may report any value. */
    return reached(vk, value < vk->submitted ? value : vk->submitted, error);
}

/* Time added to a deadline. After a virtual machine was stopped, the wait may time out although the work has
 * finished. */
#define GRACE_NS 1000000000u
#define STARVED 8 /* number of deadlines after which a software device with little processor time is given up */

/* Processor time of this process; 0 if it is unknown. */
static uint64_t processor_ns(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t) ? 0 : (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

/* Waits once. The threads of a software device belong to this process. On a busy machine such a device may need more
 * than a deadline to compile a kernel. Therefore a deadline does not count if the process had the processor for less
 * than half of the deadline. At most STARVED deadlines are ignored in this way. */
static VkResult wait_for(struct kd_vk *vk, const VkSemaphoreWaitInfo *info, uint64_t timeout)
{
    VkResult result = VK_TIMEOUT;
    for (int i = 0; i < STARVED && result == VK_TIMEOUT; i++) {
        const uint64_t before = processor_ns();
        result = vk->core.fn.WaitSemaphores(vk->core.device, info, i ? vk->deadline_ns : timeout);
        if (vk->core.physical.info.type != KD_VK_CPU || processor_ns() - before >= (i ? vk->deadline_ns : timeout) / 2)
            break;
    }
    return result;
}

/* Waits for the next unfinished submission. Its deadline counts from the time at which it could first start. */
static enum kd_status wait_one(struct kd_vk *vk, uint64_t value, struct kd_error *error)
{
    uint64_t start = slot_of(vk, value)->submitted_ns, now = now_ns();
    if (start < vk->progress_ns)
        start = vk->progress_ns;
    uint64_t timeout = start + vk->deadline_ns > now ? start + vk->deadline_ns - now : 0;
    const VkSemaphoreWaitInfo info = { .sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                       .semaphoreCount = 1,
                                       .pSemaphores = &vk->timeline,
                                       .pValues = &value };
    VkResult result = wait_for(vk, &info, timeout);
    if (result == VK_TIMEOUT)
        result = vk->core.fn.WaitSemaphores(vk->core.device, &info, GRACE_NS);
    if (result == VK_TIMEOUT) {
        vk->core.hangs = true;
        return kd_vk_lose(&vk->core, error, "submission %" PRIu64 " missed its deadline of %" PRIu64 " ms", value,
                          vk->deadline_ns / 1000000);
    }
    if (result < 0)
        return failed(vk, error, result, "vkWaitSemaphores");
    return reached(vk, value, error);
}

enum kd_status kd_vk_wait(struct kd_vk *vk, uint64_t ticket, struct kd_error *error)
{
    enum kd_status status = kd_vk_alive(&vk->core, error);
    if (status)
        return status;
    if (ticket > vk->submitted)
        return kd_error_set(error, KD_EINTERNAL, "there is no submission %" PRIu64 ", the last was %" PRIu64, ticket,
                            vk->submitted);
    if (!ticket)
        ticket = vk->submitted;
    if (vk->done < ticket)
        status = poll_timeline(vk, error);
    while (!status && vk->done < ticket)
        status = wait_one(vk, vk->done + 1, error);
    return status;
}

enum kd_status kd_vk_submit_slot(struct kd_vk *vk, struct kd_vk_slot **out, struct kd_error *error)
{
    enum kd_status status = kd_vk_alive(&vk->core, error);
    struct kd_vk_slot *slot = slot_of(vk, kd_vk_current(vk));
    *out = slot;
    if (!status && vk->core.pipelines_only)
        status = kd_error_set(error, KD_EINTERNAL, "the device was opened only for pipelines");
    if (status || vk->recording)
        return status;
    /* kd_vk_submit has waited until the last submission from this slot had finished. */
    const VkCommandBufferBeginInfo begin = { .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                             .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT };
    KD_VK_TRY(&vk->core.fn, ResetCommandPool, vk->core.device, slot->pool, 0);
    KD_VK_TRY(&vk->core.fn, BeginCommandBuffer, slot->commands, &begin);
    kd_vk_descriptors_reset(&vk->core, &slot->descriptors);
    kd_vk_timing_begin(&vk->core, &slot->stamps, slot->commands);
    vk->hazards_before = vk->hazards;
    vk->recording = true;
done:
    return status;
}

static enum kd_status enqueue(struct kd_vk *vk, struct kd_vk_slot *slot, uint64_t value, struct kd_error *error)
{
    enum kd_status status;
    const VkTimelineSemaphoreSubmitInfo timeline = { .sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
                                                     .signalSemaphoreValueCount = 1,
                                                     .pSignalSemaphoreValues = &value };
    const VkSubmitInfo info = { .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                .pNext = &timeline,
                                .commandBufferCount = 1,
                                .pCommandBuffers = &slot->commands,
                                .signalSemaphoreCount = 1,
                                .pSignalSemaphores = &vk->timeline };
    kd_vk_timing_end(&vk->core, &slot->stamps, slot->commands);
    kd_vk_barrier_to_host(&vk->core.fn, &vk->hazards, slot->commands);
    KD_VK_TRY(&vk->core.fn, EndCommandBuffer, slot->commands);
    VkResult result = kd_vk_mapped_flush(vk->mapped, &vk->core, value);
    if (result < 0)
        return failed(vk, error, result, "vkFlushMappedMemoryRanges");
    result = vk->core.fn.QueueSubmit(vk->core.queue, 1, &info, VK_NULL_HANDLE);
    return result < 0 ? failed(vk, error, result, "vkQueueSubmit") : KD_OK;
done:
    return status;
}

enum kd_status kd_vk_submit(struct kd_vk *vk, uint64_t *ticket, struct kd_error *error)
{
    uint64_t value = kd_vk_current(vk);
    enum kd_status status = kd_vk_alive(&vk->core, error);
    if (!status && vk->recording) {
        if (value > KD_VK_IN_FLIGHT)
            status = kd_vk_wait(vk, value - KD_VK_IN_FLIGHT, error);
        if (!status)
            status = enqueue(vk, slot_of(vk, value), value, error);
        if (status) {
            kd_vk_discard(vk);
            return status;
        }
        slot_of(vk, value)->submitted_ns = now_ns();
        vk->submitted = value;
        vk->recording = false;
    }
    if (ticket)
        *ticket = vk->submitted;
    return status;
}

void kd_vk_discard(struct kd_vk *vk)
{
    if (!vk->recording)
        return;
    vk->recording = false;
    vk->hazards = vk->hazards_before; /* undone, because the barriers of the discarded commands are dropped as well */
    kd_vk_mapped_discard(vk->mapped, vk->submitted);
    kd_vk_retired_discard(vk->retired, vk->submitted);
    if (!vk->core.lost[0])
        kd_vk_retired_free(&vk->retired, vk, vk->done);
}
