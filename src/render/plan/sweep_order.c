#include "render/plan/sweep_order.h"

#include "base/clock.h"
#include "render/plan/plan.h"

#include <stdlib.h>

enum kd_status kd_sweep_order_add(struct kd_sweep_order *order, uint64_t group, double trace_ms)
{
    if (!(order->n & (order->n - 1))) { /* the array's size doubles when n is a power of two */
        struct kd_sweep_order_item *more = realloc(order->items, (order->n ? 2 * (size_t)order->n : 1) * sizeof *more);
        if (!more)
            return KD_ENOMEM;
        order->items = more;
    }
    order->items[order->n] = (struct kd_sweep_order_item) { group, order->n, order->n, trace_ms };
    order->n++;
    return KD_OK;
}

static int by_number(unsigned a, unsigned b) { return (a > b) - (a < b); }

static int by_group(const void *a, const void *b)
{
    const struct kd_sweep_order_item *x = a, *y = b;
    return x->group != y->group ? (x->group < y->group ? -1 : 1) : by_number(x->frame, y->frame);
}

static int by_first(const void *a, const void *b)
{
    const struct kd_sweep_order_item *x = a, *y = b;
    return x->first != y->first ? by_number(x->first, y->first) : by_number(x->frame, y->frame);
}

enum kd_status kd_sweep_order_end(struct kd_sweep_order *order, double *shared_ms)
{
    struct kd_sweep_order_item *items = order->items;
    *shared_ms = 0;
    order->groups = order->n;
    if (!order->n)
        return KD_OK;
    order->frames = malloc(order->n * sizeof *order->frames);
    if (!order->frames)
        return KD_ENOMEM;
    qsort(items, order->n, sizeof *items, by_group);
    for (unsigned i = 1; i < order->n; i++)
        if (items[i].group == items[i - 1].group) {
            items[i].first = items[i - 1].first;
            *shared_ms += items[i].trace_ms;
            order->groups--;
        }
    qsort(items, order->n, sizeof *items, by_first);
    for (unsigned i = 0; i < order->n; i++)
        order->frames[i] = items[i].frame;
    free(items);
    order->items = NULL;
    return KD_OK;
}

#define AT_LEAST 16 /* number of scenes added in one call, which takes a millisecond */

enum kd_status kd_sweep_order_go_on(struct kd_sweep_order *order, const struct kd_sweep *sweep, double until_ms)
{
    double shared_ms;
    enum kd_status status = KD_OK;
    for (unsigned i = 1; order->n < sweep->scenes && (i % AT_LEAST || kd_clock_ms() < until_ms); i++) {
        struct kd_scene scene;
        uint64_t group = 0;
        if (!kd_sweep_scene(sweep, order->n, &scene, NULL)) /* skipped here: an invalid scene fails when it is
                                                             * rendered */
            KD_TRY(kd_plan_lens_group(&scene, &group));
        KD_TRY(kd_sweep_order_add(order, group, 0));
    }
    if (order->n == sweep->scenes && !order->frames)
        KD_TRY(kd_sweep_order_end(order, &shared_ms));
done:
    return status;
}

void kd_sweep_order_finish(struct kd_sweep_order *order)
{
    free(order->items);
    free(order->frames);
    *order = (struct kd_sweep_order) { 0 };
}
