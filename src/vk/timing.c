#include "vk/timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double kd_vk_timing_ms(uint64_t from, uint64_t to, uint32_t bits, double period_ns)
{
    uint64_t mask = bits >= 64 ? UINT64_MAX : (UINT64_C(1) << bits) - 1;
    return (double)((to - from) & mask) * period_ns * 1e-6;
}

/* Row of a pass name. The name is copied, because the totals outlive the caller's string. When all rows are used, the
 * last row collects all other names. */
static uint32_t row_of(struct kd_vk_timing *timing, const char *pass)
{
    char name[sizeof timing->names[0]];
    snprintf(name, sizeof name, "%s", pass ? pass : "unnamed");
    for (uint32_t i = 0; i < timing->n; i++)
        if (!strcmp(timing->names[i], name))
            return i;
    if (timing->n == KD_VK_MAX_PASSES) {
        snprintf(timing->names[KD_VK_MAX_PASSES - 1], sizeof name, "other");
        return KD_VK_MAX_PASSES - 1;
    }
    memcpy(timing->names[timing->n], name, sizeof name);
    timing->totals[timing->n].pass = timing->names[timing->n];
    return (uint32_t)timing->n++;
}

static bool add_pool(const struct kd_vk_core *core, struct kd_vk_stamps *stamps)
{
    const VkQueryPoolCreateInfo info = { .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                         .queryCount = KD_VK_STAMPS_PER_POOL };
    VkQueryPool *pools = realloc(stamps->pools, (stamps->n_pools + 1) * sizeof *pools);
    if (!pools)
        return false;
    stamps->pools = pools;
    if (core->fn.CreateQueryPool(core->device, &info, NULL, &pools[stamps->n_pools]) < 0)
        return false;
    kd_vk_name(core, VK_OBJECT_TYPE_QUERY_POOL, KD_VK_HANDLE(pools[stamps->n_pools]), "timestamps %zu",
               stamps->n_pools);
    stamps->n_pools++;
    return true;
}

/* Writes a timestamp. If that fails, work continues without being timed. */
static void stamp(const struct kd_vk_core *core, struct kd_vk_stamps *stamps, VkCommandBuffer commands)
{
    size_t pool = stamps->n / KD_VK_STAMPS_PER_POOL;
    uint32_t query = stamps->n % KD_VK_STAMPS_PER_POOL;
    if (stamps->broken || (pool == stamps->n_pools && !add_pool(core, stamps))) {
        stamps->broken = true;
        return;
    }
    if (query == 0) {
        if (core->physical.host_query_reset)
            core->fn.ResetQueryPool(core->device, stamps->pools[pool], 0, KD_VK_STAMPS_PER_POOL);
        else
            core->fn.CmdResetQueryPool(commands, stamps->pools[pool], 0, KD_VK_STAMPS_PER_POOL);
    }
    core->fn.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, stamps->pools[pool], query);
    stamps->n++;
}

void kd_vk_timing_begin(const struct kd_vk_core *core, struct kd_vk_stamps *stamps, VkCommandBuffer commands)
{
    stamps->n = 0;
    stamps->n_spans = 0;
    stamps->broken = !core->physical.info.timestamps;
    stamp(core, stamps, commands);
}

void kd_vk_timing_pass(struct kd_vk_timing *timing, const struct kd_vk_core *core, struct kd_vk_stamps *stamps,
                       VkCommandBuffer commands, const char *pass)
{
    if (stamps->broken)
        return;
    uint32_t row = row_of(timing, pass);
    if (stamps->n_spans && stamps->spans[stamps->n_spans - 1].pass == row) {
        stamps->spans[stamps->n_spans - 1].commands++;
        return;
    }
    if (stamps->n_spans == stamps->capacity) {
        size_t capacity = stamps->capacity ? 2 * stamps->capacity : 16;
        struct kd_vk_stamp_span *spans = realloc(stamps->spans, capacity * sizeof *spans);
        if (!spans) {
            stamps->broken = true;
            return;
        }
        stamps->spans = spans;
        stamps->capacity = capacity;
    }
    if (stamps->n_spans)
        stamp(core, stamps, commands); /* the new timestamp also ends the previous span */
    stamps->spans[stamps->n_spans++] = (struct kd_vk_stamp_span) { row, 1 };
}

void kd_vk_timing_end(const struct kd_vk_core *core, struct kd_vk_stamps *stamps, VkCommandBuffer commands)
{
    stamp(core, stamps, commands);
}

static bool read_stamps(const struct kd_vk_core *core, struct kd_vk_stamps *stamps, uint64_t *out)
{
    for (size_t first = 0; first < stamps->n; first += KD_VK_STAMPS_PER_POOL) {
        size_t n = stamps->n - first < KD_VK_STAMPS_PER_POOL ? stamps->n - first : KD_VK_STAMPS_PER_POOL;
        if (core->fn.GetQueryPoolResults(core->device, stamps->pools[first / KD_VK_STAMPS_PER_POOL], 0, (uint32_t)n,
                                         n * sizeof *out, out + first, sizeof *out,
                                         VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
            return false;
    }
    return true;
}

void kd_vk_timing_collect(struct kd_vk_timing *timing, const struct kd_vk_core *core, struct kd_vk_stamps *stamps)
{
    if (stamps->broken || stamps->n != stamps->n_spans + 1)
        return;
    uint64_t *values = malloc(stamps->n * sizeof *values);
    if (values && read_stamps(core, stamps, values))
        for (size_t i = 0; i < stamps->n_spans; i++) {
            struct kd_vk_time *total = &timing->totals[stamps->spans[i].pass];
            total->ms += kd_vk_timing_ms(values[i], values[i + 1], core->physical.timestamp_bits,
                                         (double)core->physical.properties.limits.timestampPeriod);
            total->dispatches += stamps->spans[i].commands;
        }
    free(values);
    stamps->n = 0;
    stamps->n_spans = 0;
}

void kd_vk_timing_finish(const struct kd_vk_core *core, struct kd_vk_stamps *stamps)
{
    for (size_t i = 0; i < stamps->n_pools; i++)
        core->fn.DestroyQueryPool(core->device, stamps->pools[i], NULL);
    free(stamps->pools);
    free(stamps->spans);
    *stamps = (struct kd_vk_stamps) { 0 };
}

size_t kd_vk_timing_totals(const struct kd_vk_timing *timing, struct kd_vk_time out[KD_VK_MAX_PASSES])
{
    size_t n = 0;
    for (size_t i = 0; i < timing->n; i++)
        if (timing->totals[i].dispatches)
            out[n++] = timing->totals[i];
    return n;
}

void kd_vk_timing_reset(struct kd_vk_timing *timing)
{
    for (size_t i = 0; i < timing->n; i++) {
        timing->totals[i].ms = 0;
        timing->totals[i].dispatches = 0;
    }
}
