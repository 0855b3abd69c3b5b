/* Internals of the render queue, shared by its files. */
#ifndef KD_SERVER_RENDER_INTERNAL_H
#define KD_SERVER_RENDER_INTERNAL_H

#include "server/http/allowance.h"
#include "server/render/measures.h"
#include "server/render/pulse.h"
#include "server/render/queue.h"

#include <pthread.h>

#define KD_LONG_FRAME ((size_t)16 << 20) /* bytes: takes an encoder some tenths of a second */

struct kd_render_list { struct kd_render_job *first, **end; };

/* A thread that renders one long picture at a time. */
struct kd_lane {
    struct kd_render_queue *queue;
    struct kd_render_job *job; /* NULL: it is free */
    uint64_t bytes; /* of the device's memory that count as the job's, by its plan; 0: they are not worth counting */
    pthread_t thread;
};

struct kd_render_queue {
    struct kd_renderer_params params;
    struct kd_renderer *renderer;
    struct kd_buffer device_json;
    enum kd_status open_status;
    struct kd_error open_error;

    pthread_mutex_t lock;
    pthread_cond_t changed; /* anything below; few threads wait, so one condition serves all */
    bool opened, closing;
    struct kd_shares shares;
    struct kd_allowance allowance;
    struct kd_render_list jobs;   /* all that want the device, in the order in which they came */
    struct kd_render_job *holder; /* who has the device; NULL: nobody */
    struct kd_lane lanes[KD_ASIDES];
    unsigned n_lanes;    /* whose threads run */
    uint64_t lane_bytes; /* of all of them */

    struct kd_render_list encoding;
    size_t frame_bytes; /* rendered, and not yet encoded */
    bool encoding_long;
    unsigned limit, client_limit, unfinished;
    bool lost;
    struct kd_error lost_error;
    bool hangs;              /* a thread may never come back from it */
    bool failed, reopening;  /* the device has failed, and is to be opened again when nobody is inside; somebody does */
    struct kd_error failure; /* why */
    unsigned inside;         /* jobs that are */
    unsigned reopenings, reopened;               /* most of them within KD_REOPENINGS_S; so far, ... */
    unsigned spent;                              /* ... and those that count against it, of ... */
    double spent_from_ms;                        /* ... the KD_REOPENINGS_S that began then */
    bool compiles;                               /* the thread below runs */
    struct kd_shares missing;                    /* who is next to have kernels compiled */
    struct kd_compilation *compiling, *compiled; /* by it now; and one that is not yet the renderer's */
    _Atomic bool uncompiled;                     /* nobody wants what is being compiled */
    double compile_ms;                           /* that one takes, learned; 0: none has been compiled yet */
    struct kd_pulse pulse, compiler_pulse;       /* of whoever has the device; of who compiles */
    _Atomic bool cancel;
    struct kd_render_measures measures;
    struct kd_render_job rest; /* gives back what is not needed, once nothing has been asked for for rest_ms */
    double rest_ms, worked_ms, trimmed_ms; /* worked_ms: when something was asked for, or done, last; trimmed_ms: when
                                              the heap gave back what was free */
    bool rested;                           /* since then */

    pthread_t render_thread, compiler, encoders[KD_ENCODERS];
    unsigned n_encoders;
    bool render_thread_runs;
};

void kd_render_list_append(struct kd_render_list *list, struct kd_render_job *job);
struct kd_render_job *kd_render_list_take(struct kd_render_list *list, struct kd_render_job **link);

static inline size_t kd_render_frame_bytes(const struct kd_render_job *job)
{
    return job->run ? 0 : (size_t)job->plan.host_bytes;
}

static inline bool kd_render_has_begun(const struct kd_render_job *job) { return job->stage >= KD_RENDER_WORKS; }

/* Whether a client waits for it who may have to be told that it is too much. */
static inline bool kd_render_is_awaited(const struct kd_render_job *job)
{
    return job->claim.class == KD_CLASS_PICTURE || job->claim.class == KD_CLASS_PIXEL ||
           job->claim.class == KD_CLASS_RAYS;
}

bool kd_render_unwanted(struct kd_render_queue *queue, struct kd_render_job *job);
/* As for a job that has not begun: how it waits. */
void kd_render_stand_in_line(struct kd_render_job *job);

/* As kd_render_queue_push, locked, of a job that renders no scene. */
void kd_render_queue_push_locked(struct kd_render_queue *queue, struct kd_render_job *job);

/* rest.c: has the renderer give back what it does not need, once there is nothing to do. Locked. */
void kd_render_rest_if_idle(struct kd_render_queue *queue);
/* rest.c, unlocked: has the heap give back what is free, once in rest_ms while there is work. */
void kd_render_trim_if_due(struct kd_render_queue *queue);

/* compile.c, locked. The first two: nobody else has the device. Looks which jobs lack kernels, and hands over what has
 * been compiled. Whether a job has what it needs. Says in its frame what it waited. */
void kd_render_ask_kernels(struct kd_render_queue *queue);
void kd_render_take_kernels(struct kd_render_queue *queue);
bool kd_render_has_kernels(const struct kd_render_queue *queue, const struct kd_render_job *job);
void kd_render_tell_kernels(struct kd_render_job *job);
/* Unlocked, by who has the device: struct kd_renderer_params.lacks, of the queue. */
bool kd_render_lacks(void *queue, struct kd_compilation *compilation, bool aside);
/* After its turn: whether the job begins once more because of that. If so its outcome is taken back. */
bool kd_render_begins_with_kernels(struct kd_render_queue *queue, struct kd_render_job *job);
void kd_render_forget_kernels(struct kd_render_queue *queue, struct kd_render_job *job); /* it goes */
/* A thread, with the queue as argument, that ends when that is closing. */
void *kd_render_compile_main(void *queue);

/* reopen.c, locked, but for the first. */
void kd_render_failed(struct kd_render_queue *queue, const struct kd_error *error); /* the device has. Unlocked */
/* After its turn: whether the job begins once more. If so its outcome is taken back. */
bool kd_render_once_more(struct kd_render_queue *queue, struct kd_render_job *job);
void kd_render_hung(struct kd_render_queue *queue, const struct kd_error *error); /* a device that cannot be closed */
/* Opens a device that has failed again, once nobody is inside; else, or if it has not, does nothing. Unlocks
 * meanwhile. */
void kd_render_reopen(struct kd_render_queue *queue);
/* It wants the device no more. Locked. */
void kd_render_take_out(struct kd_render_queue *queue, struct kd_render_job *job);
/* Calls its done(). The job may be gone when that returns; until `unfinished` falls, its connection counts as ours. */
void kd_render_finish(struct kd_render_queue *queue, struct kd_render_job *job);

/* turns.c: if nobody has the device, whoever is next is given it. Locked. */
void kd_render_next(struct kd_render_queue *queue);
/* Who has the device lets others have it until its turn comes again. Locked. */
void kd_render_give_way(struct kd_render_queue *queue, struct kd_render_job *job);
/* Unlocked, by who has the device. */
enum kd_status kd_render_describe_device(struct kd_render_queue *queue);
/* Threads: of short works, with the queue as argument; of long ones, with a lane. They end when the queue is closing
 * and empty. */
void *kd_render_short_main(void *queue);
void *kd_render_lane_main(void *lane);

/* encode.c: a thread, with the queue as argument, that ends when it is closing and nothing is unfinished. */
void *kd_render_encode_main(void *queue);
/* Hand a frame over. Locked. */
void kd_render_encode(struct kd_render_queue *queue, struct kd_render_job *job);

#endif
