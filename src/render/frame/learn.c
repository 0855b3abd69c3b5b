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
    uint64_t pixels = (uint64_t)plan->width * plan->height;
    const bool p = renderer->probing;
    pthread_mutex_lock(&renderer->lock);
    if (plan->path != KD_LENS_LISTED)
        smooth(kd_plan_is_radii(plan) ? &c->ns_per_ray_radius : &c->ns_per_ray_full, p, timing(frame, "trace"), kd_plan_rays(plan));
    smooth(&c->ns_per_sample_transfer, p, timing(frame, "transfer"), kd_plan_rays(plan));
    smooth(&c->ns_per_pixel_post, p, timing(frame, "post"), pixels);
    smooth(&c->ns_per_particle, p, timing(frame, "particles"), plan->particles.count);
    c->measured = c->measured || pixels >= 4096;
    pthread_mutex_unlock(&renderer->lock);
}
