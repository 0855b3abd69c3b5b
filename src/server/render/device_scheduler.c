/* Schedules the work on the device, and runs it. */
#include "base/clock.h"
#include "render/explain/ahead.h"
#include "server/render/render_internal.h"

/* maximum bytes of all frames that are rendered but not yet encoded; a single frame may exceed it */
#define FRAME_BYTES ((size_t)256 << 20)
#define SHORT_BYTES ((size_t)64 << 20) /* bytes beyond FRAME_BYTES, for frames that are encoded quickly */
#define BRIEF_MS 3000.0                /* a picture with at most this estimated time, in ms, counts as brief */
/* number of lanes reserved for brief pictures; a single client may use all of them */
#define BRIEF_LANES 2
/* Minimum time in ms between two searches for missing kernels of pixels; a search takes about a millisecond. */
#define AHEAD_MS 1000.0
#define LARGE 32 /* a picture that needs less than 1/LARGE of the memory counts as needing none */

/* The functions below access the queue's members. They are called with the lock held, unless their comment says
 * otherwise. */

static bool is_large(const struct kd_render_queue *queue, const struct kd_render_job *job)
{
    struct kd_capacity c;
    kd_renderer_capacity(queue->renderer, &c);
    return job->plan.cost.device_bytes > c.memory_bytes / LARGE;
}

/* True if there is memory for the picture besides the large pictures in lanes. A picture that needs nearly all
 * memory starts only when no lane has another large picture. */
static bool fits(const struct kd_render_queue *queue, const struct kd_render_job *job)
{
    struct kd_capacity c;
    kd_renderer_capacity(queue->renderer, &c);
    return !queue->lane_bytes || !is_large(queue, job) ||
           queue->lane_bytes + job->plan.cost.device_bytes <= c.memory_bytes / 4 * 3;
}

static bool is_brief(const struct kd_render_job *job) { return job->plan.cost.estimate_ms <= BRIEF_MS; }

/* Finds a lane for a long picture. Returns NULL if none is free. A client has at most one lane for each class; brief
 * pictures do not count. */
static struct kd_lane *lane_for(struct kd_render_queue *queue, const struct kd_render_job *job)
{
    struct kd_lane *found = NULL;
    unsigned free = 0, brief = 0;
    for (unsigned i = 0; i < queue->n_lanes; i++) {
        struct kd_lane *lane = &queue->lanes[i];
        if (!lane->job) {
            found = lane;
            free++;
        } else if (lane->job->claim.owner == job->claim.owner) {
            brief += is_brief(lane->job);
            if (!is_brief(job) && !is_brief(lane->job) && lane->job->claim.class == job->claim.class)
                return NULL;
        }
    }
    bool may = is_brief(job) ? brief < BRIEF_LANES : free > BRIEF_LANES;
    return may && fits(queue, job) ? found : NULL;
}

static bool frame_fits(const struct kd_render_queue *queue, const struct kd_render_job *job)
{
    size_t bytes = kd_render_frame_bytes(job);
    return !bytes || queue->frame_bytes <= FRAME_BYTES + (bytes > KD_LONG_FRAME ? 0 : SHORT_BYTES);
}

/* True if the client has enough device time left for the work. Work for which a client waits was checked when it
 * arrived, and frames of jobs were checked when they were pushed (kd_render_queue_may_push). All other work starts
 * as soon as its client has enough time left, which kd_render_queue_sweep checks ten times a second. Work that has
 * started always continues, because others wait for its lane and its memory. */
static bool may_be_paid(const struct kd_render_queue *queue, const struct kd_claim *claim)
{
    const struct kd_render_job *job = (const struct kd_render_job *)claim;
    return kd_render_is_awaited(job) || claim->class == KD_CLASS_JOB || kd_render_has_begun(job) ||
           kd_allowance_may(&queue->allowance, claim->client, false, kd_clock_ms());
}

bool kd_render_queue_may_push(struct kd_render_queue *queue, const char *client)
{
    pthread_mutex_lock(&queue->lock);
    const bool may = kd_allowance_may(&queue->allowance, client, true, kd_clock_ms());
    pthread_mutex_unlock(&queue->lock);
    return may;
}

static bool may_have_it(const struct kd_claim *claim, void *user)
{
    const struct kd_render_job *job = (const struct kd_render_job *)claim;
    struct kd_render_queue *queue = user;
    /* After a failure, only jobs that are inside the renderer get turns, so that they can leave it. */
    if (queue->failed)
        return job->inside;
    /* freeing memory may close the device, so it waits until nobody uses the device */
    if (job == &queue->rest && (queue->compiling || queue->inside))
        return false;
    if (!queue->lost && (!may_be_paid(queue, claim) || !kd_render_has_kernels(queue, job)))
        return false;
    return kd_render_has_begun(job) || queue->lost ||
           (!(job->reads && kd_renderer_assets_begin(queue->renderer, &job->scene)) && frame_fits(queue, job) &&
            (job->stage != KD_RENDER_WAITS_FOR_LANE || lane_for(queue, job)));
}

