#include "server/playground/playground_internal.h"

#include "base/clock.h"
#include "base/log.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNTS_MS 20.   /* maximum time in ms that a reader of counts waits for the lock */
#define SLOWED_MS 1000. /* time in ms for which the state reports that simulated time was skipped */
/* Memory of a session with this debris capacity. A change is made on a copy of the playground, so debris and all
 * other state count twice. */
#define BASE_BYTES ((size_t)6 << 20)
#define BYTES(capacity) (BASE_BYTES + 2 * (size_t)(capacity) * sizeof(struct kd_debris_piece))

enum kd_status kd_playground_sessions_create(const struct kd_playground_sessions_params *params,
                                             struct kd_playground_sessions **out, struct kd_error *error)
{
    struct kd_playground_sessions *all = calloc(1, sizeof *all);
    if (!all)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    all->params = *params;
    pthread_mutex_init(&all->lock, NULL);
    enum kd_status status;
    all->bytes = kd_bytes_create(
        &(struct kd_bytes_params) { .clients = params->limit, .max = params->bytes, .share = params->client_bytes });
    if (!all->bytes)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    KD_TRY(kd_scheduler_create(params->limit, params->client_limit, &all->scheduler, error));
done:
    if (status)
        kd_playground_sessions_destroy(all);
    else
        *out = all;
    return status;
}

void kd_playground_sessions_destroy(struct kd_playground_sessions *all)
{
    if (!all)
        return;
    kd_scheduler_destroy(all->scheduler);
    kd_bytes_destroy(all->bytes);
    pthread_mutex_destroy(&all->lock);
    free(all);
}

/* All functions from here on are called with the lock held. */

struct kd_playground_session *kd_playground_session_unref(struct kd_playground_session *play)
{
    if (--play->references)
        return NULL;
    kd_playground_session_hide(play);
    kd_bytes_give(play->all->bytes, play->scheduled.client, play->bytes);
    return play;
}

void kd_playground_session_call(struct kd_playground_session *play)
{
    if (play->listed)
        kd_scheduler_wake(play->all->scheduler, &play->scheduled);
}

void kd_playground_session_unlist(struct kd_playground_session *play, const char *why)
{
    if (!play->listed)
        return;
    struct kd_playground_session **link = &play->all->first;
    while (*link != play)
        link = &(*link)->next;
    *link = play->next;
    kd_scheduler_wake(play->all->scheduler, &play->scheduled); /* so that the job runs its last slice */
    play->listed = false;
    play->why = why;
    kd_playground_session_hide(play);
    play->all->count--;
    kd_playground_session_wake(play, kd_clock_ms());
}

bool kd_playground_session_awake(const struct kd_playground_session *play, double now)
{
    return play->watchers || now - play->used_ms < KD_PLAY_REST_MS || kd_playground_session_looked_at(play);
}

static unsigned watchers_of(const struct kd_playground_session *play)
{
    unsigned n = 0;
    for (const struct kd_playground_session_watcher *w = play->watchers; w; w = w->next)
        n++;
    return n + kd_playground_session_viewers(play);
}

/* All functions from here on take the lock themselves. */

void kd_playground_session_destroy(struct kd_playground_session *play)
{
    if (!play)
        return;
    kd_playground_session_tick_release(play->tick);
    kd_playground_destroy(play->p);
    free(play);
}

/* Drops the reference that the job holds. */
static void done(struct kd_scheduler_job *job) { kd_playground_session_release((struct kd_playground_session *)job); }

static struct kd_playground_session *make(struct kd_playground_sessions *all,
                                          const struct kd_playground_session_pace *pace, const char *client)
{
    struct kd_playground_session *play = calloc(1, sizeof *play);
    if (!play || !kd_secret_make(play->id, sizeof play->id) || !kd_secret_make(play->token, sizeof play->token)) {
        free(play);
        return NULL;
    }
    play->scheduled = (struct kd_scheduler_job) { .turn = kd_playground_session_turn, .done = done };
    snprintf(play->scheduled.client, sizeof play->scheduled.client, "%s", client);
    play->all = all;
    play->references = 2; /* one for the job, and one for the caller */
    play->pace = *pace;
    play->used_ms = kd_clock_ms();
    play->generation = 1;
    play->held = true;
    play->waiter = (struct kd_playground_session_waiter) { .scheduler = all->scheduler, .job = &play->scheduled };
    return play;
}

