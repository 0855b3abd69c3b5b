/* Frees memory that the renderer has cached, after some time without requests. Also trims the heap, even under load. */
#include "render/device/rest.h"

#include "base/allocator.h"
#include "base/clock.h"
#include "server/render/render_internal.h"

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

/* True if the pause is long enough for freeing memory. If much memory is cached, a sixtieth of rest_ms is enough. */
static bool is_long_enough(const struct kd_render_queue *queue, double pause_ms)
{
    const double soon_ms = queue->rest_ms / 60.;
    return pause_ms >= queue->rest_ms ||
           (pause_ms >= soon_ms && kd_renderer_kept_sum(queue->renderer) > KD_REST_SOON_BYTES);
}

void kd_render_rest_if_idle(struct kd_render_queue *queue)
{
    const bool idle = queue->opened && !queue->unfinished && !queue->holder && !queue->compiling && !queue->lost &&
                      !queue->failed && !queue->closing;
    if (queue->rested || !idle || !is_long_enough(queue, kd_clock_ms() - queue->worked_ms))
        return;
    queue->rest = (struct kd_render_job) { .claim.class = KD_CLASS_JOB, .run = rest, .done = done, .socket = -1 };
    kd_render_queue_push_locked(queue, &queue->rest);
}

/* Under load the renderer keeps its caches, and only the heap is trimmed. Drivers free much of the memory with which
 * they have compiled kernels, but the heap keeps this memory instead of returning it to the system. After ten
 * minutes it was a sixth of the resident memory (bench/soak.py). */
void kd_render_trim_if_due(struct kd_render_queue *queue)
{
    const double now = kd_clock_ms();
    pthread_mutex_lock(&queue->lock);
    const bool due = queue->worked_ms > queue->trimmed_ms && now - queue->trimmed_ms >= queue->rest_ms;
    if (due)
        queue->trimmed_ms = now;
    pthread_mutex_unlock(&queue->lock);
    if (due)
        kd_allocator_trim();
}
