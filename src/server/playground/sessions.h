/* Playground sessions: a playground that the server runs at a given rate, in M a second, and that its owner can change
 * while it runs.
 *
 * It runs while a client watches or sends requests, and pauses KD_PLAY_REST_MS after the last request. After
 * params.idle_ms without any client it ends. Each session is one job of the scheduler (http/task_scheduler.h), with
 * slices of some 10 ms. A sub-step is never divided between slices. It takes tens of milliseconds with 4096 bodies or a
 * million pieces of debris. If the processor cannot keep up, simulated time slows down, and the state reports it.
 *
 * A playground belongs to one thread at a time: the thread that has taken it, which is always a worker. The HTTP thread
 * reads the snapshot that the workers publish after each tick. Any thread; functions on watchers belong to the HTTP
 * thread. */
#ifndef KD_SERVER_PLAYGROUND_SESSIONS_H
#define KD_SERVER_PLAYGROUND_SESSIONS_H

#include "playground/playground.h"
#include "server/http/counts.h"
#include "server/http/once.h"
#include "server/http/task_scheduler.h"

#include <microhttpd.h>
#include <stdatomic.h>

#define KD_PLAY_REST_MS 5000.
#define KD_PLAY_RATE_MAX 1e9  /* largest rate, in M for each second of the clock */
#define KD_PLAY_DEBRIS 20000u /* pieces of debris in an answer, unless the client requests another number */

struct kd_playground_sessions;
struct kd_playground_session;
struct kd_render_queue;
struct kd_scene;
struct kd_session;
struct kd_sessions;

struct kd_playground_sessions_params {
    struct kd_sessions *sessions; /* the sessions that render the pictures of playgrounds */
    struct kd_render_queue *renders;
    unsigned limit, client_limit; /* limits of sessions: of all clients, and of one */
    unsigned idle_ms;
    size_t bytes, client_bytes; /* limits of memory: of all sessions, and of those of one client */
};
enum kd_status kd_playground_sessions_create(const struct kd_playground_sessions_params *params,
                                             struct kd_playground_sessions **out, struct kd_error *error);
/* Call it after kd_playground_sessions_close, when kd_playground_sessions_unfinished is 0 and no references are left.
 * Accepts NULL. */
void kd_playground_sessions_destroy(struct kd_playground_sessions *all);

/* Session state that is not part of the simulation. */
struct kd_playground_session_pace {
    double rate; /* M for each second of the clock, 0 to KD_PLAY_RATE_MAX */
    bool paused;
};

/* Opens a session. It takes over *p and sets it to NULL. The caller gets a reference to the session, and has taken
 * the playground (kd_playground_session_take). Returns KD_EBUSY at a limit of sessions or bytes; *quota is true if
 * that is the limit of one client. */
enum kd_status kd_playground_sessions_open(struct kd_playground_sessions *all, struct kd_playground **p,
                                           const struct kd_playground_session_pace *pace, const struct kd_scene *scene,
                                           const char *client, bool *quota, struct kd_playground_session **out,
                                           struct kd_error *error);
/* Returns a reference to the session of this id, or NULL. The session's idle time starts again. */
struct kd_playground_session *kd_playground_sessions_find(struct kd_playground_sessions *all, const char *id);
void kd_playground_session_release(struct kd_playground_session *play); /* accepts NULL */
/* Idempotency-Key of a session: kd_playground_session_promise stores it, kd_playground_sessions_find_once finds a
 * session by it. "" finds none. */
void kd_playground_session_promise(struct kd_playground_session *play, const struct kd_once *once);
struct kd_playground_session *kd_playground_sessions_find_once(struct kd_playground_sessions *all, const char *key);
/* Reads the key of a session that kd_playground_sessions_find_once has found. HTTP thread only. */
const struct kd_once *kd_playground_session_once(const struct kd_playground_session *play);
const char *kd_playground_session_id(const struct kd_playground_session *play);
const char *kd_playground_session_token(const struct kd_playground_session *play);
bool kd_playground_session_owned(const struct kd_playground_session *play,
                                 const char *token); /* compares in constant time; token may be NULL */
/* Ends the session and notifies its watchers. why: a word that the watchers get as the reason. */
void kd_playground_session_end(struct kd_playground_session *play, const char *why);

/* Takes the playground out of the session. The caller owns the playground until it calls kd_playground_session_give
 * with that playground, or with another one in its place. Returns NULL if another job has taken it. The calling job
 * must then end its slice with KD_SLICE_AWAY, and is woken when the playground is given back. A slice that owns the
 * playground may be suspended (base/pause.h), because no thread blocks to wait for the playground. Call it on
 * workers only. */
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
/* Functions for the job that has taken the playground. kd_playground_session_log copies new events into the
 * session's log. kd_playground_session_moved records that the playground has changed. kd_playground_session_pieces
 * returns the number of sub-steps to compute between two checks of the clock. */
void kd_playground_session_log(struct kd_playground_session *play, const struct kd_playground *p);
void kd_playground_session_moved(struct kd_playground_session *play);
uint32_t kd_playground_session_pieces(const struct kd_playground *p);
/* Reserves the memory for a new debris capacity, in place of the memory for the present capacity. At a limit it
 * returns KD_EBUSY and changes nothing. */
