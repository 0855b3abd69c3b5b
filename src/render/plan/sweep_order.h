/* Rendering order of a sweep's frames: frames that share a lens map follow one another, whatever the order of the axes.
 * The groups of frames are in the order of their first frames. Pure. */
#ifndef KD_RENDER_PLAN_SWEEP_ORDER_H
#define KD_RENDER_PLAN_SWEEP_ORDER_H

#include "scene/sweep.h"

struct kd_sweep_order {
    struct kd_sweep_order_item {
        uint64_t group;
        unsigned frame, first;
        double trace_ms;
    } *items; /* used until the order is complete */
    unsigned n;
    unsigned groups; /* number of distinct lens maps, once all frames are added */
    /* frame number for each place in the order; NULL: frames are rendered in the order of their numbers */
    unsigned *frames;
};

/* Adds the n-th frame. group: kd_plan_lens_group of its scene; trace_ms: time of its lens map. The only error is
 * KD_ENOMEM. */
enum kd_status kd_sweep_order_add(struct kd_sweep_order *order, uint64_t group, double trace_ms);
/* Completes the order. *shared_ms: time saved by sharing lens maps. The only error is KD_ENOMEM. */
enum kd_status kd_sweep_order_end(struct kd_sweep_order *order, double *shared_ms);
/* Adds and orders the frames of a sweep incrementally. Stops at until_ms (kd_clock_ms), but adds at least a few scenes.
 * The order is complete once order->frames is set. The only error is KD_ENOMEM. */
enum kd_status kd_sweep_order_go_on(struct kd_sweep_order *order, const struct kd_sweep *sweep, double until_ms);
void kd_sweep_order_finish(struct kd_sweep_order *order);

#endif
