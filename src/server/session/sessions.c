#include "base/clock.h"
#include "server/session/session_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNTS_MS 20. /* maximum time in ms that a reader of counts waits for the lock */

#define TARGET_MS 33.0 /* intended time for a frame while the scene changes, in ms */

enum kd_status kd_sessions_create(const struct kd_sessions_params *params, struct kd_sessions **out,
                                  struct kd_error *error)
{
    struct kd_sessions *all = calloc(1, sizeof *all);
    if (!all)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    all->params = *params;
    pthread_mutex_init(&all->lock, NULL);
    *out = all;
    return KD_OK;
}

/* All functions from here on are called with the lock held. */

void kd_session_unref(struct kd_session *s)
{
    if (--s->references)
        return;
    kd_live_frame_release(s->latest);
    kd_dynamic_bodies_release(s->dynamic);
    kd_timeline_finish(&s->path);
    free(s);
}

void kd_session_unlist(struct kd_session *s)
{
    if (!s->listed)
        return;
    struct kd_session **link = &s->all->first;
    while (*link != s)
        link = &(*link)->next;
    *link = s->next;
    s->listed = false;
    s->all->count--;
    kd_budget_leave(&s->all->budget, &s->demand);
    kd_session_drop(s);
    kd_session_wake(s);
    kd_session_unref(s);
}

static double seconds_of(const struct kd_session *s, double now) { return fmax(1e-3 * (now - s->since_ms), 0); }

bool kd_session_on_its_way(const struct kd_session *s, double now)
{
    return seconds_of(s, now) < kd_timeline_end(&s->path);
}

enum kd_status kd_session_scene(const struct kd_session *s, double now, struct kd_scene *out, struct kd_error *error)
{
    const double seconds = seconds_of(s, now);
    enum kd_status status = KD_OK;
    *out = s->scene;
    if (s->path.n_keys)
        status = kd_timeline_scene(&s->path, fmin(seconds, kd_timeline_end(&s->path)), out, error);
    if (!status)
        kd_scene_advance(out, seconds);
    return status;
}

/* Returns the present scene. If the scene on the path is not valid now, returns the latest valid one. */
static struct kd_scene scene_now(const struct kd_session *s, double now)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    return kd_session_scene(s, now, &scene, &error) ? s->on_path : scene;
}

/* All functions from here on take the lock themselves. */

enum kd_status kd_sessions_takes(const struct kd_sessions *all, const struct kd_plan *plan, struct kd_error *error)
{
    if (plan->picture.n_layers + plan->picture.rgb > 1)
        return kd_error_field(error, "/image/layers",
                              "image.layers has %zu layers; in a session, which shows one picture, it must have one",
                              plan->picture.n_layers + plan->picture.rgb);
    if (plan->picture.cut.width)
        return kd_error_field(
            error, "/image/tile/width",
            "image.tile.width is %u; in a session, which shows whole pictures of any size, it must be 0",
            plan->picture.cut.width);
    if (plan->cost.estimate_ms <= all->params.longest_s * 1e3)
        return KD_OK;
    return kd_error_set(error, KD_ETOOBIG, "a frame of this scene would take about %.0f s; it must be at most %u s",
                        plan->cost.estimate_ms * 1e-3, all->params.longest_s);
}

static enum kd_status make_plan(struct kd_sessions *all, const struct kd_scene *scene, struct kd_plan *plan,
                                struct kd_error *error)
{
    struct kd_capacity capacity;
    kd_render_queue_capacity(all->params.renders, &capacity);
    enum kd_status status = kd_plan_make(scene, &capacity, plan, error);
    return status ? status : kd_sessions_takes(all, plan, error);
}

