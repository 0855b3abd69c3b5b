/* Internals of playground sessions, shared by the files of src/server/playground. */
#ifndef KD_SERVER_PLAYGROUND_INTERNAL_H
#define KD_SERVER_PLAYGROUND_INTERNAL_H

#include "server/http/bytes.h"
#include "server/http/secret.h"
#include "server/playground/sessions.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_playground_session {
    struct kd_scheduler_job scheduled; /* the session's job in the scheduler; must be the first member */
    struct kd_playground_sessions *all;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    /* From here on, all->lock protects the members. */
    struct kd_playground_session *next;
    unsigned references;
    /* bytes: memory that the session has reserved; dynamic_bytes: the part of `bytes` for the bodies of the picture,
     * reserved while there is a picture */
    size_t bytes, dynamic_bytes;
    struct kd_once once; /* hashes of the request that created the session */
    bool listed, stepping;
    const char *why; /* the reason why the session has ended; NULL while it exists */
    struct kd_playground_session_pace pace;
    bool anew;                 /* true if the clock of the session's slices must be restarted */
    double used_ms;            /* time of the last request, or the last time when a client watched the session */
    double reached, slowed_ms; /* reached: achieved rate; slowed_ms: time when simulated time was last skipped */
    uint64_t generation;
    struct kd_playground_session_tick *tick; /* the newest tick; NULL if there is none yet */
    uint32_t debris;
    /* debris: maximum number of pieces of debris that clients have requested recently; debris_ms: time of that
     * request */
    double debris_ms;
    struct kd_playground_events log;
    uint64_t log_begin; /* number of the last event that is part of a snapshot */
    struct kd_playground_session_watcher *watchers;
    struct kd_scene scene; /* scene of the playground's picture */
    /* the session that renders the picture, a counted reference; NULL if no client has requested a picture */
    struct kd_session *picture;
    bool unshown;                                 /* true if the picture has not been given bodies yet */
    double looked_at_ms;                          /* time when a frame was last requested */
    bool held;                                    /* true while a thread has taken the playground */
    struct kd_playground_session_waiter *waiters; /* list of jobs that wait for the playground */
    /* From here on, the members are used only by the job that owns the playground (kd_playground_session_take). */
    struct kd_playground_session_waiter waiter; /* entry of the session's own job in the list `waiters` */
    struct kd_playground *p;
    /* clock of the session's slices (run.c); looked_ms is 0 while the clock does not run */
    double looked_ms, goal, allowance;
    double ticked_ms, measured_ms, measured_t, shown_ms;
    uint64_t shown; /* generation of the bodies in the picture; 0: there are none */
};

struct kd_playground_sessions {
    struct kd_playground_sessions_params params;
    struct kd_scheduler *scheduler;
    struct kd_bytes *bytes;
    pthread_mutex_t lock;
    struct kd_playground_session *first;
    unsigned count;
    uint64_t steps, events;
    bool closed;
    double looked_ms;
};

/* The functions below must be called with all->lock held. */
struct kd_playground_session *kd_playground_session_unref(
    /* drops a reference; returns the session if this was the last reference, otherwise NULL */
    struct kd_playground_session *play);
void kd_playground_session_unlist(struct kd_playground_session *play, const char *why);
/* True if there is a watcher or a viewer, or if the last request came less than KD_PLAY_REST_MS ago. */
bool kd_playground_session_awake(const struct kd_playground_session *play, double now);
void kd_playground_session_call(struct kd_playground_session *play); /* wakes the job of the session */
void kd_playground_session_wake(struct kd_playground_session *play,
                                double now); /* watch.c: resumes the watchers that have news */
/* watch.c: true if a watcher waits for a tick */
bool kd_playground_session_awaited(const struct kd_playground_session *play);

bool kd_playground_session_looked_at(
    const struct kd_playground_session *play); /* picture.c: true if a viewer waits for frames */
/* picture.c: if the picture has viewers, returns it as a counted reference; otherwise NULL */
struct kd_session *kd_playground_session_shown(const struct kd_playground_session *play, double now);
void kd_playground_session_hide(struct kd_playground_session *play); /* picture.c: ends the picture */
unsigned kd_playground_session_viewers(
    const struct kd_playground_session *play); /* picture.c: number of viewers of the picture */

/* Frees a session that has no references left. This may take some milliseconds. Called without the lock. Accepts
 * NULL. */
void kd_playground_session_destroy(struct kd_playground_session *play);

/* run.c: runs a slice of the session's job. */
enum kd_slice_result kd_playground_session_turn(struct kd_scheduler_job *job);

/* tick.c: makes a tick of the playground with at most `debris` pieces of debris. Returns NULL when out of memory. */
struct kd_playground_session_tick *kd_playground_session_tick_make(struct kd_playground *p,
                                                                   const struct kd_playground_session_state *state,
                                                                   uint32_t debris);

#endif
