/* Internals of playground sessions, shared by the files of src/server/playground. */
#ifndef KD_SERVER_PLAYGROUND_INTERNAL_H
#define KD_SERVER_PLAYGROUND_INTERNAL_H

#include "server/http/bytes.h"
#include "server/http/secret.h"
#include "server/playground/plays.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_play {
    struct kd_turns_job turns; /* first; from its opening to its end */
    struct kd_plays *all;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    /* with all->lock */
    struct kd_play *next;
    unsigned references;
    size_t bytes, crowd_bytes; /* crowd_bytes: of what its picture shows, while there is one */
    struct kd_once once;       /* what it was asked for by */
    bool listed, stepping;
    const char *why; /* it has ended */
    struct kd_play_pace pace;
    bool anew;                 /* its clock begins anew */
    double used_ms;            /* when it was asked for or watched last */
    double reached, slowed_ms; /* slowed_ms: when time was let go last */
    uint64_t generation;
    struct kd_play_tick *tick; /* the newest; NULL: none yet */
    uint32_t debris;
    double debris_ms; /* the most pieces that anybody wants, and when that was said last */
    struct kd_playground_events log;
    uint64_t log_begin; /* what a snapshot has told elsewhere */
    struct kd_play_watcher *watchers;
    struct kd_scene scene;          /* of its picture */
    struct kd_session *picture;     /* that shows it, a reference; NULL: nobody has asked for one */
    bool unshown;                   /* that has been given nothing yet */
    double looked_at_ms;            /* when somebody asked for a frame last */
    bool held;                      /* the playground belongs to somebody */
    struct kd_play_waiter *waiters; /* for it */
    /* whoever holds the playground (kd_play_take) */
    struct kd_play_waiter waiter; /* of the play's own job */
    struct kd_playground *p;
    double looked_ms, goal, allowance; /* the clock of its turns (run.c); looked_ms 0: it stands */
    double ticked_ms, measured_ms, measured_t, shown_ms;
    uint64_t shown; /* the generation that the picture has; 0: none */
};

struct kd_plays {
    struct kd_plays_params params;
    struct kd_turns *turns;
    struct kd_bytes *bytes;
    pthread_mutex_t lock;
    struct kd_play *first;
    unsigned count;
    uint64_t steps, events;
    bool closed;
    double looked_ms;
};

/* Callers hold all->lock. */
struct kd_play *kd_play_let_go(struct kd_play *play); /* of a reference. Returns it if that was the last one */
void kd_play_unlist(struct kd_play *play, const char *why);
bool kd_play_awake(const struct kd_play *play, double now); /* somebody watches, or has asked of late */
void kd_play_call(struct kd_play *play);                    /* its job has something to do */
void kd_play_wake(struct kd_play *play, double now);        /* those for whom there is something. watch.c */
bool kd_play_awaited(const struct kd_play *play);           /* whether anybody waits for a tick. watch.c */

bool kd_play_looked_at(const struct kd_play *play); /* somebody waits for frames. picture.c */
struct kd_session *kd_play_shown(
    const struct kd_play *play,
    double now);                         /* the picture, if somebody may look at it: a reference, or NULL. picture.c */
void kd_play_hide(struct kd_play *play); /* ends the picture. picture.c */
unsigned kd_play_viewers(const struct kd_play *play); /* who look at it. picture.c */

/* Frees one that nobody refers to, which may take some milliseconds: without the lock. Accepts NULL. */
void kd_play_destroy(struct kd_play *play);

/* The play's job; run.c. */
enum kd_turn_end kd_play_turn(struct kd_turns_job *job);

/* A new tick of the playground. NULL: out of memory. tick.c */
struct kd_play_tick *kd_play_tick_make(struct kd_playground *p, const struct kd_play_state *state, uint32_t debris);

#endif
