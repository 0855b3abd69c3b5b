/* Playground sessions: a playground on the server that runs at a given rate, in M a second, and that its owner changes
 * meanwhile.
 *
 * It runs while a client watches or asks, and pauses KD_PLAY_REST_MS after the last one. After params.idle_ms without
 * any client it ends. Each is one task of the scheduler (http/turns.h), with slices of some 10 ms; a sub-step is never
 * divided, and takes tens of milliseconds with 4096 bodies or a million pieces of debris. If the processor cannot keep
 * up, simulated time slows down, which is reported.
 *
 * A playground belongs to one thread at a time: the one that has taken it, which is always a worker. The HTTP thread
 * reads the snapshot that the workers publish after each tick. Any thread; functions on watchers belong to the HTTP
 * thread. */
#ifndef KD_SERVER_PLAYGROUND_PLAYS_H
#define KD_SERVER_PLAYGROUND_PLAYS_H

#include "playground/playground.h"
#include "server/http/counts.h"
#include "server/http/once.h"
#include "server/http/turns.h"

#include <microhttpd.h>
#include <stdatomic.h>

#define KD_PLAY_REST_MS 5000.
#define KD_PLAY_RATE_MAX 1e9  /* M a second */
#define KD_PLAY_DEBRIS 20000u /* pieces that are sent where nothing is said */

struct kd_plays;
struct kd_play;
struct kd_render_queue;
struct kd_scene;
struct kd_session;
struct kd_sessions;

struct kd_plays_params {
    struct kd_sessions *sessions; /* in which their pictures are */
    struct kd_render_queue *renders;
    unsigned limit, client_limit; /* at once; of one client */
    unsigned idle_ms;
    size_t bytes, client_bytes; /* of memory, of all; of one client */
};
enum kd_status kd_plays_create(const struct kd_plays_params *params, struct kd_plays **out, struct kd_error *error);
/* After kd_plays_close, when kd_plays_unfinished is 0 and nobody has a reference. Accepts NULL. */
void kd_plays_destroy(struct kd_plays *all);

/* How a play goes on besides its playground. */
struct kd_play_pace {
    double rate; /* M a second, 0 to KD_PLAY_RATE_MAX */
    bool paused;
};

/* Opens a play, which owns *p from then on and sets it to NULL. The caller holds a reference, and has taken the
 * playground. KD_EBUSY: there are as many as may be, or as many bytes; *quota: of this client. */
enum kd_status kd_plays_open(struct kd_plays *all, struct kd_playground **p, const struct kd_play_pace *pace,
                             const struct kd_scene *scene, const char *client, bool *quota, struct kd_play **out,
                             struct kd_error *error);
/* The play of this id: a reference, or NULL. It counts as asked for. */
struct kd_play *kd_plays_find(struct kd_plays *all, const char *id);
void kd_play_release(struct kd_play *play); /* accepts NULL */
/* By what it was asked for; "" finds none. */
void kd_play_promise(struct kd_play *play, const struct kd_once *once);
struct kd_play *kd_plays_find_once(struct kd_plays *all, const char *key);
const struct kd_once *kd_play_once(const struct kd_play *play); /* HTTP thread only, of one that was found so */
const char *kd_play_id(const struct kd_play *play);
const char *kd_play_token(const struct kd_play *play);
bool kd_play_owned(const struct kd_play *play, const char *token); /* in constant time; token may be NULL */
/* Ends the play, and tells all who watch why: a word. */
void kd_play_end(struct kd_play *play, const char *why);

/* Takes the playground, which is the caller's until it is given back, itself or another one in its place. NULL:
 * somebody has it; the waiter's job is woken when it is given back, and is to end its turn with KD_TURN_AWAY. A turn
 * that holds it may pause (base/pause.h): nobody blocks for it. Workers. */
struct kd_play_waiter {
    struct kd_turns *turns;
    struct kd_turns_job *job;
    /* the play's own */
    struct kd_play_waiter *next;
    bool listed;
};
struct kd_playground *kd_play_take(struct kd_play *play, struct kd_play_waiter *waiter);
void kd_play_give(struct kd_play *play, struct kd_playground *p);
/* In between: what has happened in it is told; it has changed, or gone on; how many sub-steps it may be moved on
 * between two looks at the clock. */