enum kd_status kd_sessions_open(struct kd_sessions *all, const struct kd_scene *scene, const struct kd_plan *plan,
                                const char *client, bool crowded, const struct kd_session_pace *pace, bool *quota,
                                struct kd_session **out, struct kd_error *error)
{
    *quota = kd_render_queue_afford(all->params.renders, client, error) != KD_OK;
    if (*quota)
        return KD_EBUSY;
    struct kd_session *s = calloc(1, sizeof *s);
    if (!s || !kd_secret_make(s->id, sizeof s->id) || !kd_secret_make(s->token, sizeof s->token)) {
        free(s);
        return kd_error_set(error, KD_ENOMEM, "no memory or no random numbers for a session");
    }
    s->all = all;
    s->references = 2; /* one for the list, and one for the caller */
    s->crowded = crowded;
    snprintf(s->demand.client, sizeof s->demand.client, "%s", client);
    s->scene = *scene;
    s->revision = 1;
    s->since_ms = s->used_ms = s->patched_ms = kd_clock_ms();
    memcpy(s->lens_key, plan->lens.key, sizeof s->lens_key);
    kd_governor_init(&s->governor, kd_governor_params(.target_ms = TARGET_MS));
    if (pace)
        kd_governor_least(&s->governor, pace->min_scale, pace->max_frame_ms);
    kd_governor_changed(&s->governor, s->since_ms, scene, true);
    pthread_mutex_lock(&all->lock);
    unsigned own = 0;
    for (const struct kd_session *other = all->first; other; other = other->next)
        own += !strcmp(other->demand.client, client);
    bool full = all->closed || all->count >= all->params.limit;
    if (!full && own >= all->params.client_limit) {
        pthread_mutex_unlock(&all->lock);
        free(s);
        *quota = true;
        return kd_error_set(error, KD_EBUSY, "you have too many open sessions (limit %u for one client)", own);
    }
    if (full) {
        unsigned n = all->count;
        pthread_mutex_unlock(&all->lock);
        free(s);
        return kd_error_set(error, KD_EBUSY, "too many open sessions (limit %u)", n);
    }
    s->listed = true;
    s->next = all->first;
    all->first = s;
    all->count++;
    kd_budget_enter(&all->budget, &s->demand);
    kd_session_expect(s, &plan->cost);
    kd_session_pump(s);
    pthread_mutex_unlock(&all->lock);
    *out = s;
    return KD_OK;
}

struct kd_session *kd_sessions_find(struct kd_sessions *all, const char *id)
{
    pthread_mutex_lock(&all->lock);
    struct kd_session *s = all->first;
    while (s && strcmp(s->id, id))
        s = s->next;
    if (s) {
        s->references++;
        s->used_ms = kd_clock_ms();
    }
    pthread_mutex_unlock(&all->lock);
    return s;
}

void kd_session_promise(struct kd_session *s, const struct kd_once *once)
{
    pthread_mutex_lock(&s->all->lock);
    s->once = *once;
    pthread_mutex_unlock(&s->all->lock);
}

struct kd_session *kd_sessions_find_once(struct kd_sessions *all, const char *key)
{
    char id[KD_SECRET_ID] = "";
    pthread_mutex_lock(&all->lock);
    for (const struct kd_session *s = all->first; s && *key; s = s->next)
        if (!strcmp(s->once.key, key))
            memcpy(id, s->id, sizeof id);
    pthread_mutex_unlock(&all->lock);
    return *id ? kd_sessions_find(all, id) : NULL;
}

const struct kd_once *kd_session_once(const struct kd_session *s) { return &s->once; }

void kd_session_release(struct kd_session *s)
{
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    kd_session_unref(s);
    pthread_mutex_unlock(&all->lock);
}

const char *kd_session_id(const struct kd_session *s) { return s->id; }
const char *kd_session_token(const struct kd_session *s) { return s->token; }

bool kd_session_owned(const struct kd_session *s, const char *token) { return kd_secret_equal(s->token, token); }

static unsigned viewers_of(const struct kd_session *s) /* called with the lock held */
{
    unsigned n = 0;
    for (const struct kd_viewer *v = s->viewers; v; v = v->next)
        n++;
    return n;
}

