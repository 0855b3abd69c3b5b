#include "render/frame/job.h"

#include <math.h>
#include <string.h>

static void smooth(double *figure, bool probing, double ms, uint64_t items)
{
    double ns = ms * 1e6 / (double)items;
    if (ms > 0 && items >= 4096) /* a small picture measures the overhead */
        *figure = probing ? fmin(*figure, ns) : *figure + 0.3 * (ns - *figure);
}

static double timing(const struct kd_frame *frame, const char *pass)
{
    for (size_t i = 0; i < frame->n_timings; i++)
        if (!strcmp(frame->timings[i].name, pass))
            return frame->timings[i].ms;
    return 0;
}

void kd_frame_learn(struct kd_renderer *renderer, const struct kd_plan *plan, const struct kd_frame *frame)
{
    struct kd_capacity *c = &renderer->capacity;
    pthread_mutex_lock(&renderer->lock);
    for (size_t i = 0; i < plan->n_passes; i++) {
        const struct kd_plan_pass *pass = &plan->passes[i];
        if (pass->figure != KD_NS_NONE)
            smooth(&c->ns[pass->figure], renderer->probing, timing(frame, pass->name), pass->invocations);
    }
    c->measured = c->measured || (uint64_t)plan->width * plan->height >= 4096;
    pthread_mutex_unlock(&renderer->lock);
}
