/* The cost of a plan: memory, passes and their time. Plain data; any thread. */
#ifndef KD_RENDER_PLAN_COST_H
#define KD_RENDER_PLAN_COST_H

#include "render/plan/pass.h"

#include <stddef.h>
#include <stdint.h>

struct kd_plan_pass {
    const char *name, *kernel; /* same meaning as in pass.h */
    uint64_t invocations;
    double estimate_ms;
    enum kd_figure_id figure; /* the performance figure that the pass's measured time updates; KD_NS_NONE: none */
};

struct kd_plan_cost {
    uint64_t lens_bytes, device_bytes, host_bytes;
    /* further host memory while a renderer makes the emitters' device data, once for all pictures */
    uint64_t making_bytes;
    struct kd_plan_pass passes[KD_PASS_COUNT];
    size_t n_passes;
    /* estimate_ms: estimated time of all passes; trace_ns: estimated time of tracing one ray */
    double estimate_ms, trace_ns;
    uint64_t class; /* cost class of the plan (cost_class.h) */
    /* additional time for compiling missing kernels, estimated by server/render/queue.h; 0: no kernel is missing, or
     * the time is not known */
    double kernels_ms;
};

#endif