static void state(const struct kd_session *s, struct kd_session_state *out) /* called with the lock held */
{
    const double now = kd_clock_ms(), end = kd_timeline_end(&s->path);
    *out = (struct kd_session_state) { .scene = scene_now(s, now),
                                       .revision = s->revision,
                                       .viewers = viewers_of(s),
                                       .frame = s->latest ? s->latest->number : 0,
                                       .order = s->order,
                                       .path_at = fmin(seconds_of(s, now), end),
                                       .path_end = end };
    out->progress = kd_session_progress_of(s, now);
}

void kd_session_state(struct kd_session *s, struct kd_session_state *out)
{
    pthread_mutex_lock(&s->all->lock);
    state(s, out);
    pthread_mutex_unlock(&s->all->lock);
}

void kd_session_govern(struct kd_session *s, double now, const struct kd_scene *scene, bool lens)
{
    struct kd_scene shown = *scene;
    kd_scene_show(&shown, s->dynamic);
    kd_governor_changed(&s->governor, now, &shown, lens);
}

/* Sets the scene. Called with the lock held. */
static void change(struct kd_session *s, double now, const struct kd_scene *scene, const struct kd_plan *plan)
{
    s->scene = *scene;
    s->since_ms = now;
    s->revision++;
    s->patched_ms = now;
    s->failed = KD_OK;
    kd_session_govern(s, now, scene, strcmp(s->lens_key, plan->lens.key) != 0);
    kd_session_expect(s, &plan->cost);
    memcpy(s->lens_key, plan->lens.key, sizeof s->lens_key);
    kd_session_drop_refinement(s);
    kd_session_pump(s);
}

enum kd_status kd_session_edit(struct kd_session *s, kd_scene_edit *edit, const void *to, uint64_t order,
                               struct kd_session_state *out, struct kd_error *error)
{
    struct kd_plan plan;
    double now = kd_clock_ms();
    if (order && order <= s->order) { /* no lock is needed here, because only the HTTP thread writes s->order */
        kd_session_state(s, out);
        return KD_OK;
    }
    pthread_mutex_lock(&s->all->lock);
    struct kd_scene scene = scene_now(s, now);
    /* The scene does not change without the lock, because only the HTTP thread patches it. */
    pthread_mutex_unlock(&s->all->lock);
    enum kd_status status;
    KD_TRY(edit(&scene, to, error));
    KD_TRY(kd_scene_resolve(&scene, s->all->params.assets, error));
    KD_TRY(kd_scene_validate(&scene, error));
    KD_TRY(make_plan(s->all, &scene, &plan, error));
    pthread_mutex_lock(&s->all->lock);
    kd_timeline_finish(&s->path);
    if (order)
        s->order = order;
    change(s, now, &scene, &plan);
    state(s, out);
    pthread_mutex_unlock(&s->all->lock);
done:
    return status;
}

void kd_session_keep(struct kd_session *s, const struct kd_session_pace *pace)
{
    pthread_mutex_lock(&s->all->lock);
    kd_governor_least(&s->governor, pace->min_scale, pace->max_frame_ms);
    pthread_mutex_unlock(&s->all->lock);
}

void kd_session_put(struct kd_session *s, const struct kd_scene *scene, const struct kd_plan *plan)
{
    pthread_mutex_lock(&s->all->lock);
    kd_timeline_finish(&s->path);
    change(s, kd_clock_ms(), scene, plan);
    pthread_mutex_unlock(&s->all->lock);
}

void kd_session_show(struct kd_session *s, struct kd_dynamic_bodies *dynamic)
{
    pthread_mutex_lock(&s->all->lock);
    struct kd_dynamic_bodies *old = s->dynamic;
    s->dynamic = dynamic;
    s->dynamic_moved = true;
    kd_session_drop_refinement(s);
    kd_session_pump(s);
    pthread_mutex_unlock(&s->all->lock);
    kd_dynamic_bodies_release(old);
}

