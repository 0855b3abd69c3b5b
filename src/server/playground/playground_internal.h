/* Internals of playground sessions, shared by the files of src/server/playground. */
#ifndef KD_SERVER_PLAYGROUND_INTERNAL_H
#define KD_SERVER_PLAYGROUND_INTERNAL_H

#include "server/http/bytes.h"
#include "server/http/secret.h"
#include "server/playground/sessions.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_playground_session {
    struct kd_scheduler_job scheduled; /* must be the first member; the session's job in the scheduler */
    struct kd_playground_sessions *all;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    /* all->lock protects the members from here on */
    struct kd_playground_session *next;
    unsigned references;
    /* bytes: memory reserved; dynamic_bytes: the part for the bodies of the picture, reserved while there is a
     * picture */
    size_t bytes, dynamic_bytes;
    struct kd_once once; /* hashes of the request that created it */
    bool listed, stepping;
    const char *why; /* the reason why the session has ended; NULL: it has not ended */
    struct kd_playground_session_pace pace;
    bool anew;                 /* the clock of the session's slices must be restarted */
    double used_ms;            /* time of the last request, or the last time at which a client watched the session */
    double reached, slowed_ms; /* reached: achieved rate; slowed_ms: time at which simulated time was last skipped */
    uint64_t generation;
    struct kd_playground_session_tick *tick; /* the newest tick; NULL: none yet */
    uint32_t debris;
    /* debris: largest number of pieces of debris that clients have requested lately; debris_ms: time of that request */
    double debris_ms;
    struct kd_playground_events log;
    uint64_t log_begin; /* number of the last event that is included in a snapshot */
    struct kd_playground_session_watcher *watchers;
    struct kd_scene scene; /* scene of the playground's picture */
    /* session that renders the picture, a counted reference; NULL: no client has requested a picture */
    struct kd_session *picture;
    bool unshown;                                 /* true: the picture has no bodies yet */
    double looked_at_ms;                          /* time at which a frame was last requested */
    bool held;                                    /* a thread has taken ownership of the playground */
    struct kd_playground_session_waiter *waiters; /* jobs that wait until they can take the playground */
    /* only the job that has taken the playground (kd_playground_session_take) uses the members from here on */
    struct kd_playground_session_waiter waiter; /* entry of the session's own job in the list of waiters */
    struct kd_playground *p;
    double looked_ms, goal, allowance; /* clock of the session's slices (run.c); looked_ms 0: the clock does not run */
    double ticked_ms, measured_ms, measured_t, shown_ms;
    uint64_t shown; /* generation of the bodies that the picture shows; 0: none */
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

/* Callers of the functions below hold all->lock. */
struct kd_playground_session *kd_playground_session_unref(
    struct kd_playground_session *play); /* drops a reference; returns the session if that reference was the last,
                                          * else NULL */
void kd_playground_session_unlist(struct kd_playground_session *play, const char *why);
/* true if there is a watcher or a viewer, or the last request came less than KD_PLAY_REST_MS ago */
bool kd_playground_session_awake(const struct kd_playground_session *play, double now);
void kd_playground_session_call(struct kd_playground_session *play); /* wakes the session's job */
void kd_playground_session_wake(struct kd_playground_session *play,
                                double now); /* resumes watchers that have news; in watch.c */
/* true if a watcher waits for a tick; in watch.c */
bool kd_playground_session_awaited(const struct kd_playground_session *play);

bool kd_playground_session_looked_at(
    const struct kd_playground_session *play); /* true if a viewer waits for frames; in picture.c */
/* If the picture has viewers, returns it as a counted reference; otherwise returns NULL. In picture.c. */
struct kd_session *kd_playground_session_shown(const struct kd_playground_session *play, double now);
void kd_playground_session_hide(struct kd_playground_session *play); /* ends the picture; in picture.c */
unsigned kd_playground_session_viewers(
    const struct kd_playground_session *play); /* number of viewers of the picture; in picture.c */

/* Frees a session to which no reference is left; that may take some milliseconds. Called without the lock. Accepts
 * NULL. */
void kd_playground_session_destroy(struct kd_playground_session *play);

/* Runs a slice of the session's job. In run.c. */
enum kd_slice_result kd_playground_session_turn(struct kd_scheduler_job *job);

/* Makes a tick of the playground with at most `debris` pieces of debris. NULL: out of memory. In tick.c. */
struct kd_playground_session_tick *kd_playground_session_tick_make(struct kd_playground *p,
                                                                   const struct kd_playground_session_state *state,
                                                                   uint32_t debris);

#endif