/* Finds a cancelled job. It goes first, because ending it takes no time and needs no lane. */
static struct kd_render_job *first_dropped(const struct kd_render_queue *queue)
{
    struct kd_render_job *job = queue->jobs.first;
    while (job && !atomic_load(&job->drop) && !atomic_load(&queue->cancel))
        job = job->next;
    return job;
}

static struct kd_render_job *choose(struct kd_render_queue *queue)
{
    kd_render_ask_kernels(queue);
    struct kd_render_job *dropped = first_dropped(queue);
    return dropped ? dropped : (struct kd_render_job *)kd_shares_next(&queue->shares, may_have_it, queue);
}

static void begin(struct kd_render_queue *queue, struct kd_render_job *job)
{
    bool dropped = queue->lost || atomic_load(&job->drop) || atomic_load(&queue->cancel);
    struct kd_lane *lane = job->stage == KD_RENDER_WAITS_FOR_LANE && !dropped ? lane_for(queue, job) : NULL;
    job->stage = lane ? KD_RENDER_WORKS_IN_LANE : KD_RENDER_WORKS;
    if (!lane)
        return;
    lane->job = job;
    lane->bytes = is_large(queue, job) ? job->plan.cost.device_bytes : 0;
    queue->lane_bytes += lane->bytes;
}

void kd_render_next(struct kd_render_queue *queue)
{
    if (queue->holder || !queue->opened || queue->reopening)
        return;
    struct kd_render_job *job = choose(queue);
    if (!job) {
        kd_pulse_rest(&queue->pulse);
        return;
    }
    if (!kd_render_has_begun(job))
        begin(queue, job);
    job->turn_ms = kd_clock_ms();
    job->queue_ms += job->turn_ms - job->away_ms;
    queue->holder = job;
    kd_pulse_beat(&queue->pulse);
    pthread_cond_broadcast(&queue->changed);
}

/* Charges the job for the time that its present turn has taken so far. */
static void charge(struct kd_render_queue *queue, struct kd_render_job *job)
{
    const double now = kd_clock_ms(), ms = now - job->turn_ms;
    job->used_ms += ms;
    kd_shares_charge(&queue->shares, &job->claim, ms);
    kd_allowance_charge(&queue->allowance, job->claim.client, ms, now);
    job->turn_ms = now;
}

void kd_render_give_way(struct kd_render_queue *queue, struct kd_render_job *job)
{
    charge(queue, job);
    job->away_ms = job->turn_ms;
    queue->holder = NULL;
    kd_render_next(queue);
    while (queue->holder != job)
        pthread_cond_wait(&queue->changed, &queue->lock);
}

/* Called between two slices. Releases the device if another job comes first. */
static bool between_slices(void *user, double fraction)
{
    struct kd_render_job *job = user;
    struct kd_render_queue *queue = job->queue;
    pthread_mutex_lock(&queue->lock);
    charge(queue, job);
    job->claim.left_ms = job->plan.cost.estimate_ms * (1 - fraction);
    if (choose(queue) != job)
        kd_render_give_way(queue, job);
    kd_pulse_beat(&queue->pulse);
    const bool failed = queue->failed; /* true if the device failed while other jobs owned it */
    pthread_mutex_unlock(&queue->lock);
    if (failed)
        return false;
    if (job->progress)
        job->progress(job, fraction);
    return !kd_render_unwanted(queue, job);
}

static bool go_on(void *user, double fraction)
{
    struct kd_render_job *job = user;
    pthread_mutex_lock(&job->queue->lock);
    job->claim.left_ms = job->plan.cost.estimate_ms * (1 - fraction);
    kd_pulse_beat(&job->queue->pulse);
    pthread_mutex_unlock(&job->queue->lock);
    if (job->progress)
        job->progress(job, fraction);
    return !kd_render_unwanted(job->queue, job);
}

/* Updates the description of the device, because the speeds that the renderer measures change. Only the owner of the
 * device may call the renderer. Called without the lock. */
enum kd_status kd_render_describe_device(struct kd_render_queue *queue)
{
    struct kd_buffer json = { 0 }, old = { 0 };
    enum kd_status status = kd_renderer_device_json(queue->renderer, &json);
    if (status) {
        kd_buffer_finish(&json);
        return status;
    }
    pthread_mutex_lock(&queue->lock);
    old = queue->device_json;
    queue->device_json = json;
    pthread_mutex_unlock(&queue->lock);
    kd_buffer_finish(&old);
    return KD_OK;
}

