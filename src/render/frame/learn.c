/* Updates the costs of passes from the device times of a frame. */
#include "render/frame/job.h"
#include "render/plan/cost_class.h"

#include <math.h>
#include <string.h>

/* Updates the cost of an item of a pass: the general figure, and the figure of the picture's class. */
static void learn(struct kd_capacity *c, const struct kd_frame_job *job, const struct kd_plan_pass *pass, double ms)
{
    const double ns = ms * 1e6 / (double)pass->invocations;
    if (!(ms > 0 && pass->invocations >= 4096)) /* a small picture measures only the overhead of the pass */
        return;
    if (!job->r->probing)
        kd_cost_learn(c, job->plan->cost.class, (enum kd_pass_id)(kd_pass_find(pass->name) - kd_passes), ns);
    if (pass->figure == KD_NS_NONE)
        return;
    if (pass->figure == KD_NS_RAY_MARCH && job->scene->volume.model == KD_VOLUME_GRID)
        return; /* on a grid, the time of this pass depends on the grid's cells, so the figure stays unchanged */
    double *figure = &c->ns[pass->figure];
    *figure = job->r->probing ? fmin(*figure, ns) : kd_cost_mean(*figure, ns);
}

static double timing(const struct kd_frame *frame, const char *pass)
{
    for (size_t i = 0; i < frame->n_timings; i++)
        if (!strcmp(frame->timings[i].name, pass))
            return frame->timings[i].ms;
    return 0;
}

/* True if the device is the host's processor, which other programs slow down. Costs are stored between starts and
 * used for planning. Costs that were measured under load must not make pictures look too expensive on a machine that is
 * idle again. So the time that threads waited for a core is subtracted. It takes 0.1 to 0.3 ms to examine all threads;
 * therefore only one short frame in eight is measured. */
static bool on_the_host(const struct kd_renderer *r) { return kd_vk_info(r->vk)->type == KD_VK_CPU; }

void kd_frame_learn_begin(struct kd_frame_job *job)
{
    enum { OFTEN = 8 };
    const double LONG_MS = 100;
    job->teaches = !on_the_host(job->r) || job->r->probing || job->plan->cost.estimate_ms > LONG_MS ||
                   job->r->frames++ % OFTEN == 0;
    if (job->teaches && on_the_host(job->r))
        job->waiting = kd_cpu_pressure_now();
}

void kd_frame_learn(struct kd_frame_job *job, const struct kd_frame *frame)
{
    struct kd_renderer *renderer = job->r;
    const struct kd_plan *plan = job->plan;
    struct kd_capacity *c = &renderer->capacity;
    if (!job->teaches)
        return;
    const double share = on_the_host(renderer) ? kd_cpu_pressure_share(&job->waiting) : 1;
    pthread_mutex_lock(&renderer->lock);
    for (size_t i = 0; i < plan->cost.n_passes; i++)
        learn(c, job, &plan->cost.passes[i], share * timing(frame, plan->cost.passes[i].name));
    c->measured = c->measured || (uint64_t)plan->picture.width * plan->picture.height >= 4096;
    pthread_mutex_unlock(&renderer->lock);
}