unsigned kd_session_viewers(struct kd_session *s)
{
    pthread_mutex_lock(&s->all->lock);
    const unsigned n = viewers_of(s);
    pthread_mutex_unlock(&s->all->lock);
    return n;
}

bool kd_session_watched(struct kd_session *s) { return kd_session_viewers(s) > 0; }

bool kd_session_over(struct kd_session *s)
{
    pthread_mutex_lock(&s->all->lock);
    const bool over = !s->listed || s->failed;
    pthread_mutex_unlock(&s->all->lock);
    return over;
}

bool kd_session_hungry(struct kd_session *s)
{
    pthread_mutex_lock(&s->all->lock);
    const bool hungry = !s->dynamic_moved;
    pthread_mutex_unlock(&s->all->lock);
    return hungry;
}

void kd_session_go_on_from(struct kd_session *s, struct kd_session *other)
{
    pthread_mutex_lock(&s->all->lock);
    s->begun = other->begun;
    pthread_mutex_unlock(&s->all->lock);
}

struct kd_session *kd_session_share(struct kd_session *s)
{
    pthread_mutex_lock(&s->all->lock);
    s->references++;
    pthread_mutex_unlock(&s->all->lock);
    return s;
}

enum kd_status kd_session_follow(struct kd_session *s, struct kd_timeline *path, struct kd_session_state *out,
                                 struct kd_error *error)
{
    struct kd_plan plan;
    enum kd_status status;
    KD_TRY(make_plan(s->all, &path->keys[0].scene, &plan, error));
    const double now = kd_clock_ms();
    pthread_mutex_lock(&s->all->lock);
    kd_timeline_finish(&s->path);
    s->path = *path;
    s->on_path = path->keys[0].scene;
    *path = (struct kd_timeline) { 0 };
    change(s, now, &s->path.keys[0].scene, &plan);
    state(s, out);
    pthread_mutex_unlock(&s->all->lock);
done:
    return status;
}

enum kd_status kd_session_stop(struct kd_session *s, struct kd_error *error)
{
    struct kd_plan plan;
    const double now = kd_clock_ms();
    pthread_mutex_lock(&s->all->lock);
    const bool goes = s->path.n_keys;
    const struct kd_scene scene = scene_now(s, now);
    /* The scene does not change without the lock, because only the HTTP thread changes it. */
    pthread_mutex_unlock(&s->all->lock);
    enum kd_status status = KD_OK;
    if (!goes)
        return status;
    KD_TRY(make_plan(s->all, &scene, &plan, error));
    pthread_mutex_lock(&s->all->lock);
    kd_timeline_finish(&s->path);
    change(s, now, &scene, &plan);
    pthread_mutex_unlock(&s->all->lock);
done:
    return status;
}

void kd_session_end(struct kd_session *s)
{
    pthread_mutex_lock(&s->all->lock);
    kd_session_unlist(s);
    pthread_mutex_unlock(&s->all->lock);
}

void kd_sessions_close(struct kd_sessions *all)
{
    pthread_mutex_lock(&all->lock);
    all->closed = true;
    while (all->first)
        kd_session_unlist(all->first);
    pthread_mutex_unlock(&all->lock);
}

bool kd_sessions_counts(struct kd_sessions *all, struct kd_sessions_counts *out)
{
    if (!kd_clock_lock(&all->lock, COUNTS_MS))
        return false;
    *out = (struct kd_sessions_counts) { .sessions = all->count, .frames = all->frames, .bytes = all->bytes };
    for (const struct kd_session *s = all->first; s; s = s->next)
        out->viewers += viewers_of(s);
    pthread_mutex_unlock(&all->lock);
    return true;
}

void kd_sessions_destroy(struct kd_sessions *all)
{
    if (!all)
        return;
    kd_sessions_close(all);
    pthread_mutex_destroy(&all->lock);
    free(all);
}
