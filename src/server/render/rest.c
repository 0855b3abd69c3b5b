/* Memory that the renderer holds is given back when nobody has asked for anything for a while. */
#include "render/device/rest.h"

#include "base/clock.h"
#include "server/render/internal.h"

static enum kd_status rest(struct kd_render_job *job, struct kd_renderer *renderer, kd_progress_fn progress, void *user)
{
    (void)progress, (void)user;
    return kd_renderer_rest(renderer, &job->error);
}

static void done(struct kd_render_job *job) { (void)job; }

void kd_render_queue_rest_after(struct kd_render_queue *queue, unsigned ms)
{
    pthread_mutex_lock(&queue->lock);
    queue->rest_ms = ms;
    pthread_mutex_unlock(&queue->lock);
}

/* Where much is held, a short pause is made use of. */
static double patience_ms(const struct kd_render_queue *queue)
{
    uint64_t kept[KD_N_KEPT_KINDS], sum = 0;
    kd_renderer_kept(queue->renderer, kept);
    for (size_t i = 0; i < KD_N_KEPT_KINDS; i++)
        sum += kept[i];
    return sum > KD_REST_SOON_BYTES ? queue->rest_ms / 60 : queue->rest_ms;
}

void kd_render_rest_if_idle(struct kd_render_queue *queue)
{
    const bool idle = queue->opened && !queue->unfinished && !queue->holder && !queue->compiling && !queue->lost &&
                      !queue->failed && !queue->closing;
    if (queue->rested || !idle || kd_clock_ms() - queue->worked_ms < patience_ms(queue))
        return;
    queue->rest = (struct kd_render_job) { .claim.class = KD_CLASS_JOB, .run = rest, .done = done, .socket = -1 };
    pthread_mutex_unlock(&queue->lock);
    kd_render_queue_push(queue, &queue->rest);
    pthread_mutex_lock(&queue->lock);
}