void kd_play_log(struct kd_play *play, const struct kd_playground *p);
void kd_play_moved(struct kd_play *play);
uint32_t kd_play_pieces(const struct kd_playground *p);
/* Counts the bytes that a capacity of debris takes instead of the present one. KD_EBUSY, and nothing has changed,
 * where they are too many. */
enum kd_status kd_play_room(struct kd_play *play, uint32_t capacity, bool *quota, struct kd_error *error);

struct kd_play_state {
    struct kd_play_pace pace;
    double reached; /* M a second, of late */
    bool slowed, resting, stepping, over;
    unsigned watchers;
    uint64_t generation;
};
struct kd_play_state kd_play_state(struct kd_play *play);
void kd_play_set_pace(struct kd_play *play, const struct kd_play_pace *pace);
/* Fails where a frame of the scene would take too long, or cannot be made. */
enum kd_status kd_plays_takes(struct kd_plays *all, const struct kd_scene *scene, struct kd_error *error);
/* The scene of its picture, which a session shows (server/session) as soon as somebody asks for frames, together
 * with the bodies and the debris as they are. */
void kd_play_scene(struct kd_play *play, struct kd_scene *out);
/* Resolved and valid. */
enum kd_status kd_play_set_scene(struct kd_play *play, const struct kd_scene *scene, struct kd_error *error);
/* The session: a reference. KD_EBUSY: there are as many as may be; *quota: of this client. The HTTP thread. */
enum kd_status kd_play_picture(struct kd_play *play, bool *quota, struct kd_session **out, struct kd_error *error);
/* Whether the play may be stepped by hand from now on, which it may while it is paused and nobody else does: then
 * nothing else changes it until kd_play_stepped. */
bool kd_play_step(struct kd_play *play);
void kd_play_stepped(struct kd_play *play);

/* A tick is how a play stood at a time. Shared and constant once made; the last reference frees it. */
struct kd_play_tick {
    _Atomic unsigned references;
    uint64_t generation;
    double t;
    struct kd_buffer event;          /* JSON in one line */
    struct kd_buffer bodies, debris; /* rows: KD_PLAY_BODY_WORDS and KD_PLAY_DEBRIS_WORDS words each */
    size_t n_bodies, n_debris, all_debris;
    bool has_debris;
    uint32_t most; /* that there may be in `debris` */
};
enum { KD_PLAY_HEAD_WORDS = 8, KD_PLAY_BODY_WORDS = 10, KD_PLAY_DEBRIS_WORDS = 4 };
void kd_play_tick_release(struct kd_play_tick *tick); /* accepts NULL */

/* Who watches is a request that waits for one tick, or a stream that takes each and all events. */
struct kd_play_watcher {
    struct kd_play *play; /* a reference */
    struct MHD_Connection *mhd;
    int socket;
    bool stream;
    uint64_t least;     /* the generation that a tick must have at least */
    uint32_t debris;    /* pieces that it must have room for; 0: none */
    uint64_t event;     /* number of the last event that was taken */
    double deadline_ms; /* on kd_clock_ms, of waiting */
    bool waiting;       /* suspended */
    struct kd_play_watcher *previous, *next;
};
/* Takes over the reference in watcher->play. after: the generation that it has; NULL: none. */
void kd_play_watch(struct kd_play_watcher *watcher, const uint64_t *after);
void kd_play_unwatch(struct kd_play_watcher *watcher);
enum kd_play_news {
    KD_PLAY_TICK,  /* *tick, a reference */
    KD_PLAY_EVENT, /* *event; or, where event->number is not the next one, those in between are no longer kept */
    KD_PLAY_OVER,  /* *why, a word */
    KD_PLAY_GONE,  /* the client has hung up */
    KD_PLAY_LATE,  /* the deadline has passed, which the caller may set anew */
    KD_PLAY_LATER, /* the connection has been suspended, and is resumed for one of these */
};
enum kd_play_news kd_play_await(struct kd_play_watcher *watcher, struct kd_play_tick **tick,
                                struct kd_playground_event *event, const char **why);

/* Looks after deadlines, clients that have gone and plays that nobody watches. One thread calls it, ten times a
 * second. */
void kd_plays_sweep(struct kd_plays *all);
/* Takes no more plays, and ends all. */
void kd_plays_close(struct kd_plays *all);
unsigned kd_plays_unfinished(struct kd_plays *all); /* that workers have not let go of */
/* False, with nothing known, where that takes more than a moment. */
bool kd_plays_counts(struct kd_plays *all, struct kd_plays_counts *out);

#endif
