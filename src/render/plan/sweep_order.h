/* The frames of a sweep are rendered so that those that share a lens map follow one another, whatever the order of
 * its axes; the maps in the order of their first frames. Pure. */
#ifndef KD_RENDER_PLAN_SWEEP_ORDER_H
#define KD_RENDER_PLAN_SWEEP_ORDER_H

#include "scene/sweep.h"

struct kd_sweep_order {
    struct kd_sweep_order_item {
        uint64_t group;
        unsigned frame, first;
        double trace_ms;
    } *items; /* while it is being made */
    unsigned n;
    unsigned groups;  /* lens maps that are not shared with a scene before, once all are there */
    unsigned *frames; /* the frame of each place; NULL: they are rendered as they are numbered */
};

/* One more frame, the n-th. group: kd_plan_lens_group; trace_ms: what its lens map takes. KD_ENOMEM. */
enum kd_status kd_sweep_order_add(struct kd_sweep_order *order, uint64_t group, double trace_ms);
/* All are there. *shared_ms: what is not spent because lens maps are shared. KD_ENOMEM. */
enum kd_status kd_sweep_order_end(struct kd_sweep_order *order, double *shared_ms);
/* All of that, from where the order is, until it is time (kd_clock_ms), for a few more scenes at least; it is made
 * once order->frames is there. KD_ENOMEM. */
enum kd_status kd_sweep_order_go_on(struct kd_sweep_order *order, const struct kd_sweep *sweep, double until_ms);
void kd_sweep_order_finish(struct kd_sweep_order *order);

#endif
