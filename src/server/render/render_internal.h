/* Internals of the render queue, shared by its files. */
#ifndef KD_SERVER_RENDER_INTERNAL_H
#define KD_SERVER_RENDER_INTERNAL_H

#include "server/http/allowance.h"
#include "server/render/measures.h"
#include "server/render/pulse.h"
#include "server/render/queue.h"

#include <pthread.h>

#define KD_LONG_FRAME ((size_t)16 << 20) /* a frame with more bytes takes an encoder some tenths of a second */

struct kd_render_list { struct kd_render_job *first, **end; };

/* A lane is a thread that renders long pictures, one at a time. */
struct kd_lane {
    struct kd_render_queue *queue;
    struct kd_render_job *job; /* the job that is in the lane; NULL if the lane is free */
    uint64_t bytes;            /* device memory in bytes that the job needs, from its plan; 0: negligible */
    pthread_t thread;
};

struct kd_render_queue {
    struct kd_renderer_params params;
    struct kd_renderer *renderer;
    struct kd_buffer device_json;
    enum kd_status open_status;
    struct kd_error open_error;

    pthread_mutex_t lock;
    /* signalled when a member below changes; one condition is enough, because few threads wait */
    pthread_cond_t changed;
    bool opened, closing;
    struct kd_shares shares;
    struct kd_allowance allowance;
    struct kd_render_list jobs;   /* jobs that wait for the device or use it, in the order of their arrival */
    struct kd_render_job *holder; /* the job that owns the device; NULL if there is none */
    struct kd_lane lanes[KD_BACKGROUND_RENDERS];
    unsigned n_lanes;    /* number of lanes whose threads are running */
    uint64_t lane_bytes; /* sum of `bytes` over all lanes */

