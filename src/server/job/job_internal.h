/* Internals of jobs, shared by the files of this folder. */
#ifndef KD_SERVER_JOB_INTERNAL_H
#define KD_SERVER_JOB_INTERNAL_H

#include "server/job/films.h"
#include "server/job/jobs.h"
#include "job/exposure.h"
#include "render/plan/sweep_order.h"
#include "server/http/task_scheduler.h"

#include <pthread.h>

struct kd_job_render; /* a frame that is being planned, or is in the render queue */

/* Preview of an unfinished frame (preview_hook.c). */
struct kd_job_preview_hook {
    struct kd_buffer png;
    unsigned frame;
    uint32_t rows, height;
    double until_ms; /* previews are made until this time; all times are on the clock of kd_clock_ms */
    double due_ms;   /* the next preview is not made before this time */
    double began_ms; /* time when the latest preview was started */
};

/* State of a film's playground (film.c). */
struct kd_job_film {
    /* the playground; NULL if it was not created yet. While `moving` is set, a worker owns the members up to
     * spent_ms, and uses them without the lock. Otherwise the lock protects them. */
    struct kd_playground *p; /* NULL if it was not created yet */
    unsigned at;             /* the frame that the playground has reached, or from which it is moving to the next */
    double begin;            /* the playground's time at frame 0, in M */
    double spent_ms;         /* computing time in ms that moving the bodies has taken */
    /* From here on, the lock protects the members at all times. */
    bool moving;
    unsigned to; /* target frame */
    /* a reference to the bodies at the target frame; NULL if it is not reached yet */
    struct kd_dynamic_bodies *dynamic;
};

/* The common exposure of all frames; it is measured before the first frame is rendered (job/exposure.h). */
struct kd_job_exposure {
    /* n: number of pictures to measure; 0: the exposure is not measured. done: number of pictures measured so far. */
    unsigned n, done;
    unsigned frames[KD_JOB_EXPOSURE_FRAMES];
    double stops[KD_JOB_EXPOSURE_FRAMES];
};

struct kd_job {
    struct kd_jobs *all;
    unsigned references;
    struct kd_job_record record;
    struct kd_job_spec spec; /* empty if this version of kerrd cannot parse the request */
    struct kd_sweep_order order;
    struct kd_job_film film;
    struct kd_job_exposure exposure;
    /* true while, after a restart, watch.c computes the order of frames again; no frame starts before that is done */
    bool unordered;
    const struct kd_series *series;
    /* next: index in the order of rendering; all frames before it are done or in progress */
    unsigned frames, next, finished;
    unsigned char *have; /* one flag per frame: true if the frame's file exists */
    double fraction;     /* fraction of the present frame that is done */
    double estimate_ms;  /* estimated time of all frames in ms, from their plans */
    double began_ms;     /* time when this server began the job; 0: it has not begun yet */
    double due_ms;       /* no frame starts before this time on the clock of kd_clock_ms */
    double delay_ms;     /* length in ms of the next delay because of a shortage; 0: there was no shortage */
    double counted_ms;   /* time when the number of lens maps was last written to the record */
    /* time when the job ended, on the clock of kd_clock_ms, which does not depend on changes of the system time */
    double ended_ms;
    char delayed[160]; /* the reason for waiting until due_ms */
    bool begun_here;   /* true if this server has begun a frame of the job, or has moved the bodies of its film */
    bool struck;       /* true if this server has counted its attempt in the job's record */
    unsigned finished_here;
    struct kd_job_stored_film films[KD_JOB_FILMS]; /* oldest first */
    unsigned n_films;
    bool filming;           /* true while a film is being encoded (films.c) */
    unsigned encoding;      /* number of frames that are rendered, but not yet written to files */
    uint64_t bytes;         /* total size of the job's frames and films */
    unsigned revision;      /* incremented when the job's status changes */
    char client[KD_CLIENT]; /* the client that requested the job; "" after a restart, because it is then unknown */
    bool listed;
    bool creating;  /* true while the job's files are being created; no frame starts during that time */
    bool unwritten; /* true if the record has changed since its last write to disk */
    bool keeping;   /* true until the record is on disk; no frame starts before that */
    bool measured;  /* true if `keeping` was set because the exposure has been measured */
    bool forgotten; /* true if the job's request was deleted from disk */
    struct kd_job_preview_hook preview;
    struct kd_job_watcher *watchers;
    struct kd_job *link;
};