/* Tests whether the limits of sessions and memory permit another session. Called with the lock held. */
static enum kd_status admit(struct kd_playground_sessions *all, const char *client, size_t bytes, bool *quota,
                            struct kd_error *error)
{
    unsigned own = 0;
    for (const struct kd_playground_session *other = all->first; other; other = other->next)
        own += !strcmp(other->scheduled.client, client);
    *quota = !all->closed && all->count < all->params.limit && own >= all->params.client_limit;
    if (*quota)
        return kd_error_set(error, KD_EBUSY, "you have too many open playgrounds (limit %u for one client)", own);
    if (all->closed || all->count >= all->params.limit)
        return kd_error_set(error, KD_EBUSY, "too many open playgrounds (limit %u)", all->count);
    if (kd_bytes_take(all->bytes, client, bytes, bytes, quota))
        return kd_error_set(error, KD_EBUSY, "the debris of this playground needs %zu MiB, more than is free %s",
                            bytes >> 20, *quota ? "of your share" : "on this server");
    return KD_OK;
}

enum kd_status kd_playground_sessions_open(struct kd_playground_sessions *all, struct kd_playground **p,
                                           const struct kd_playground_session_pace *pace, const struct kd_scene *scene,
                                           const char *client, bool *quota, struct kd_playground_session **out,
                                           struct kd_error *error)
{
    const size_t bytes = BYTES((*p)->debris.capacity);
    struct kd_playground_session *play = make(all, pace, client);
    *quota = false;
    if (!play)
        return kd_error_set(error, KD_ENOMEM, "no memory or no random numbers for a playground");
    pthread_mutex_lock(&all->lock);
    enum kd_status status = admit(all, client, bytes, quota, error);
    if (!status) {
        play->p = *p;
        play->scene = *scene;
        *p = NULL;
        play->bytes = bytes;
        play->log.last = play->log_begin = play->p->events.last;
        play->listed = true;
        play->next = all->first;
        all->first = play;
        all->count++;
        kd_scheduler_push(all->scheduler, &play->scheduled);
    }
    pthread_mutex_unlock(&all->lock);
    if (status) {
        free(play);
        return status;
    }
    *out = play;
    return KD_OK;
}

struct kd_playground_session *kd_playground_sessions_find(struct kd_playground_sessions *all, const char *id)
{
    pthread_mutex_lock(&all->lock);
    struct kd_playground_session *play = all->first;
    while (play && strcmp(play->id, id))
        play = play->next;
    if (play) {
        const double now = kd_clock_ms();
        const bool rested = !kd_playground_session_awake(play, now);
        play->references++;
        play->used_ms = now;
        if (rested)
            kd_playground_session_call(play);
    }
    pthread_mutex_unlock(&all->lock);
    return play;
}

void kd_playground_session_promise(struct kd_playground_session *play, const struct kd_once *once)
{
    pthread_mutex_lock(&play->all->lock);
    play->once = *once;
    pthread_mutex_unlock(&play->all->lock);
}

struct kd_playground_session *kd_playground_sessions_find_once(struct kd_playground_sessions *all, const char *key)
{
    char id[KD_SECRET_ID] = "";
    pthread_mutex_lock(&all->lock);
    for (const struct kd_playground_session *play = all->first; play && *key; play = play->next)
        if (!strcmp(play->once.key, key))
            memcpy(id, play->id, sizeof id);
    pthread_mutex_unlock(&all->lock);
    return *id ? kd_playground_sessions_find(all, id) : NULL;
}

const struct kd_once *kd_playground_session_once(const struct kd_playground_session *play) { return &play->once; }

void kd_playground_session_release(struct kd_playground_session *play)
{
    if (!play)
        return;
    struct kd_playground_sessions *all = play->all;
    pthread_mutex_lock(&all->lock);
    struct kd_playground_session *unused = kd_playground_session_unref(play);
    pthread_mutex_unlock(&all->lock);
    kd_playground_session_destroy(unused);
}

const char *kd_playground_session_id(const struct kd_playground_session *play) { return play->id; }
const char *kd_playground_session_token(const struct kd_playground_session *play) { return play->token; }
bool kd_playground_session_owned(const struct kd_playground_session *play, const char *token)
{
    return kd_secret_equal(play->token, token);
}

void kd_playground_session_end(struct kd_playground_session *play, const char *why)
{
    pthread_mutex_lock(&play->all->lock);
    kd_playground_session_unlist(play, why);
    pthread_mutex_unlock(&play->all->lock);
}

struct kd_playground *kd_playground_session_take(struct kd_playground_session *play,
                                                 struct kd_playground_session_waiter *waiter)
{
    struct kd_playground *p = NULL;
    pthread_mutex_lock(&play->all->lock);
    if (!play->held) {
        play->held = true;
        p = play->p;
    } else if (!waiter->listed) {
        waiter->listed = true;
        waiter->next = play->waiters;
        play->waiters = waiter;
    }
    pthread_mutex_unlock(&play->all->lock);
    return p;
}

