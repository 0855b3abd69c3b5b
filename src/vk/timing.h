/* Adds up device time by the name of a pass.
 *
 * A submission is divided into spans: consecutive commands of one pass. A timestamp is written at the beginning and
 * after each span. Timestamps are written at the bottom of the pipe, that is, when all previous work has finished. So
 * spans never overlap, and their sum is the time during which the device was busy. Idle time between submissions is
 * not counted. */
#ifndef KD_VK_TIMING_H
#define KD_VK_TIMING_H

#include "vk/core.h"
#include "vk/vk.h"

#define KD_VK_STAMPS_PER_POOL 64

/* The timestamps of one submission. */
struct kd_vk_stamps {
    /* query pools for the largest submission so far */
    VkQueryPool *pools;
    size_t n_pools, n;                                           /* n: number of timestamps written */
    struct kd_vk_stamp_span { uint32_t pass, commands; } *spans; /* span i lies between stamps i and i + 1 */
    size_t n_spans, capacity;
    bool broken; /* true if this submission is not timed, because memory ran out */
};

struct kd_vk_timing {
    char names[KD_VK_MAX_PASSES][48];
    struct kd_vk_time totals[KD_VK_MAX_PASSES];
    size_t n;
};

void kd_vk_timing_begin(const struct kd_vk_core *core, struct kd_vk_stamps *stamps, VkCommandBuffer commands);
/* Called before each command of the pass. */
void kd_vk_timing_pass(struct kd_vk_timing *timing, const struct kd_vk_core *core, struct kd_vk_stamps *stamps,
                       VkCommandBuffer commands, const char *pass);
void kd_vk_timing_end(const struct kd_vk_core *core, struct kd_vk_stamps *stamps, VkCommandBuffer commands);
/* Adds a finished submission to the totals. */
void kd_vk_timing_collect(struct kd_vk_timing *timing, const struct kd_vk_core *core, struct kd_vk_stamps *stamps);
void kd_vk_timing_finish(const struct kd_vk_core *core, struct kd_vk_stamps *stamps);
/* Returns the totals above 0, as kd_vk_times does, and resets all totals to 0. */
size_t kd_vk_timing_totals(const struct kd_vk_timing *timing, struct kd_vk_time out[KD_VK_MAX_PASSES]);
void kd_vk_timing_reset(struct kd_vk_timing *timing);

/* Milliseconds between two timestamps. Pure. The counter has `bits` valid bits and may have wrapped once. */
double kd_vk_timing_ms(uint64_t from, uint64_t to, uint32_t bits, double period_ns);

#endif
