/* Renders the frames of sessions through the render queue. */
#include "base/clock.h"
#include "server/session/session_internal.h"
#include "server/session/sessions.h"
#include "render/emit/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Time constant of auto exposure in ms: within this time, the exposure follows 63 % of a change. */
#define EXPOSURE_MS 2000.0
#define IDLE_MS 5e3 /* time in ms without a change by the user after which other work of the client goes first */
#define SURE 0.02   /* the remaining time is estimated only when this fraction of a picture is done */
/* Maximum number of a session's frames that are rendered but not encoded: one frame can be traced while another one
 * is encoded. */
#define ENCODING_MAX 2

struct kd_session_frame {
    struct kd_render_job job; /* must be the first member, because the queue stores a pointer to it */
    struct kd_session *session;
    struct kd_scene whole; /* the scene in full quality */
    uint64_t number;
    unsigned revision;
    double begun_ms;
    struct kd_frame_decision decision;
    struct kd_dynamic_bodies *dynamic; /* a counted reference to the bodies of a playground in this scene */
    double fraction;                   /* fraction of the frame that is done */
    bool rendered, last;               /* last: true if neither a refinement nor another frame follows */
};

/* The functions below are called with the lock held, unless their comment says otherwise. */

static void progress(struct kd_render_job *job, double fraction);
static void rendered(struct kd_render_job *job);
static void done(struct kd_render_job *job);

static void fail(struct kd_session *s, const struct kd_error *error)
{
    s->failed = error->status ? error->status : KD_EDEVICE;
    s->error = *error;
    kd_session_wake(s);
}

/* Slows auto exposure down while only time advances. The automatic exposure depends on the few brightest pixels, which
 * show different particles in each frame. Without the slowdown the picture would flicker. */
static void follow_exposure(const struct kd_session *s, double now, struct kd_plan *plan)
{
    plan->picture.exposure_from = s->exposure;
    plan->picture.exposure_share = -expm1(-fmax(now - s->exposed_ms, 1) / EXPOSURE_MS);
}

/* Makes a frame for the render queue. Returns NULL, with the reason in *error, if it cannot be made. */
static struct kd_session_frame *make_frame(struct kd_session *s, const struct kd_scene *scene,
                                           const struct kd_frame_decision *decision, double now, struct kd_error *error)
{
    struct kd_session_frame *live = calloc(1, sizeof *live);
    struct kd_capacity capacity;
    if (!live) {
        kd_error_set(error, KD_ENOMEM, "out of memory for a frame");
        return NULL;
    }
    live->session = s;
    live->decision = *decision;
    live->begun_ms = now;
    live->job = (struct kd_render_job) {
        .claim.class = decision->refining              ? KD_CLASS_REFINEMENT
                       : now - s->patched_ms > IDLE_MS ? KD_CLASS_IDLE
                                                       : KD_CLASS_LIVE,
        .socket = -1,
        .format = kd_format_live(),
        .effort = KD_EFFORT_LIVE,
        .progress = progress,
        .rendered = rendered,
        .done = done,
    };
    memcpy(live->job.claim.client, s->demand.client, sizeof s->demand.client);
    live->whole = *scene;
    kd_quality_apply(&decision->quality, scene, &live->job.scene);
    if (s->dynamic) {
        kd_scene_show(&live->job.scene, s->dynamic);
        kd_scene_pass(&live->job.scene, s->dynamic->time);
    }
    live->job.scene.image.bit_depth = 8;
    kd_render_queue_capacity(s->all->params.renders, &capacity);
    struct kd_needs needs = kd_needs_of(&live->job.scene);
    needs.sketch = decision->quality.sketch;
    needs.bright = decision->quality.bright;
    needs.reuse_normalisation = !decision->refining && !decision->quality.final;
    if (kd_plan_make_for(&live->job.scene, &needs, &capacity, &live->job.plan, error)) {
        free(live);
        return NULL;
    }
    live->job.plan.lens.audit /= decision->audit;
    if (!decision->refining && s->exposed_revision == s->revision &&
        (kd_emit_moves(scene) || s->dynamic || kd_session_on_its_way(s, now)))
        follow_exposure(s, now, &live->job.plan);
    return live;
}

