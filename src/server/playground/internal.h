/* Internals of playground sessions, shared by the files of src/server/playground. */
#ifndef KD_SERVER_PLAYGROUND_INTERNAL_H
#define KD_SERVER_PLAYGROUND_INTERNAL_H

#include "server/http/bytes.h"
#include "server/http/secret.h"
#include "server/playground/plays.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_playground_session {
    struct kd_scheduler_job turns; /* first member; the session's job, from its opening to its end */
    struct kd_playground_sessions *all;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    /* protected by all->lock */
    struct kd_playground_session *next;
    unsigned references;
    size_t bytes, crowd_bytes; /* bytes reserved; crowd_bytes: for the picture's bodies, while there is a picture */
    struct kd_once once;       /* hashes of the request that created it */
    bool listed, stepping;
    const char *why; /* why it has ended; NULL: it has not */
    struct kd_playground_session_pace pace;
    bool anew;                 /* its clock must be restarted */
    double used_ms;            /* last request, or last time that it was watched */
    double reached, slowed_ms; /* reached: rate achieved; slowed_ms: when simulated time was last skipped */
    uint64_t generation;
    struct kd_playground_session_tick *tick; /* the newest; NULL: none yet */
    uint32_t debris;
    double debris_ms; /* largest number of debris pieces requested, and when */
    struct kd_playground_events log;
    uint64_t log_begin; /* number of the last event that a snapshot has included */
    struct kd_playground_session_watcher *watchers;
    struct kd_scene scene;                        /* of its picture */
    struct kd_session *picture;                   /* session that renders it, a reference; NULL: not requested */
    bool unshown;                                 /* the picture has no bodies yet */
    double looked_at_ms;                          /* last request for a frame */
    bool held;                                    /* the playground is taken */
    struct kd_playground_session_waiter *waiters; /* jobs waiting to take the playground */
    /* protected by taking the playground (kd_playground_session_take) */
    struct kd_playground_session_waiter waiter; /* of the session's own job */
    struct kd_playground *p;
    double looked_ms, goal, allowance; /* clock of its slices (run.c); looked_ms 0: it is paused */
    double ticked_ms, measured_ms, measured_t, shown_ms;
    uint64_t shown; /* generation in the picture; 0: none */
};

struct kd_playground_sessions {
    struct kd_playground_sessions_params params;
    struct kd_scheduler *turns;
    struct kd_bytes *bytes;
    pthread_mutex_t lock;
    struct kd_playground_session *first;
    unsigned count;
    uint64_t steps, events;
    bool closed;
    double looked_ms;
};

/* Callers hold all->lock. */
struct kd_playground_session *kd_playground_session_unref(
    struct kd_playground_session *play); /* drops a reference; returns the session if it was the last */
void kd_playground_session_unlist(struct kd_playground_session *play, const char *why);
bool kd_playground_session_awake(const struct kd_playground_session *play,
                                 double now);                        /* a client watches or has sent a request lately */
void kd_playground_session_call(struct kd_playground_session *play); /* wakes its job */
void kd_playground_session_wake(struct kd_playground_session *play,
                                double now); /* resumes watchers that have news. watch.c */
bool kd_playground_session_awaited(const struct kd_playground_session *play); /* a watcher waits for a tick. watch.c */

bool kd_playground_session_looked_at(
    const struct kd_playground_session *play); /* a viewer waits for frames. picture.c */
/* The picture if it has viewers: a reference, or NULL. picture.c */
struct kd_session *kd_playground_session_shown(const struct kd_playground_session *play, double now);
void kd_playground_session_hide(struct kd_playground_session *play); /* ends the picture. picture.c */
unsigned kd_playground_session_viewers(
    const struct kd_playground_session *play); /* number of viewers of the picture. picture.c */

/* Frees a session without references, which may take some milliseconds. Called without the lock. Accepts NULL. */
void kd_playground_session_destroy(struct kd_playground_session *play);

/* Runs a slice of the session's job. run.c */
enum kd_slice_result kd_playground_session_turn(struct kd_scheduler_job *job);

/* Makes a tick of the playground with at most `debris` pieces. NULL: out of memory. tick.c */
struct kd_playground_session_tick *kd_playground_session_tick_make(struct kd_playground *p,
                                                                   const struct kd_playground_session_state *state,
                                                                   uint32_t debris);

#endif
