/* Compiles kernels while others use the device. As soon as a job waits, the scheduler looks for kernels that the job
 * lacks. A thread compiles them, and the scheduler passes them to the renderer. The renderer's kernels are thus used
 * only by the owner of the device or, while the device has no owner, by a thread that holds the lock. */
#include "base/clock.h"
#include "base/nice.h"
#include "server/render/render_internal.h"

#include <stddef.h>
#include <string.h>

/* estimate in ms before the first compilation; lavapipe compiles some kernels in this time */
#define COMPILE_MS 2000.0
/* Half the weight of live frames, so that compilations advance while there are live frames, but with a smaller
 * share. */
#define NICE 3

/* Maximum number of times that a job starts again because of missing kernels. After that, kernels are compiled while
 * the job owns the device. */
#define BEGINS_ANEW 8

/* Makes the job wait for the compilation. compilation NULL: no kernel is missing. */
static void put_off(struct kd_render_queue *queue, struct kd_render_job *job, struct kd_compilation *compilation)
{
    job->compilation = compilation;
    job->kernels = compilation ? KD_KERNELS_MISSING : KD_KERNELS_THERE;
    job->missing_ms = kd_clock_ms();
    if (!compilation)
        return;
    job->missing = (struct kd_claim) { .class = job->claim.class };
    memcpy(job->missing.client, job->claim.client, sizeof job->missing.client);
    kd_shares_add(&queue->missing, &job->missing);
    pthread_cond_broadcast(&queue->changed);
}

static void ask(struct kd_render_queue *queue, struct kd_render_job *job)
{
    put_off(queue, job,
            !job->run  ? kd_compilation_begin(queue->renderer, &job->scene, &job->plan)
            : job->ask ? kd_compilation_of(queue->renderer, job->ask, job)
                       : NULL);
}

void kd_render_take_kernels(struct kd_render_queue *queue)
{
    if (!queue->compiled)
        return;
    kd_compilation_end(queue->compiled);
    queue->compiled = NULL;
    pthread_cond_broadcast(&queue->changed);
}

void kd_render_ask_kernels(struct kd_render_queue *queue)
{
    if (!queue->compiles || queue->failed || queue->lost)
        return;
    kd_render_take_kernels(queue);
    for (struct kd_render_job *job = queue->jobs.first; job; job = job->next)
        if (job->kernels == KD_KERNELS_UNKNOWN)
            ask(queue, job);
}

void kd_render_compile_ahead(struct kd_render_queue *queue, struct kd_compilation *compilation)
{
    if (!compilation)
        return;
    if (queue->ahead) /* meanwhile another thread has found missing kernels */
        kd_compilation_drop(queue->ahead);
    queue->ahead = compilation;
    pthread_cond_broadcast(&queue->changed);
}

bool kd_render_has_kernels(const struct kd_render_queue *queue, const struct kd_render_job *job)
{
    return !queue->compiles || job->kernels == KD_KERNELS_THERE;
}

void kd_render_forget_kernels(struct kd_render_queue *queue, struct kd_render_job *job)
{
    if (!job->compilation)
        return;
    kd_shares_remove(&queue->missing, &job->missing);
    if (job->compilation == queue->compiling)
        atomic_store(&queue->uncompiled, true);
    else
        kd_compilation_drop(job->compilation);
    job->compilation = NULL;
}

bool kd_render_lacks(void *user, struct kd_compilation *compilation, bool background)
{
    struct kd_render_queue *queue = user;
    pthread_mutex_lock(&queue->lock);
    struct kd_render_job *job = queue->holder;
    const bool here = !queue->compiles || queue->lost || (!background && job->lacks == BEGINS_ANEW);
    bool go_on = here || background;
    if (here) {
        kd_compilation_drop(compilation);
    } else if (background) {
        put_off(queue, job, compilation);
        kd_render_give_way(queue, job);
        kd_render_forget_kernels(queue, job); /* the job was resumed for another reason than compiled kernels */
        go_on = !queue->failed;
    } else {
        job->lacks++;
        job->lacked = compilation;
    }
    pthread_mutex_unlock(&queue->lock);
    return go_on && !kd_render_unwanted(queue, job);
}

bool kd_render_begins_with_kernels(struct kd_render_queue *queue, struct kd_render_job *job)
{
    struct kd_compilation *lacked = job->lacked;
    job->lacked = NULL;
    if (!lacked)
        return false;
    if (job->status != KD_ECANCELLED || queue->failed || kd_render_unwanted(queue, job)) {
        kd_compilation_drop(lacked);
        return false;
    }
    job->status = KD_OK;
    job->error = (struct kd_error) { 0 };
    kd_render_stand_in_line(job);
    job->away_ms = job->turn_ms;
    put_off(queue, job, lacked);
    return true;
}

void kd_render_tell_kernels(struct kd_render_job *job)
{
    struct kd_frame *frame = &job->frame;
    size_t i = 0;
    if (!(job->kernels_ms > 0))
        return;
    while (i < frame->n_timings && strcmp(frame->timings[i].name, "kernels"))
        i++;
    if (i == KD_FRAME_MAX_TIMINGS)
        return;
    if (i == frame->n_timings)
        frame->timings[frame->n_timings++] = (struct kd_timing) { "kernels", 0 };
    frame->timings[i].ms += job->kernels_ms;
}