void kd_session_pump(struct kd_session *s)
{
    if (!s->listed || s->failed || s->rendering || s->encoding >= ENCODING_MAX || !kd_session_awaited(s) ||
        (s->crowded && !s->dynamic))
        return;
    double now = kd_clock_ms();
    struct kd_scene scene;
    struct kd_error error = { 0 };
    if (kd_session_scene(s, now, &scene, &error)) {
        fail(s, &error);
        return;
    }
    s->on_path = scene;
    const bool flies = kd_session_on_its_way(s, now) || kd_scene_falls(&scene), moves = flies || kd_emit_moves(&scene);
    /* If the scene moved in the latest frame and is at rest now, the next frame differs too. */
    if (moves || s->moved || s->dynamic_moved)
        kd_session_govern(s, now, &scene, flies || s->flew);
    const struct kd_frame_decision decision = kd_governor_decide(&s->governor, now);
    if (decision.wait_ms > 0)
        return; /* no frame starts now; kd_sessions_sweep will call this function again */
    struct kd_session_frame *live = make_frame(s, &scene, &decision, now, &error);
    if (!live) {
        fail(s, &error);
        return;
    }
    live->number = ++s->begun;
    live->last = decision.quality.final && !moves;
    live->job.keeps = !s->crowded;
    if (!s->dynamic && (live->last || live->job.claim.class == KD_CLASS_IDLE))
        live->job.settled = &live->whole;
    live->dynamic = s->dynamic;
    kd_dynamic_bodies_keep(live->dynamic);
    s->dynamic_moved = false;
    s->moved = moves;
    s->flew = flies;
    live->revision = s->revision;
    s->rendering = live;
    s->references++;
    if (!decision.refining)
        kd_budget_ask(&s->demand, now);
    kd_render_queue_push(s->all->params.renders, &live->job);
}

void kd_session_drop_refinement(struct kd_session *s)
{
    if (s->rendering && s->rendering->decision.refining)
        kd_session_drop(s);
}

void kd_session_drop(struct kd_session *s)
{
    if (s->rendering)
        atomic_store(&s->rendering->job.drop, true);
}

static void add_cost(struct kd_frame_cost *cost, const char *pass, double ms)
{
    const struct kd_pass *known = kd_pass_find(pass);
    if (known)
        *(known->scale == KD_SCALE_RAYS     ? &cost->rays_ms
          : known->scale == KD_SCALE_PIXELS ? &cost->pixels_ms
                                            : &cost->fixed_ms) += ms;
    else if (!strcmp(pass, "total"))
        cost->total_ms = ms;
}

/* Cost of a frame without its encoding, which overlaps with the next frame, and takes a tenth of the time or less
 * (bench/live.py). */
static struct kd_frame_cost cost_of(const struct kd_render_job *job)
{
    const struct kd_frame *frame = &job->frame;
    struct kd_frame_cost cost = { .lens_reused = frame->lens_reused };
    for (size_t i = 0; i < frame->n_timings; i++)
        add_cost(&cost, frame->timings[i].name, frame->timings[i].ms);
    return cost;
}

static void share_device(struct kd_session *s, double now)
{
    kd_governor_share(&s->governor, kd_budget_share(&s->all->budget, &s->demand, now));
}

void kd_session_expect(struct kd_session *s, const struct kd_plan_cost *cost)
{
    share_device(s, kd_clock_ms());
    struct kd_frame_cost traced = { .total_ms = cost->estimate_ms },
                         reused = { .total_ms = cost->estimate_ms, .lens_reused = true };
    for (size_t i = 0; i < cost->n_passes; i++) {
        const struct kd_plan_pass *pass = &cost->passes[i];
        add_cost(&traced, pass->name, pass->estimate_ms);
        if (kd_pass_find(pass->name)->when == KD_EACH_MAP)
            reused.total_ms -= pass->estimate_ms;
        else
            add_cost(&reused, pass->name, pass->estimate_ms);
    }
    kd_governor_expect(&s->governor, &traced);
    kd_governor_expect(&s->governor, &reused);
}