struct kd_jobs {
    struct kd_jobs_params params;
    struct kd_job_store *store;
    bool temporary;          /* true if the store is created with the first job and deleted at the end */
    pthread_mutex_t opening; /* held while the store is created */
    /* Protects all members below. It is never held while a file is written or removed, because the HTTP thread takes
     * this lock too. */
    pthread_mutex_t lock;
    struct kd_scheduler_job writer; /* the scheduler job that writes records (records.c) */
    /* writes: true while the writer runs; begun: true after kd_jobs_begin, when other threads use the jobs */
    bool writes, begun;
    struct kd_job *first;            /* oldest first */
    struct kd_job *gone;             /* list of jobs whose files are still to be removed */
    struct kd_job_render *rendering; /* the frame that is being planned, or is in the render queue */
    struct kd_job *filming;          /* the job whose playground is advancing; NULL if there is none */
    unsigned behind;
    uint64_t bytes;
    uint64_t frames; /* number of frames, of all jobs, that this server has finished */
    bool closed;
};

/* The functions below are called with all->lock held, unless their comment says otherwise. */

double kd_job_now_s(void); /* system time in s since 1970 */

/* True if a job is being rendered or waits to be rendered. */
static inline bool kd_job_is_active(const struct kd_job *job)
{
    return job->listed && job->record.state == KD_JOB_ACTIVE;
}
/* records.c: makes a worker write the job's record. Failures are logged. */
void kd_job_write(struct kd_job *job);
void kd_jobs_begin_writing(struct kd_jobs *all); /* starts the writer if any record has changed */
/* Like kd_job_write, but also prevents frames of the job from starting before the record is on disk. */
void kd_job_keep(struct kd_job *job);
/* Writes all records that have changed. Call this only when no other thread uses the jobs. */
void kd_jobs_write_all(struct kd_jobs *all);
/* Counts an attempt before work on the job begins, because the work may crash the server. A server counts at most
 * one attempt per job. */
void kd_job_strike(struct kd_job *job);
void kd_job_end(struct kd_job *job, enum kd_job_state state, const char *why);
/* Delays a job after a shortage that may be temporary. Each delay is longer than the previous one. */
void kd_job_delay(struct kd_job *job, const char *why);
/* Removes the job from the list, and gives the list's reference to the caller. When the last reference is dropped,
 * kd_jobs_bury deletes the job's files, starting with the request. */
void kd_job_unlist(struct kd_job *job);
void kd_job_wake(struct kd_job *job, double now); /* resumes the watchers that have news */

/* Makes a job from a spec, and empties the spec. The job is not in the list yet. Returns NULL when out of memory.
 * Called without the lock. */
struct kd_job *kd_job_make(struct kd_jobs *all, struct kd_job_spec *spec);
void kd_job_append(struct kd_jobs *all, struct kd_job *job); /* adds the job to the list, as the newest */
/* resume.c: callback for kd_job_store_load that resumes a stored job. user: the jobs. Call it before any other
 * thread uses the jobs. */
void kd_job_resume(void *user, const struct kd_job_record *known, struct kd_buffer *request);

/* Removes at most `files` files of deleted jobs. Called without the lock, by one thread at a time. */
void kd_jobs_bury(struct kd_jobs *all, unsigned files);

/* run.c: starts the next frame if that is possible. A worker plans the frame and puts it into the render queue. */
void kd_jobs_pump(struct kd_jobs *all);
/* Frees the frame that waits for planning. Call this only when no other thread uses the jobs. */
void kd_jobs_drop_unplanned(struct kd_jobs *all);
/* Finds the job of a frame. render: user pointer of kd_job_preview_hook. number: receives the frame's number; may be
 * NULL. Any thread. */
struct kd_job *kd_job_of_frame(const void *render, unsigned *number);
extern const struct kd_preview_hook kd_job_preview_hook;
/* Handles the failure of a frame or of its scene. If memory or disk space is short, the job is delayed; otherwise it
 * ends. */
void kd_job_give_up(struct kd_job *job, const struct kd_error *error);
/* film.c: gets the bodies for a frame of a film; the job owns them. *out is NULL if the film has not reached the
 * frame yet, or if another film is being made; kd_jobs_pump is then called as soon as the bodies exist. Returns
 * KD_OK or KD_ENOMEM. */
enum kd_status kd_job_film_at(struct kd_job *job, unsigned frame, struct kd_dynamic_bodies **out,
                              struct kd_error *error);
/* Frees the playground, unless a worker owns it, and permits another film to start. */
void kd_job_film_drop(struct kd_job *job);
/* Cancels the frame of this job that is being rendered, if there is one. job NULL: cancels the frame of any job. */
void kd_jobs_drop_frame(struct kd_jobs *all, const struct kd_job *job);

#endif
