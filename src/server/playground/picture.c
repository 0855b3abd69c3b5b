/* Pictures of playground sessions. The first request for a frame opens a session of server/session, which renders
 * the picture. When the bodies have changed and a viewer waits, the new bodies are passed to that session (run.c).
 * Lock order: first all->lock, then the lock of server/session. */
#include "base/clock.h"
#include "playground/show.h"
#include "server/playground/playground_internal.h"
#include "server/render/queue.h"

/* Memory of a picture: up to three sets of bodies exist at once, one that waits, one that is shown, and one that is
 * being made. */
#define DYNAMIC_BYTES \
    (3 * \
     ((size_t)KD_SHOW_NODES * KD_CROWD_NODE * sizeof(float) + KD_PLAYGROUND_BODIES_MAX * sizeof(struct kd_seen_body)))
/* a viewer who has requested a frame is expected to request the next one within this time, in ms */
#define ASKED_MS 1000.

/* All functions from here on are called with the lock held. */

bool kd_playground_session_looked_at(const struct kd_playground_session *play)
{
    return play->picture && kd_session_watched(play->picture);
}

unsigned kd_playground_session_viewers(const struct kd_playground_session *play)
{
    return play->picture ? kd_session_viewers(play->picture) : 0;
}

struct kd_session *kd_playground_session_shown(const struct kd_playground_session *play, double now)
{
    const bool may = play->picture && (now - play->looked_at_ms < ASKED_MS || kd_session_watched(play->picture));
    return may ? kd_session_share(play->picture) : NULL;
}

void kd_playground_session_hide(struct kd_playground_session *play)
{
    struct kd_session *picture = play->picture;
    play->picture = NULL;
    if (!picture)
        return;
    kd_session_end(picture);
    kd_session_release(picture);
    kd_bytes_give(play->all->bytes, play->scheduled.client, play->dynamic_bytes);
    play->dynamic_bytes = 0;
}

static enum kd_status take_bytes(struct kd_playground_session *play, bool *quota, struct kd_error *error)
{
    if (kd_bytes_take(play->all->bytes, play->scheduled.client, DYNAMIC_BYTES, DYNAMIC_BYTES, quota))
        return kd_error_set(error, KD_EBUSY, "a picture of a playground needs %zu MiB, more than is free %s",
                            DYNAMIC_BYTES >> 20, *quota ? "of your share" : "on this server");
    play->dynamic_bytes = DYNAMIC_BYTES;
    return KD_OK;
}

/* All functions from here on take the lock themselves. */

void kd_playground_session_scene(struct kd_playground_session *play, struct kd_scene *out)
{
    pthread_mutex_lock(&play->all->lock);
    *out = play->scene;
    pthread_mutex_unlock(&play->all->lock);
}

static enum kd_status make_plan(struct kd_playground_sessions *all, const struct kd_scene *scene, struct kd_plan *out,
                                struct kd_error *error)
{
    struct kd_capacity capacity;
    kd_render_queue_capacity(all->params.renders, &capacity);
    return kd_plan_make(scene, &capacity, out, error);
}

/* Makes the scene that shows the playground, and checks it against the limits of sessions. */
static enum kd_status make_shown(struct kd_playground_sessions *all, const struct kd_scene *scene, struct kd_plan *out,
                                 struct kd_error *error)
{
    enum kd_status status = make_plan(all, scene, out, error);
    return status ? status : kd_sessions_takes(all->params.sessions, out, error);
}

enum kd_status kd_playground_sessions_takes(struct kd_playground_sessions *all, const struct kd_scene *scene,
                                            struct kd_error *error)
{
    struct kd_plan plan;
    return make_shown(all, scene, &plan, error);
}

enum kd_status kd_playground_session_set_scene(struct kd_playground_session *play, const struct kd_scene *scene,
                                               struct kd_error *error)
{
    struct kd_plan plan;
    enum kd_status status = make_shown(play->all, scene, &plan, error);
    if (status)
        return status;
    pthread_mutex_lock(&play->all->lock);
    if (play->picture && !kd_session_over(play->picture))
        kd_session_put(play->picture, scene, &plan);
    play->scene = *scene;
    pthread_mutex_unlock(&play->all->lock);
    return KD_OK;
}

static enum kd_status open_picture(struct kd_playground_session *play, bool *quota, struct kd_session **out,
                                   struct kd_error *error)
{
    struct kd_plan plan;
    struct kd_scene scene;
    enum kd_status status;
    kd_playground_session_scene(play, &scene);
    KD_TRY(make_plan(play->all, &scene, &plan, error));
    KD_TRY(kd_sessions_open(play->all->params.sessions, &scene, &plan, play->scheduled.client, true, NULL, quota, out,
                            error));
done:
    return status;
}

enum kd_status kd_playground_session_picture(struct kd_playground_session *play, bool *quota, struct kd_session **out,
                                             struct kd_error *error)
{
    struct kd_session *fresh = NULL;
    enum kd_status status = KD_OK;
    *quota = false;
    pthread_mutex_lock(&play->all->lock);
    const bool there = play->picture && !kd_session_over(play->picture);
    /* The lock may be released here, because only the HTTP thread opens pictures. */
    pthread_mutex_unlock(&play->all->lock);
    if (!there)
        status = open_picture(play, quota, &fresh, error);
    if (status)
        return status;
    pthread_mutex_lock(&play->all->lock);
    if (fresh && !play->dynamic_bytes)
        status = take_bytes(play, quota, error);
    if (fresh && !status) {
        const size_t held = play->dynamic_bytes; /* bytes that are now reserved for the new picture */
        if (play->picture)
            kd_session_go_on_from(fresh, play->picture);
        play->dynamic_bytes = 0;
        kd_playground_session_hide(play);
        play->dynamic_bytes = held;
        play->picture = fresh;
        play->unshown = true;
    }
    *out = play->picture ? kd_session_share(play->picture) : NULL;
    play->looked_at_ms = kd_clock_ms();
    kd_playground_session_call(play);
    pthread_mutex_unlock(&play->all->lock);
    if (status) {
        kd_session_end(fresh);
        kd_session_release(fresh);
        return status;
    }
    return *out ? KD_OK : kd_error_set(error, KD_EBUSY, "the playground is ending");
}