void kd_playground_session_give(struct kd_playground_session *play, struct kd_playground *p)
{
    pthread_mutex_lock(&play->all->lock);
    play->p = p;
    play->held = false;
    for (struct kd_playground_session_waiter *waiter = play->waiters, *next; waiter; waiter = next) {
        next = waiter->next;
        waiter->listed = false;
        kd_scheduler_wake(waiter->scheduler, waiter->job);
    }
    play->waiters = NULL;
    pthread_mutex_unlock(&play->all->lock);
}

void kd_playground_session_moved(struct kd_playground_session *play)
{
    pthread_mutex_lock(&play->all->lock);
    play->generation++;
    kd_playground_session_call(play);
    pthread_mutex_unlock(&play->all->lock);
}

enum kd_status kd_playground_session_room(struct kd_playground_session *play, uint32_t capacity, bool *quota,
                                          struct kd_error *error)
{
    struct kd_playground_sessions *all = play->all;
    const size_t bytes = BYTES(capacity);
    enum kd_status status = KD_OK;
    *quota = false;
    pthread_mutex_lock(&all->lock);
    if (bytes > play->bytes &&
        kd_bytes_take(all->bytes, play->scheduled.client, bytes - play->bytes, bytes - play->bytes, quota))
        status =
            kd_error_field(error, "/debris_capacity", "debris of this capacity needs %zu MiB, more than is free %s",
                           bytes >> 20, *quota ? "of your share" : "on this server");
    else if (bytes < play->bytes)
        kd_bytes_give(all->bytes, play->scheduled.client, play->bytes - bytes);
    if (!status)
        play->bytes = bytes;
    else
        error->status = status = KD_EBUSY;
    pthread_mutex_unlock(&all->lock);
    return status;
}

struct kd_playground_session_state kd_playground_session_state(struct kd_playground_session *play)
{
    const double now = kd_clock_ms();
    pthread_mutex_lock(&play->all->lock);
    const bool resting = !kd_playground_session_awake(play, now);
    const struct kd_playground_session_state state = { .pace = play->pace,
                                                       .reached = play->reached,
                                                       .slowed =
                                                           play->slowed_ms > 0 && now - play->slowed_ms < SLOWED_MS,
                                                       .resting = resting,
                                                       .stepping = play->stepping,
                                                       .over = !play->listed,
                                                       .watchers = watchers_of(play),
                                                       .generation = play->generation };
    pthread_mutex_unlock(&play->all->lock);
    return state;
}

void kd_playground_session_set_pace(struct kd_playground_session *play, const struct kd_playground_session_pace *pace)
{
    pthread_mutex_lock(&play->all->lock);
    play->pace = *pace;
    play->anew = true;
    play->slowed_ms = 0;
    play->generation++;
    kd_playground_session_call(play);
    pthread_mutex_unlock(&play->all->lock);
}

bool kd_playground_session_step(struct kd_playground_session *play)
{
    pthread_mutex_lock(&play->all->lock);
    const bool may = play->pace.paused && !play->stepping;
    play->stepping |= may;
    pthread_mutex_unlock(&play->all->lock);
    return may;
}

void kd_playground_session_stepped(struct kd_playground_session *play)
{
    pthread_mutex_lock(&play->all->lock);
    play->stepping = false;
    pthread_mutex_unlock(&play->all->lock);
}

void kd_playground_sessions_close(struct kd_playground_sessions *all)
{
    pthread_mutex_lock(&all->lock);
    all->closed = true;
    while (all->first)
        kd_playground_session_unlist(all->first, "stopping");
    pthread_mutex_unlock(&all->lock);
}

unsigned kd_playground_sessions_unfinished(struct kd_playground_sessions *all)
{
    return kd_scheduler_unfinished(all->scheduler);
}

bool kd_playground_sessions_counts(struct kd_playground_sessions *all, struct kd_playground_sessions_counts *out)
{
    if (!kd_clock_lock(&all->lock, COUNTS_MS))
        return false;
    *out = (struct kd_playground_sessions_counts) {
        .open = all->count, .bytes = kd_bytes_held(all->bytes), .steps = all->steps, .events = all->events
    };
    for (const struct kd_playground_session *play = all->first; play; play = play->next)
        out->watchers += watchers_of(play);
    pthread_mutex_unlock(&all->lock);
    return true;
}
