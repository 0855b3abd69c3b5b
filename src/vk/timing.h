/* Adds up device time by pass name.
 *
 * A submission is cut into spans: consecutive commands of one pass. A timestamp is written when recording
 * begins and after each span, always at the bottom of the pipe, that is once everything before it has
 * finished. Spans therefore never overlap and their sum is the time the device was busy; the idle time
 * between submissions belongs to none. */
#ifndef KD_VK_TIMING_H
#define KD_VK_TIMING_H

#include "vk/functions.h"
#include "vk/vk.h"

#define KD_VK_STAMPS_PER_POOL 64

/* The timestamps of one submission. */
struct kd_vk_stamps {
    VkQueryPool *pools;                                          /* kept at the most that one submission has needed */
    size_t n_pools, n;                                           /* n: stamps written */
    struct kd_vk_stamp_span { uint32_t pass, commands; } *spans; /* span i lies between stamps i and i + 1 */
    size_t n_spans, capacity;
    bool broken; /* no memory to go on: this submission is not timed */
};

struct kd_vk_timing {
    char names[KD_VK_MAX_PASSES][48];
    struct kd_vk_time totals[KD_VK_MAX_PASSES];
    size_t n;
};

void kd_vk_timing_begin(struct kd_vk *vk, struct kd_vk_stamps *stamps, VkCommandBuffer commands);
/* Called before each command, which belongs to this pass. */
void kd_vk_timing_pass(struct kd_vk *vk, struct kd_vk_stamps *stamps, VkCommandBuffer commands, const char *pass);
void kd_vk_timing_end(struct kd_vk *vk, struct kd_vk_stamps *stamps, VkCommandBuffer commands);
/* Add a finished submission to the totals. */
void kd_vk_timing_collect(struct kd_vk *vk, struct kd_vk_stamps *stamps);
void kd_vk_timing_finish(struct kd_vk *vk, struct kd_vk_stamps *stamps);

/* Milliseconds from one timestamp to a later one. Pure; the counter has `bits` valid bits and may have
 * wrapped once. */
double kd_vk_timing_ms(uint64_t from, uint64_t to, uint32_t bits, double period_ns);

#endif
