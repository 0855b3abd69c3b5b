/* Internals of the render queue, shared by its files. */
#ifndef KD_SERVER_RENDER_INTERNAL_H
#define KD_SERVER_RENDER_INTERNAL_H

#include "server/http/allowance.h"
#include "server/render/measures.h"
#include "server/render/pulse.h"
#include "server/render/queue.h"

#include <pthread.h>

#define KD_LONG_FRAME ((size_t)16 << 20) /* an encoder needs some tenths of a second for a frame of more bytes */

struct kd_render_list { struct kd_render_job *first, **end; };

/* Lane: a thread that renders long pictures, one at a time. */
struct kd_lane {
    struct kd_render_queue *queue;
    struct kd_render_job *job; /* the job that the lane renders; NULL: the lane is free */
    uint64_t bytes;            /* device memory that the job needs by its plan; 0: negligible */
    pthread_t thread;
};

struct kd_render_queue {
    struct kd_renderer_params params;
    struct kd_renderer *renderer;
    struct kd_buffer device_json;
    enum kd_status open_status;
    struct kd_error open_error;

    pthread_mutex_t lock;
    pthread_cond_t changed; /* signalled when any member below changes; few threads wait, so one condition is enough */
    bool opened, closing;
    struct kd_shares shares;
    struct kd_allowance allowance;
    struct kd_render_list jobs;   /* jobs that wait for the device or use it, in order of arrival */
    struct kd_render_job *holder; /* job that owns the device; NULL: none */
    struct kd_lane lanes[KD_BACKGROUND_RENDERS];
    unsigned n_lanes;    /* number of lanes whose threads run */
    uint64_t lane_bytes; /* sum of `bytes` over all lanes */

    struct kd_render_list encoding;
    size_t frame_bytes; /* bytes of frames that are rendered and not yet encoded */
    bool encoding_long;
    unsigned limit, client_limit, unfinished;
    bool lost;
    struct kd_error lost_error;
    bool hangs; /* true: a call into the driver hangs, so its thread cannot be joined */
    /* failed: the device has failed, and is reopened once `inside` is 0; reopening: it is being reopened */
    bool failed, reopening;
    struct kd_error failure;       /* the reason why the device failed */
    unsigned inside;               /* number of jobs that are using the renderer */
    unsigned reopenings, reopened; /* reopenings: limit within KD_REOPENINGS_S; reopened: number since the start */
    unsigned spent;                /* number of reopenings since spent_from_ms */
    double spent_from_ms;          /* time at which the present period of reopenings began */
    bool compiles;                 /* the thread that compiles kernels is running */
    struct kd_shares missing;      /* fair queueing of compilations */
    /* compiling: kernels being compiled; compiled: kernels that are compiled but not yet passed to the renderer */
    struct kd_compilation *compiling, *compiled;
    /* ahead: kernels that no job waits for. They are compiled while no other compilation waits. compiling_ahead:
     * kernels of this kind are being compiled now. */
    struct kd_compilation *ahead;
    bool compiling_ahead;
    double ahead_ms;                       /* time of the latest search for such kernels */
    _Atomic bool uncompiled;               /* true: the kernels being compiled are not needed any more */
    double compile_ms;                     /* running mean of the time of a compilation; 0: none yet */
    struct kd_pulse pulse, compiler_pulse; /* watchdogs of the device's owner and of the compiler */
    _Atomic bool cancel;
    struct kd_render_measures measures;
    struct kd_render_job rest; /* job that frees memory after rest_ms without requests */
    /* worked_ms: time at which the last request arrived or work last ended; trimmed_ms: time at which the heap was
     * last trimmed */
    double rest_ms, worked_ms, trimmed_ms;
    bool rested; /* memory has been freed since worked_ms */

    pthread_t render_thread, compiler, encoders[KD_ENCODERS];
    unsigned n_encoders;
    bool render_thread_runs;
};

void kd_render_list_append(struct kd_render_list *list, struct kd_render_job *job);
struct kd_render_job *kd_render_list_take(struct kd_render_list *list, struct kd_render_job **link);

static inline size_t kd_render_frame_bytes(const struct kd_render_job *job)
{
    return job->run ? 0 : (size_t)job->plan.cost.host_bytes;
}

static inline bool kd_render_has_begun(const struct kd_render_job *job) { return job->stage >= KD_RENDER_WORKS; }

/* True if a client waits for the job; such a job may be refused. */
static inline bool kd_render_is_awaited(const struct kd_render_job *job)
{
    return job->claim.class == KD_CLASS_PICTURE || job->claim.class == KD_CLASS_PIXEL ||
           job->claim.class == KD_CLASS_RAYS;
}