    struct kd_render_list encoding;
    size_t frame_bytes; /* bytes of all frames that are rendered but not yet encoded */
    bool encoding_long;
    unsigned limit, client_limit, unfinished;
    bool lost;
    struct kd_error lost_error;
    bool hangs; /* true if a call into the driver hangs, so that its thread cannot be joined */
    /* failed: true if the device has failed; it is reopened when `inside` is 0. reopening: true while that is done. */
    bool failed, reopening;
    struct kd_error failure; /* the reason why the device has failed */
    unsigned inside;         /* number of jobs that use the renderer now */
    /* reopenings: maximum number within KD_REOPENINGS_S; reopened: number since the start */
    unsigned reopenings, reopened;
    unsigned spent;           /* number of reopenings since the time spent_from_ms */
    double spent_from_ms;     /* start of the present period in which reopenings are counted */
    bool compiles;            /* true while the thread that compiles kernels runs */
    struct kd_shares missing; /* the fair queueing of compilations */
    /* compiling: kernels that are being compiled. compiled: kernels that are ready, but not yet passed to the
     * renderer. */
    struct kd_compilation *compiling, *compiled;
    /* ahead: kernels for which no job waits; they are compiled while no other compilation waits. compiling_ahead:
     * true while such kernels are being compiled. */
    struct kd_compilation *ahead;
    bool compiling_ahead;
    double ahead_ms;         /* time of the latest search for kernels for `ahead` */
    _Atomic bool uncompiled; /* set to true if the kernels that are being compiled are no longer needed */
    /* running mean of compilation times in ms; 0: there was no compilation yet */
    double compile_ms;
    struct kd_pulse pulse, compiler_pulse; /* watchdogs of the owner of the device, and of the thread that compiles */
    _Atomic bool cancel;
    struct kd_render_measures measures;
    struct kd_render_job rest; /* the job that frees memory after rest_ms without requests */
    /* worked_ms: time when the last request arrived, or when work last ended; trimmed_ms: time when the heap was
     * last trimmed */
    double rest_ms, worked_ms, trimmed_ms;
    bool rested; /* true if memory was freed after worked_ms */

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

/* True if a client waits for the job. Such a job may be refused. */
static inline bool kd_render_is_awaited(const struct kd_render_job *job)
{
    return job->claim.class == KD_CLASS_PICTURE || job->claim.class == KD_CLASS_PIXEL ||
           job->claim.class == KD_CLASS_RAYS;
}

bool kd_render_unwanted(struct kd_render_queue *queue, struct kd_render_job *job);
/* Puts a job back in its initial waiting stage. */
void kd_render_stand_in_line(struct kd_render_job *job);

/* Like kd_render_queue_push, for a job that does not render a scene. Called with the lock held. */
void kd_render_queue_push_locked(struct kd_render_queue *queue, struct kd_render_job *job);

/* rest.c: if there is no work, frees memory that the renderer does not need. Called with the lock held. */
void kd_render_rest_if_idle(struct kd_render_queue *queue);
/* rest.c: trims the heap, at most once in rest_ms, while there is work. Called without the lock. */
void kd_render_trim_if_due(struct kd_render_queue *queue);

/* Functions of compile.c, called with the lock held. The first two must be called only while no other thread owns
 * the device. kd_render_ask_kernels looks for kernels that waiting jobs lack. kd_render_take_kernels passes compiled
 * kernels to the renderer. kd_render_has_kernels: true if a job lacks no kernels. kd_render_tell_kernels records in
 * the job's frame how long the job has waited for kernels. */
void kd_render_ask_kernels(struct kd_render_queue *queue);
void kd_render_take_kernels(struct kd_render_queue *queue);
bool kd_render_has_kernels(const struct kd_render_queue *queue, const struct kd_render_job *job);
void kd_render_tell_kernels(struct kd_render_job *job);
/* The callback `lacks` of struct kd_renderer_params. Its user pointer is the queue. The owner of the device calls it
 * without the lock. */
bool kd_render_lacks(void *queue, struct kd_compilation *compilation, bool background);
/* Called after a job's turn. Returns true if the job starts again because kernels were missing; its result is then
 * cleared. */
bool kd_render_begins_with_kernels(struct kd_render_queue *queue, struct kd_render_job *job);
/* Called when the job leaves the queue. */
void kd_render_forget_kernels(struct kd_render_queue *queue, struct kd_render_job *job);
/* Stores kernels that are compiled as soon as no job waits for other kernels. They replace earlier kernels of this
 * kind. NULL changes nothing. */
void kd_render_compile_ahead(struct kd_render_queue *queue, struct kd_compilation *compilation);
/* Main function of the thread that compiles; its argument is the queue. Returns when the queue is closing. */
void *kd_render_compile_main(void *queue);

/* Functions of reopen.c. All except the first are called with the lock held. */
/* Records that the device has failed. Called without the lock. */
void kd_render_failed(struct kd_render_queue *queue, const struct kd_error *error);
/* Called after a job's turn. Returns true if the job starts again because the device has failed; its result is then
 * cleared. */
bool kd_render_once_more(struct kd_render_queue *queue, struct kd_render_job *job);
/* Records that the device hangs, and therefore cannot be closed. */
void kd_render_hung(struct kd_render_queue *queue, const struct kd_error *error);
/* Reopens a device that has failed, if no job is inside the renderer; otherwise does nothing. Releases the lock
 * during the work. */
void kd_render_reopen(struct kd_render_queue *queue);
/* Removes a job from the list of jobs that want the device. Called with the lock held. */
void kd_render_take_out(struct kd_render_queue *queue, struct kd_render_job *job);
/* Calls done(), which may free the job. The job's connection must stay open until `unfinished` was decremented. */
void kd_render_finish(struct kd_render_queue *queue, struct kd_render_job *job);

/* device_scheduler.c: if nobody owns the device, chooses the next owner. Called with the lock held. */
void kd_render_next(struct kd_render_queue *queue);
/* Releases the device until the next turn of its owner, which calls this. Called with the lock held. */
void kd_render_give_way(struct kd_render_queue *queue, struct kd_render_job *job);
/* Updates device_json. Called without the lock by the owner of the device. */
enum kd_status kd_render_describe_device(struct kd_render_queue *queue);
/* Main functions of threads, which return when the queue is closing and empty. kd_render_short_main runs short work;
 * its argument is the queue. kd_render_lane_main runs a lane; its argument is the lane. */
void *kd_render_short_main(void *queue);
void *kd_render_lane_main(void *lane);

/* encode.c: main function of an encoder thread; its argument is the queue. Returns when the queue is closing and all
 * work is finished. */
void *kd_render_encode_main(void *queue);
/* Puts a rendered frame into the queue for encoding. Called with the lock held. */
void kd_render_encode(struct kd_render_queue *queue, struct kd_render_job *job);

#endif
