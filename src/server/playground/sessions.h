/* A playground session is a playground that the server runs at a given rate, in M per second, and that its owner can
 * change while it runs. It runs while a client watches or sends requests, and pauses KD_PLAY_REST_MS after the last
 * request. It ends after params.idle_ms without any client. Each session is one job of the scheduler
 * (http/task_scheduler.h), with slices of some 10 ms. A sub-step is never divided between slices; it takes tens of
 * milliseconds with 4096 bodies or a million pieces of debris. If the processor cannot keep up, simulated time slows
 * down, and the state says so.
 *
 * A playground belongs to one thread at a time: the thread that has taken it, which is always a worker. The HTTP
 * thread reads the snapshot that the workers publish after each tick. Any thread; functions on watchers belong to
 * the HTTP thread. */
#ifndef KD_SERVER_PLAYGROUND_SESSIONS_H
#define KD_SERVER_PLAYGROUND_SESSIONS_H

#include "playground/playground.h"
#include "server/http/counts.h"
#include "server/http/once.h"
#include "server/http/task_scheduler.h"

#include <microhttpd.h>
#include <stdatomic.h>

#define KD_PLAY_REST_MS 5000.
#define KD_PLAY_RATE_MAX 1e9  /* maximum rate, in M per second of real time */
#define KD_PLAY_DEBRIS 20000u /* number of pieces of debris in an answer, unless the client requests another number */

struct kd_playground_sessions;
struct kd_playground_session;
struct kd_render_queue;
struct kd_scene;
struct kd_session;
struct kd_sessions;

struct kd_playground_sessions_params {
    struct kd_sessions *sessions; /* the sessions that render the pictures of playgrounds */
    struct kd_render_queue *renders;
    /* maximum number of sessions: limit for all clients together, client_limit for one client */
    unsigned limit, client_limit;
    unsigned idle_ms;
    /* maximum memory of sessions in bytes: bytes for all clients together, client_bytes for one client */
    size_t bytes, client_bytes;
};
enum kd_status kd_playground_sessions_create(const struct kd_playground_sessions_params *params,
                                             struct kd_playground_sessions **out, struct kd_error *error);
/* Call this after kd_playground_sessions_close, when kd_playground_sessions_unfinished returns 0 and there are no
 * references left. Accepts NULL. */
void kd_playground_sessions_destroy(struct kd_playground_sessions *all);

/* Session state that is not part of the simulation. */
struct kd_playground_session_pace {
    double rate; /* in M per second of real time, 0 to KD_PLAY_RATE_MAX */
    bool paused;
};

/* Opens a session. Takes over *p and sets it to NULL. The caller gets a reference to the session, and owns its
 * playground as after kd_playground_session_take. Returns KD_EBUSY at a limit of sessions or bytes; *quota is then
 * true if it is the limit of one client. */
enum kd_status kd_playground_sessions_open(struct kd_playground_sessions *all, struct kd_playground **p,
                                           const struct kd_playground_session_pace *pace, const struct kd_scene *scene,
                                           const char *client, bool *quota, struct kd_playground_session **out,
                                           struct kd_error *error);
/* Returns a reference to the session with this id, or NULL. Restarts the session's idle time. */
struct kd_playground_session *kd_playground_sessions_find(struct kd_playground_sessions *all, const char *id);
void kd_playground_session_release(struct kd_playground_session *play); /* accepts NULL */
/* The Idempotency-Key of a session. kd_playground_session_promise stores the key, and
 * kd_playground_sessions_find_once finds a session by it. The key "" finds no session. */
void kd_playground_session_promise(struct kd_playground_session *play, const struct kd_once *once);
struct kd_playground_session *kd_playground_sessions_find_once(struct kd_playground_sessions *all, const char *key);
/* Gets the key of a session that kd_playground_sessions_find_once has found. HTTP thread only. */
const struct kd_once *kd_playground_session_once(const struct kd_playground_session *play);
const char *kd_playground_session_id(const struct kd_playground_session *play);
const char *kd_playground_session_token(const struct kd_playground_session *play);
bool kd_playground_session_owned(const struct kd_playground_session *play,
                                 const char *token); /* compares in constant time; token may be NULL */
/* Ends the session, and notifies its watchers. why: one word, which the watchers get as the reason. */
void kd_playground_session_end(struct kd_playground_session *play, const char *why);

/* Takes the playground out of the session. The caller owns the playground until it calls kd_playground_session_give
 * with this playground or with one that replaces it. Returns NULL if another job owns it. The calling job must then
 * end its slice with KD_SLICE_AWAY, and is woken when the playground is given back. A slice that owns the playground
 * may be suspended (base/pause.h), because no thread ever blocks to wait for the playground. Call this on workers
 * only. */
struct kd_playground_session_waiter {
    struct kd_scheduler *scheduler;
    struct kd_scheduler_job *job;
    /* private to the session */
    struct kd_playground_session_waiter *next;
    bool listed;
};
struct kd_playground *kd_playground_session_take(struct kd_playground_session *play,
                                                 struct kd_playground_session_waiter *waiter);
void kd_playground_session_give(struct kd_playground_session *play, struct kd_playground *p);
/* Functions for the job that owns the playground. kd_playground_session_log copies new events to the session's log.
 * kd_playground_session_moved records that the playground has changed. kd_playground_session_pieces returns the
 * number of sub-steps to compute between two looks at the clock. */
