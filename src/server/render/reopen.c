/* Reopens a device that has failed and restarts the interrupted work, or declares the device lost. */
#include "base/log.h"
#include "server/render/render_internal.h"

#include <time.h>

/* number of attempts to reopen the device; there are several, because a driver needs a moment to reset its device */
#define TRIES 4
#define TRY_MS 100.0 /* pause in ms after the first attempt; each pause is twice the previous one */

/* Declares the device lost. Called with the lock held. */
static void lose(struct kd_render_queue *queue, const struct kd_error *error)
{
    if (queue->lost)
        return;
    kd_log(KD_LOG_ERROR, "the device is lost: %s", error->message);
    queue->lost = true;
    queue->lost_error = *error;
    queue->failed = false;
}

bool kd_render_queue_lost(struct kd_render_queue *queue, struct kd_error *error)
{
    pthread_mutex_lock(&queue->lock);
    bool lost = queue->lost;
    if (lost && error)
        *error = queue->lost_error;
    pthread_mutex_unlock(&queue->lock);
    return lost;
}

unsigned kd_render_queue_reopened(struct kd_render_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    unsigned n = queue->reopened;
    pthread_mutex_unlock(&queue->lock);
    return n;
}

bool kd_render_queue_hangs(struct kd_render_queue *queue, bool another)
{
    struct kd_error error;
    const double own = kd_pulse_missing_s(&queue->pulse, queue->params.deadline_ms),
                 compiler = kd_pulse_missing_s(&queue->compiler_pulse, queue->params.deadline_ms),
                 s = own > compiler ? own : compiler;
    pthread_mutex_lock(&queue->lock);
    if (s > 0)
        kd_error_set(&error, KD_EDEVICE, "the device hangs: its driver has not responded for %.0f s", s);
    else if (another)
        kd_error_set(&error, KD_EDEVICE, "the device for small pictures hangs");
    if (s > 0 || another) {
        queue->hangs = true;
        lose(queue, &error);
        kd_render_next(queue);
    }
    const bool hangs = queue->hangs;
    pthread_mutex_unlock(&queue->lock);
    return hangs;
}

void kd_render_hung(struct kd_render_queue *queue, const struct kd_error *error)
{
    queue->hangs = true;
    lose(queue, error);
}

void kd_render_failed(struct kd_render_queue *queue, const struct kd_error *error)
{
    kd_log(KD_LOG_WARN, "the device has failed: %s", error->message);
    pthread_mutex_lock(&queue->lock);
    queue->failed = !queue->lost;
    queue->failure = *error;
    pthread_mutex_unlock(&queue->lock);
}

/* A job that was interrupted because another job failed has ended with KD_ECANCELLED. This does not count as a
 * failure of the job. */
bool kd_render_once_more(struct kd_render_queue *queue, struct kd_render_job *job)
{
    const bool itself = job->status == KD_EDEVICE;
    if (!queue->failed || kd_render_unwanted(queue, job) || (itself ? job->repeated : job->status != KD_ECANCELLED))
        return false;
    job->repeated |= itself;
    job->status = KD_OK;
    job->error = (struct kd_error) { 0 };
    kd_render_stand_in_line(job);
    return true;
}

/* True if the limit permits another reopening. Called with the lock held. */
static bool may_reopen(struct kd_render_queue *queue)
{
    const double now = kd_clock_ms();
    if (now - queue->spent_from_ms > 1e3 * KD_REOPENINGS_S) {
        queue->spent_from_ms = now;
        queue->spent = 0;
    }
    return queue->spent++ < queue->reopenings;
}

/* Reopens the device, in several attempts if necessary. Called without the lock. */
static enum kd_status reopen(struct kd_render_queue *queue, struct kd_error *error)
{
    enum kd_status status = KD_EDEVICE;
    double wait_ms = TRY_MS;
    for (int i = 0; i < TRIES && status && !atomic_load(&queue->cancel); i++) {
        if (i) {
            nanosleep(&(struct timespec) { .tv_nsec = (long)(1e6 * wait_ms) }, NULL);
            wait_ms *= 2;
        }
        kd_pulse_beat(&queue->pulse);
        status = kd_renderer_reopen(queue->renderer, error);
        if (!status)
            status = kd_render_describe_device(queue);
    }
    return status;
}

void kd_render_reopen(struct kd_render_queue *queue)
{
    if (!queue->failed || queue->inside || queue->reopening || queue->compiling)
        return;
    kd_render_take_kernels(queue);
    if (!queue->reopenings || kd_renderer_hangs(queue->renderer)) {
        lose(queue, &queue->failure);
        return;
    }
    if (!may_reopen(queue)) {
        struct kd_error often;
        kd_error_set(&often, KD_EDEVICE, "%.300s (reopened %u times in %.0f s, the limit)", queue->failure.message,
                     queue->reopenings, KD_REOPENINGS_S);
        lose(queue, &often);
        return;
    }
    struct kd_error error = queue->failure;
    queue->reopening = true;
    pthread_mutex_unlock(&queue->lock);
    enum kd_status status = reopen(queue, &error);
    pthread_mutex_lock(&queue->lock);
    queue->reopening = false;
    if (status) {
        lose(queue, &error);
        return;
    }
    queue->failed = false;
    queue->reopened++;
    kd_log(KD_LOG_WARN, "the device has been reopened, and its work starts again");
}