bool kd_render_unwanted(struct kd_render_queue *queue, struct kd_render_job *job);
/* Puts a job back in its initial waiting stage. */
void kd_render_stand_in_line(struct kd_render_job *job);

/* Like kd_render_queue_push, for a job that does not render a scene. Called with the lock. */
void kd_render_queue_push_locked(struct kd_render_queue *queue, struct kd_render_job *job);

/* rest.c: frees the renderer's unneeded memory when there is no work. Called with the lock. */
void kd_render_rest_if_idle(struct kd_render_queue *queue);
/* rest.c: trims the heap at most once in rest_ms, while there is work. Called without the lock. */
void kd_render_trim_if_due(struct kd_render_queue *queue);

/* Functions of compile.c, called with the lock. The first two are called only while no other thread owns the device.
 * kd_render_ask_kernels looks for kernels that waiting jobs lack. kd_render_take_kernels passes compiled kernels to
 * the renderer. kd_render_has_kernels: whether a job lacks no kernel. kd_render_tell_kernels records in the job's
 * frame how long it waited for kernels. */
void kd_render_ask_kernels(struct kd_render_queue *queue);
void kd_render_take_kernels(struct kd_render_queue *queue);
bool kd_render_has_kernels(const struct kd_render_queue *queue, const struct kd_render_job *job);
void kd_render_tell_kernels(struct kd_render_job *job);
/* The callback `lacks` of struct kd_renderer_params, whose user is the queue. The owner of the device calls it
 * without the lock. */
bool kd_render_lacks(void *queue, struct kd_compilation *compilation, bool background);
/* Called after a job's turn. Returns whether the job starts again because kernels were missing. If so, the job's
 * result is cleared. */
bool kd_render_begins_with_kernels(struct kd_render_queue *queue, struct kd_render_job *job);
/* called when the job leaves the queue */
void kd_render_forget_kernels(struct kd_render_queue *queue, struct kd_render_job *job);
/* The kernels will be compiled as soon as no job waits for other kernels. They replace earlier kernels of this kind.
 * NULL changes nothing. */
void kd_render_compile_ahead(struct kd_render_queue *queue, struct kd_compilation *compilation);
/* Main function of the compiler thread; the argument is the queue. Returns when the queue is closing. */
void *kd_render_compile_main(void *queue);

/* Functions of reopen.c. All but the first are called with the lock. */
/* Records that the device has failed. Called without the lock. */
void kd_render_failed(struct kd_render_queue *queue, const struct kd_error *error);
/* Called after a job's turn. Returns whether the job starts again because the device failed. If so, the job's result
 * is cleared. */
bool kd_render_once_more(struct kd_render_queue *queue, struct kd_render_job *job);
/* records that the device hangs and cannot be closed */
void kd_render_hung(struct kd_render_queue *queue, const struct kd_error *error);
/* Reopens a failed device if no job is inside the renderer; otherwise does nothing. Releases the lock while it
 * works. */
void kd_render_reopen(struct kd_render_queue *queue);
/* Removes a job from the list of jobs that want the device. Called with the lock. */
void kd_render_take_out(struct kd_render_queue *queue, struct kd_render_job *job);
/* Calls done(), after which the job may be freed. The job's connection must stay open until `unfinished` has been
 * decremented. */
void kd_render_finish(struct kd_render_queue *queue, struct kd_render_job *job);

/* device_scheduler.c: if nobody owns the device, chooses the next owner. Called with the lock. */
void kd_render_next(struct kd_render_queue *queue);
/* The owner of the device releases it until its next turn. Called with the lock. */
void kd_render_give_way(struct kd_render_queue *queue, struct kd_render_job *job);
/* Updates device_json. Called without the lock by the owner of the device. */
enum kd_status kd_render_describe_device(struct kd_render_queue *queue);
/* Main functions of threads. kd_render_short_main runs short work; its argument is the queue. kd_render_lane_main
 * runs a lane; its argument is the lane. They return when the queue is closing and empty. */
void *kd_render_short_main(void *queue);
void *kd_render_lane_main(void *lane);

/* encode.c: main function of an encoder thread; the argument is the queue. Returns when the queue is closing and
 * nothing is unfinished. */
void *kd_render_encode_main(void *queue);
/* Adds a rendered frame to the queue for encoding. Called with the lock. */
void kd_render_encode(struct kd_render_queue *queue, struct kd_render_job *job);

#endif