enum kd_status kd_playground_session_room(struct kd_playground_session *play, uint32_t capacity, bool *quota,
                                          struct kd_error *error);

struct kd_playground_session_state {
    struct kd_playground_session_pace pace;
    double reached; /* achieved rate in M a second */
    bool slowed, resting, stepping, over;
    unsigned watchers;
    uint64_t generation;
};
struct kd_playground_session_state kd_playground_session_state(struct kd_playground_session *play);
void kd_playground_session_set_pace(struct kd_playground_session *play, const struct kd_playground_session_pace *pace);
/* Returns an error if a frame of the scene would take too long or cannot be made. */
enum kd_status kd_playground_sessions_takes(struct kd_playground_sessions *all, const struct kd_scene *scene,
                                            struct kd_error *error);
/* Gets the scene of the playground's picture. The picture is rendered by a session of server/session, with the
 * bodies and debris, once a client requests frames. */
void kd_playground_session_scene(struct kd_playground_session *play, struct kd_scene *out);
/* Replaces the scene of the playground's picture. The scene must be resolved and valid. */
enum kd_status kd_playground_session_set_scene(struct kd_playground_session *play, const struct kd_scene *scene,
                                               struct kd_error *error);
/* Returns a reference to the session that renders the picture, and opens one if there is none. Returns KD_EBUSY at a
 * limit; *quota is true if that is the limit of one client. HTTP thread. */
enum kd_status kd_playground_session_picture(struct kd_playground_session *play, bool *quota, struct kd_session **out,
                                             struct kd_error *error);
/* Begins a step that a client has requested. Returns false unless the session is paused and no other step is under
 * way. No other work changes the playground until kd_playground_session_stepped is called. */
bool kd_playground_session_step(struct kd_playground_session *play);
void kd_playground_session_stepped(struct kd_playground_session *play);

/* Tick: state of a playground at a time, as sent to watchers. Immutable and shared by reference count. */
struct kd_playground_session_tick {
    _Atomic unsigned references;
    uint64_t generation;
    double t;
    struct kd_buffer event;          /* JSON on one line */
    struct kd_buffer bodies, debris; /* packed rows of KD_PLAY_BODY_WORDS and KD_PLAY_DEBRIS_WORDS words */
    size_t n_bodies, n_debris, all_debris;
    bool has_debris;
    uint32_t most; /* number of pieces of debris for which `debris` has room */
};
enum { KD_PLAY_HEAD_WORDS = 8, KD_PLAY_BODY_WORDS = 10, KD_PLAY_DEBRIS_WORDS = 4 };
void kd_playground_session_tick_release(struct kd_playground_session_tick *tick); /* accepts NULL */

/* A watcher: a request that waits for one tick, or a stream of all ticks and events. */
struct kd_playground_session_watcher {
    struct kd_playground_session *play; /* a counted reference */
    struct MHD_Connection *mhd;
    int socket;
    bool stream;
    uint64_t least;     /* the watcher waits for a tick of this generation or a later one */
    uint32_t debris;    /* number of pieces of debris that the tick must have room for; 0: none */
    uint64_t event;     /* number of the last event sent */
    double deadline_ms; /* time on kd_clock_ms at which waiting ends */
    bool waiting;       /* the watcher's connection is suspended */
    struct kd_playground_session_watcher *previous, *next;
};
/* Takes over the reference in watcher->play. after: generation of the newest tick that the client has; NULL: the
 * client has none. */
void kd_playground_session_watch(struct kd_playground_session_watcher *watcher, const uint64_t *after);
void kd_playground_session_unwatch(struct kd_playground_session_watcher *watcher);
enum kd_playground_session_news {
    KD_PLAY_TICK, /* there is a tick; *tick is a counted reference to it */
    /* there is an event in *event; if its number is not the next one, the events in between have been discarded */
    KD_PLAY_EVENT,
    KD_PLAY_OVER,  /* the session has ended; *why is a word */
    KD_PLAY_GONE,  /* the client has disconnected */
    KD_PLAY_LATE,  /* the deadline has passed; the caller may set another */
    KD_PLAY_LATER, /* the connection is suspended, and will be resumed for one of the other results */
};
enum kd_playground_session_news kd_playground_session_await(struct kd_playground_session_watcher *watcher,
                                                            struct kd_playground_session_tick **tick,
                                                            struct kd_playground_event *event, const char **why);

/* Handles deadlines, disconnected clients and idle sessions. One thread calls it ten times a second. */
void kd_playground_sessions_sweep(struct kd_playground_sessions *all);
/* Accepts no more sessions and ends all sessions. */
void kd_playground_sessions_close(struct kd_playground_sessions *all);
/* number of sessions that workers still use */
unsigned kd_playground_sessions_unfinished(struct kd_playground_sessions *all);
/* Reads the counts. Returns false if the lock does not become free soon. */
bool kd_playground_sessions_counts(struct kd_playground_sessions *all, struct kd_playground_sessions_counts *out);

#endif