static struct kd_render_job *job_of(struct kd_claim *missing)
{
    return missing ? (struct kd_render_job *)((char *)missing - offsetof(struct kd_render_job, missing)) : NULL;
}

static bool is_any(const struct kd_claim *claim, void *user)
{
    (void)user;
    return !atomic_load(&job_of((struct kd_claim *)claim)->drop);
}

/* Adds the time that the job has waited to kernels_ms. It does not count as queue_ms, the time during which others
 * owned the device. */
static void end_waiting(struct kd_render_job *job)
{
    const double now = kd_clock_ms();
    job->queue_ms += job->missing_ms - job->away_ms;
    job->kernels_ms += now - job->missing_ms;
    job->away_ms = now;
}

/* Marks the job for which the kernels were compiled as ready. All other waiting jobs are checked again, because they
 * may have lacked the same kernels. */
static void share_out(struct kd_render_queue *queue, const struct kd_compilation *done, double ms)
{
    for (struct kd_render_job *job = queue->jobs.first; job; job = job->next) {
        const bool own = job->compilation == done;
        if (!job->compilation)
            continue;
        if (own) {
            kd_shares_charge(&queue->missing, &job->missing, ms);
            kd_allowance_charge(&queue->allowance, job->claim.client, ms, kd_clock_ms());
        } else {
            kd_compilation_drop(job->compilation);
        }
        kd_shares_remove(&queue->missing, &job->missing);
        end_waiting(job);
        job->compilation = NULL;
        job->kernels = own ? KD_KERNELS_THERE : KD_KERNELS_UNKNOWN;
    }
}

static bool is_wanted(void *user, double fraction)
{
    struct kd_render_queue *queue = user;
    (void)fraction;
    kd_pulse_beat(&queue->compiler_pulse);
    return !atomic_load(&queue->uncompiled);
}

static void learn(struct kd_render_queue *queue, double ms)
{
    const double share = 0.3; /* weight of the latest compilation in the running mean of compilation times */
    queue->compile_ms += queue->compile_ms > 0 ? share * (ms - queue->compile_ms) : ms;
}

double kd_render_queue_kernels_ms(struct kd_render_queue *queue, const struct kd_scene *scene,
                                  const struct kd_plan *plan)
{
    double ms = 0;
    pthread_mutex_lock(&queue->lock);
    if (queue->compiles && !queue->holder && !queue->reopening && !queue->failed && !queue->lost) {
        struct kd_compilation *c = kd_compilation_begin(queue->renderer, scene, plan);
        ms = !c ? 0 : queue->compile_ms > 0 ? queue->compile_ms : COMPILE_MS;
        if (c)
            kd_compilation_drop(c);
    }
    pthread_mutex_unlock(&queue->lock);
    return ms;
}

/* Compiles kernels. Called with the lock held, which is released during the work. */
static void compile(struct kd_render_queue *queue, struct kd_compilation *c)
{
    struct kd_error error = { 0 };
    const double begun = kd_clock_ms();
    queue->compiling = c;
    queue->compiling_ahead = c == queue->ahead;
    if (queue->compiling_ahead)
        queue->ahead = NULL;
    atomic_store(&queue->uncompiled, atomic_load(&queue->cancel));
    pthread_mutex_unlock(&queue->lock);
    kd_pulse_beat(&queue->compiler_pulse);
    const enum kd_status status = kd_compilation_run(c, is_wanted, queue, &error);
    kd_pulse_rest(&queue->compiler_pulse);
    pthread_mutex_lock(&queue->lock);
    if (!status && !queue->compiling_ahead && !atomic_load(&queue->uncompiled))
        learn(queue, kd_clock_ms() - begun);
    while (queue->compiled && !queue->closing)
        pthread_cond_wait(&queue->changed, &queue->lock);
    share_out(queue, c, kd_clock_ms() - begun);
    queue->compiling = NULL;
    queue->compiling_ahead = false;
    queue->compiled = c;
    queue->worked_ms = kd_clock_ms();
    if (status == KD_EDEVICE)
        kd_render_hung(queue, &error);
    kd_render_reopen(queue);
    kd_render_next(queue);
    pthread_cond_broadcast(&queue->changed);
}

void *kd_render_compile_main(void *user)
{
    struct kd_render_queue *queue = user;
    kd_nice_thread(NICE);
    pthread_mutex_lock(&queue->lock);
    while (!queue->closing) {
        const bool waits = queue->failed || queue->lost || queue->reopening || queue->compiled ||
                           queue->holder == &queue->rest; /* the device may be closed while `rest` runs */
        struct kd_render_job *job = job_of(kd_shares_next(&queue->missing, is_any, NULL));
        struct kd_compilation *next = waits ? NULL : job ? job->compilation : queue->ahead;
        if (next)
            compile(queue, next);
        else
            pthread_cond_wait(&queue->changed, &queue->lock);
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}