/* Renders the job's picture. Called without the lock. */
static void render(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->more = false;
    job->status = kd_render_queue_lost(queue, &job->error) ? KD_EDEVICE : KD_OK;
    if (!job->status && kd_render_unwanted(queue, job))
        job->status = kd_error_set(&job->error, KD_ECANCELLED, "the render was cancelled before it began");
    if (job->status)
        return;
    const bool background = job->stage == KD_RENDER_WORKS_IN_LANE;
    if (job->run)
        job->status = job->run(job, queue->renderer, go_on, job);
    else if (job->blur.samples)
        job->status =
            kd_render_blurred(&(struct kd_blurred) { queue->renderer, &job->blur, &job->scene, &job->plan, background,
                                                     background ? between_slices : go_on, job->preview, job },
                              &job->frame, &job->error);
    else if (background)
        job->status = kd_render_in_background(queue->renderer, &job->scene, &job->plan, between_slices, job->preview,
                                              job, &job->frame, &job->error);
    else
        job->status = kd_render(queue->renderer, &job->scene, &job->plan, go_on, job, &job->frame, &job->error);
    if (job->status == KD_EDEVICE)
        kd_render_failed(queue, &job->error);
    else
        kd_render_describe_device(queue);
    if (!job->status && !job->run)
        kd_render_tell_kernels(job);
    if (!job->status && !job->run)
        kd_render_measures_frame(&queue->measures, &job->frame);
    if (!job->status && !job->run && job->rendered)
        job->rendered(job);
    if (!job->status && job->settled)
        job->ahead = kd_explain_ahead(queue->renderer, job->settled);
}

static void leave_lane(struct kd_render_queue *queue, struct kd_render_job *job)
{
    for (unsigned i = 0; i < queue->n_lanes; i++) {
        struct kd_lane *lane = &queue->lanes[i];
        if (lane->job != job)
            continue;
        lane->job = NULL;
        queue->lane_bytes -= lane->bytes;
    }
}

/* True if kernels for the pixels of a view may be searched for now. */
static bool looks_ahead(struct kd_render_queue *queue)
{
    const double now = kd_clock_ms();
    if (!queue->compiles || queue->ahead || queue->compiling_ahead || now - queue->ahead_ms < AHEAD_MS)
        return false;
    queue->ahead_ms = now;
    return true;
}

/* Runs one turn of the job, which owns the device. Releases the lock during the work. */
static void take_turn(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->inside = true;
    if (job->settled && !looks_ahead(queue))
        job->settled = NULL;
    queue->inside++;
    pthread_mutex_unlock(&queue->lock);
    render(queue, job);
    pthread_mutex_lock(&queue->lock);
    job->inside = false;
    queue->inside--;
    charge(queue, job);
    queue->worked_ms = job->turn_ms;
    queue->holder = NULL;
    kd_render_compile_ahead(queue, job->ahead);
    job->ahead = NULL;
    const bool again = kd_render_begins_with_kernels(queue, job) || kd_render_once_more(queue, job),
               more = again || (!job->status && job->more), encode = !more && !job->status && !job->run;
    if (!again)
        job->repeated = false; /* the job has made progress, so an earlier failure no longer counts */
    if (more)
        job->away_ms = job->turn_ms;
    else {
        kd_render_take_out(queue, job);
        kd_render_measures_waited(&queue->measures, job->claim.class, job->queue_ms);
    }
    if (again || !more)
        leave_lane(queue, job);
    if (encode)
        kd_render_encode(queue, job);
    kd_render_reopen(queue);
    kd_render_next(queue);
    pthread_cond_broadcast(&queue->changed);
    if (more || encode)
        return;
    pthread_mutex_unlock(&queue->lock);
    kd_render_finish(queue, job);
    pthread_mutex_lock(&queue->lock);
}

static void open_renderer(struct kd_render_queue *queue)
{
    enum kd_status status = kd_renderer_create(&queue->params, &queue->renderer, &queue->open_error);
    if (!status) {
        status = kd_render_describe_device(queue);
        if (status)
            kd_error_set(&queue->open_error, status, "the device could not be described");
    }
    pthread_mutex_lock(&queue->lock);
    queue->open_status = status;
    queue->opened = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

void *kd_render_short_main(void *user)
{
    struct kd_render_queue *queue = user;
    open_renderer(queue);
    pthread_mutex_lock(&queue->lock);
    while (!queue->open_status && (!queue->closing || queue->jobs.first)) {
        if (queue->holder && queue->holder->stage != KD_RENDER_WORKS_IN_LANE)
            take_turn(queue, queue->holder);
        else
            pthread_cond_wait(&queue->changed, &queue->lock);
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}

void *kd_render_lane_main(void *user)
{
    struct kd_lane *lane = user;
    struct kd_render_queue *queue = lane->queue;
    pthread_mutex_lock(&queue->lock);
    while (!queue->closing || queue->jobs.first) {
        if (lane->job && queue->holder == lane->job)
            take_turn(queue, lane->job);
        else
            pthread_cond_wait(&queue->changed, &queue->lock);
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}