/* Stores the progress of a frame. Called on the render thread, without the lock. */
static void progress(struct kd_render_job *job, double fraction)
{
    struct kd_session_frame *live = (struct kd_session_frame *)job;
    pthread_mutex_lock(&live->session->all->lock);
    live->fraction = fraction;
    pthread_mutex_unlock(&live->session->all->lock);
}

/* Estimates the remaining time from the elapsed time, in which waiting for others is included. */
struct kd_session_progress kd_session_progress_of(const struct kd_session *s, double now)
{
    const struct kd_session_frame *live = s->rendering;
    if (!live)
        return (struct kd_session_progress) { .fraction = NAN, .left_s = NAN };
    return (struct kd_session_progress) {
        .refines = live->decision.refining,
        .fraction = live->fraction,
        .left_s = live->fraction > SURE ? 1e-3 * (now - live->begun_ms) * (1 - live->fraction) / live->fraction : NAN,
    };
}

/* Called on the render thread, without the lock. From now on the next frame may be traced, while this one is
 * encoded. */
static void rendered(struct kd_render_job *job)
{
    struct kd_session_frame *live = (struct kd_session_frame *)job;
    struct kd_session *s = live->session;
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    live->rendered = true;
    kd_session_choose_kind(s, live->last, job);
    s->rendering = NULL;
    s->encoding++;
    s->exposed_ms = live->begun_ms;
    s->exposure = job->frame.exposure;
    s->exposed_revision = live->revision;
    const struct kd_frame_cost cost = cost_of(job);
    const double now = kd_clock_ms();
    if (!live->decision.refining)
        kd_budget_end(&s->demand, now, cost.total_ms);
    share_device(s, now);
    kd_governor_frame(&s->governor, now, &live->decision, &cost);
    kd_session_pump(s);
    pthread_mutex_unlock(&all->lock);
}

static void publish(struct kd_session *s, struct kd_session_frame *live)
{
    double now = kd_clock_ms();
    if (s->latest && s->latest->number > live->number)
        return; /* a newer frame was already published */
    if (s->shown_ms > 0 && now - s->shown_ms < 1000)
        s->interval_ms += (s->interval_ms > 0 ? 0.2 : 1) * (now - s->shown_ms - s->interval_ms);
    else
        s->interval_ms = 0;
    s->shown_ms = now;
    const struct kd_live_note note = { live->number, live->revision, live->decision.quality.final, live->last,
                                       s->interval_ms > 0 ? 1e3 / s->interval_ms : 0 };
    struct kd_live_frame *frame = kd_live_frame_make(&live->job, &note);
    if (!frame)
        return; /* out of memory: this frame is lost, but the next one may succeed */
    kd_live_frame_release(s->latest);
    s->latest = frame;
    s->all->frames++;
    s->all->bytes += frame->files[0].bytes.size;
    kd_session_wake(s);
    kd_session_add_kinds(s);
}

/* Publishes a finished frame or records its failure, and then begins the next frame. Called on a thread of the
 * queue, without the lock. */
static void done(struct kd_render_job *job)
{
    struct kd_session_frame *live = (struct kd_session_frame *)job;
    struct kd_session *s = live->session;
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    if (live->rendered) {
        s->encoding--;
    } else {
        s->rendering = NULL;
        if (!live->decision.refining)
            kd_budget_end(&s->demand, kd_clock_ms(), 0);
    }
    job->error.status = job->status;
    if (!job->status)
        publish(s, live);
    else if (job->status != KD_ECANCELLED && (job->status != KD_EDEVICE ||
                                              /* if the device was only reopened, the next frame may succeed */
                                              kd_render_queue_lost(all->params.renders, NULL)))
        fail(s, &job->error);
    kd_session_pump(s);
    kd_session_unref(s);
    pthread_mutex_unlock(&all->lock);
    kd_buffer_finish(&job->file);
    kd_frame_finish(&job->frame);
    kd_dynamic_bodies_release(live->dynamic);
    free(live);
}