void kd_playground_session_log(struct kd_playground_session *play, const struct kd_playground *p);
void kd_playground_session_moved(struct kd_playground_session *play);
uint32_t kd_playground_session_pieces(const struct kd_playground *p);
/* Reserves memory for a new debris capacity, which replaces the memory for the present capacity. At a limit, returns
 * KD_EBUSY and changes nothing. */
enum kd_status kd_playground_session_room(struct kd_playground_session *play, uint32_t capacity, bool *quota,
                                          struct kd_error *error);

struct kd_playground_session_state {
    struct kd_playground_session_pace pace;
    double reached; /* achieved rate, in M per second */
    bool slowed, resting, stepping, over;
    unsigned watchers;
    uint64_t generation;
};
struct kd_playground_session_state kd_playground_session_state(struct kd_playground_session *play);
void kd_playground_session_set_pace(struct kd_playground_session *play, const struct kd_playground_session_pace *pace);
/* Returns an error if a frame of the scene would take too long or cannot be made. */
enum kd_status kd_playground_sessions_takes(struct kd_playground_sessions *all, const struct kd_scene *scene,
                                            struct kd_error *error);
/* Gets the scene of the playground's picture. When a client requests frames, a session of server/session renders
 * this scene with the bodies and the debris. */
void kd_playground_session_scene(struct kd_playground_session *play, struct kd_scene *out);
/* Replaces the scene of the playground's picture. The scene must be valid, and its assets must be resolved. */
enum kd_status kd_playground_session_set_scene(struct kd_playground_session *play, const struct kd_scene *scene,
                                               struct kd_error *error);
/* Returns a reference to the session that renders the picture, which is opened if there is none. Returns KD_EBUSY at
 * a limit; *quota is then true if it is the limit of one client. HTTP thread. */
enum kd_status kd_playground_session_picture(struct kd_playground_session *play, bool *quota, struct kd_session **out,
                                             struct kd_error *error);
/* Begins a step that a client has requested. Returns false unless the session is paused and no other step is in
 * progress. Until kd_playground_session_stepped is called, nothing else changes the playground. */
bool kd_playground_session_step(struct kd_playground_session *play);
void kd_playground_session_stepped(struct kd_playground_session *play);

/* A tick is the state of a playground at one time, in the form that watchers get. It is immutable, and shared by
 * reference count. */
struct kd_playground_session_tick {
    _Atomic unsigned references;
    uint64_t generation;
    double t;
    struct kd_buffer event;          /* JSON on one line */
    struct kd_buffer bodies, debris; /* packed rows, of KD_PLAY_BODY_WORDS and KD_PLAY_DEBRIS_WORDS words each */
    size_t n_bodies, n_debris, all_debris;
    bool has_debris;
    uint32_t most; /* number of pieces of debris for which `debris` was made */
};
enum { KD_PLAY_HEAD_WORDS = 8, KD_PLAY_BODY_WORDS = 10, KD_PLAY_DEBRIS_WORDS = 4 };
void kd_playground_session_tick_release(struct kd_playground_session_tick *tick); /* accepts NULL */

/* A watcher: a request that waits for one tick, or a stream of all ticks and events. */
struct kd_playground_session_watcher {
    struct kd_playground_session *play; /* a counted reference */
    struct MHD_Connection *mhd;
    int socket;
    bool stream;
    uint64_t least;     /* lowest generation of the tick for which the watcher waits */
    uint32_t debris;    /* number of pieces of debris for which the tick must have been made; 0: none */
    uint64_t event;     /* number of the event that was sent last */
    double deadline_ms; /* end of the waiting time, on the clock of kd_clock_ms */
    bool waiting;       /* true while the watcher's connection is suspended */
    struct kd_playground_session_watcher *previous, *next;
};
/* Takes over the reference in watcher->play. after: generation of the newest tick that the client has; NULL: the
 * client has none. */
void kd_playground_session_watch(struct kd_playground_session_watcher *watcher, const uint64_t *after);
void kd_playground_session_unwatch(struct kd_playground_session_watcher *watcher);
enum kd_playground_session_news {
    KD_PLAY_TICK, /* there is a tick; *tick is a counted reference to it */
    /* *event is an event; if its number is not the next one, the events in between were discarded */
    KD_PLAY_EVENT,
    KD_PLAY_OVER,  /* the session has ended; *why is the reason, one word */
    KD_PLAY_GONE,  /* the client has disconnected */
    KD_PLAY_LATE,  /* the deadline has passed; the caller may set a new one */
    KD_PLAY_LATER, /* the connection is suspended, and is resumed as soon as one of the other results applies */
};
enum kd_playground_session_news kd_playground_session_await(struct kd_playground_session_watcher *watcher,
                                                            struct kd_playground_session_tick **tick,
                                                            struct kd_playground_event *event, const char **why);

/* Handles deadlines, clients that have disconnected, and idle sessions. Called ten times a second, by one thread. */
void kd_playground_sessions_sweep(struct kd_playground_sessions *all);
/* Ends all sessions, and accepts no more. */
void kd_playground_sessions_close(struct kd_playground_sessions *all);
/* Number of sessions that workers are still using. */
unsigned kd_playground_sessions_unfinished(struct kd_playground_sessions *all);
/* Reads the counts. Returns false if the lock is not free soon. */
bool kd_playground_sessions_counts(struct kd_playground_sessions *all, struct kd_playground_sessions_counts *out);

#endif
