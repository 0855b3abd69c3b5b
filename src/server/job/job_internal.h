/* Internals of jobs, shared by jobs.c, resume.c, run.c and watch.c. */
#ifndef KD_SERVER_JOB_INTERNAL_H
#define KD_SERVER_JOB_INTERNAL_H

#include "server/job/films.h"
#include "server/job/jobs.h"
#include "job/exposure.h"
#include "render/plan/sweep_order.h"
#include "server/http/task_scheduler.h"

#include <pthread.h>

struct kd_job_render; /* a frame that is in the render queue, or being planned */

/* Preview of an unfinished frame (preview_hook.c). */
struct kd_job_preview_hook {
    struct kd_buffer png;
    unsigned frame;
    uint32_t rows, height;
    double until_ms; /* previews are made until this time; all times on kd_clock_ms */
    double due_ms;   /* no preview is made before this time */
    double began_ms; /* start of the latest preview */
};

/* State of the playground of a film (film.c). */
struct kd_job_film {
    /* While `moving` is set, the worker owns the members up to spent_ms and uses them without the lock. While it is
     * not set, the lock protects these members. */
    struct kd_playground *p; /* NULL: not created yet */
    unsigned at;             /* frame that the playground has reached or is leaving */
    double begin;            /* the playground's time at frame 0 */
    double spent_ms;         /* computing time spent on moving the bodies */
    /* the lock protects the members from here on at all times */
    bool moving;
    unsigned to;                       /* target frame */
    struct kd_dynamic_bodies *dynamic; /* bodies at the target frame, a reference; NULL: not reached yet */
};

/* Common exposure of all frames, which is measured before the first frame is rendered (job/exposure.h). */
struct kd_job_exposure {
    unsigned n, done; /* n: number of pictures needed, 0 if the exposure is not measured; done: number of pictures
                       * measured */
    unsigned frames[KD_JOB_EXPOSURE_FRAMES];
    double stops[KD_JOB_EXPOSURE_FRAMES];
};

struct kd_job {
    struct kd_jobs *all;
    unsigned references;
    struct kd_job_record record;
    struct kd_job_spec spec; /* empty if this version cannot parse the request */
    struct kd_sweep_order order;
    struct kd_job_film film;
    struct kd_job_exposure exposure;
    bool unordered; /* after a restart watch.c computes the order of frames again; no frame begins before that is
                     * done */
    const struct kd_series *series;
    /* next: all frames before this index in the order of rendering are done or under way */
    unsigned frames, next, finished;
    unsigned char *have; /* one flag for each frame: its file exists */
    double fraction;     /* fraction of the present frame that is rendered */
    double estimate_ms;  /* estimated time of all frames, from their plans */
    double began_ms;     /* time at which this server began the job; 0: not yet */
    double due_ms;       /* no frame begins before this time on kd_clock_ms */
    double delay_ms;     /* length of the next delay after a shortage; 0: no shortage */
    double counted_ms;   /* time at which the number of lens maps was last written to the record */
    /* time at which the job ended, on kd_clock_ms, because that clock ignores changes of the system time */
    double ended_ms;
    char delayed[160]; /* the reason why the job waits until due_ms */
    bool begun_here;   /* this server has begun a frame of the job, or has moved the bodies of the job's film */
    bool struck;       /* this server has counted an attempt in the job's record */
    unsigned finished_here;
    struct kd_job_stored_film films[KD_JOB_FILMS]; /* oldest first */
    unsigned n_films;
    bool filming;           /* a film is being encoded (films.c) */
    unsigned encoding;      /* number of frames that are rendered and not yet in files */
    uint64_t bytes;         /* total size of its frames and films */
    unsigned revision;      /* incremented when the job's status changes */
    char client[KD_CLIENT]; /* client that requested the job; "": unknown, after a restart */
    bool listed;
    bool creating;  /* the job's files are being created, so no frame begins */
    bool unwritten; /* the record has changed since it was written to disk */
    bool keeping;   /* no frame begins before the record is on disk */
    bool measured;  /* true: `keeping` was set because the exposure has been measured */
    bool forgotten; /* the job's request is deleted from disk */
    struct kd_job_preview_hook preview;
    struct kd_job_watcher *watchers;
    struct kd_job *link;
};

struct kd_jobs {
    struct kd_jobs_params params;
    struct kd_job_store *store;
    bool temporary;          /* the store is created with the first job and deleted at the end */
    pthread_mutex_t opening; /* held while the store is created */
    /* Protects all members below. Never held while a file is written or removed, because the HTTP thread takes this
     * lock. */
    pthread_mutex_t lock;
    struct kd_scheduler_job writer; /* scheduler job that writes records (records.c) */
    /* writes: the writer is running; begun: kd_jobs_begin was called, so other threads use the jobs */
    bool writes, begun;
    struct kd_job *first;            /* oldest first */
    struct kd_job *gone;             /* jobs whose files are to be removed */
    struct kd_job_render *rendering; /* frame that is in the render queue, or being planned */
    struct kd_job *filming;          /* the job whose playground is advancing now; NULL: none */
    unsigned behind;
    uint64_t bytes;
    uint64_t frames; /* frames of all jobs that this server has finished */
    bool closed;
};

/* The functions below are called with all->lock unless a comment says otherwise. */

double kd_job_now_s(void); /* system time in s since 1970 */

/* True if a job is being rendered or waits to be rendered. */
static inline bool kd_job_is_active(const struct kd_job *job)
{
    return job->listed && job->record.state == KD_JOB_ACTIVE;
}
/* records.c: requests that a worker write the job's record. Failures are logged. */
void kd_job_write(struct kd_job *job);
void kd_jobs_begin_writing(struct kd_jobs *all); /* starts the writer if any record has changed */
/* Like kd_job_write. In addition, no frame of the job begins before the record is on disk. */
void kd_job_keep(struct kd_job *job);
/* Writes all changed records. Call it when no other thread uses the jobs. */
void kd_jobs_write_all(struct kd_jobs *all);
/* Counts an attempt at the job before it begins, because the work may crash the server. Each server counts at most
 * one attempt for each job. */
void kd_job_strike(struct kd_job *job);
void kd_job_end(struct kd_job *job, enum kd_job_state state, const char *why);
/* Delays a job after a shortage that may pass. Each delay is longer than the one before. */
void kd_job_delay(struct kd_job *job, const char *why);
/* Removes the job from the list; the caller gets the list's reference. When the last reference is dropped, the job's
 * files are deleted, the request first (kd_jobs_bury). */
void kd_job_unlist(struct kd_job *job);
void kd_job_wake(struct kd_job *job, double now); /* resumes watchers that have news */

/* Makes a job from a spec and empties the spec. The job is not in the list yet. Returns NULL when out of memory. Called
 * without the lock. */
struct kd_job *kd_job_make(struct kd_jobs *all, struct kd_job_spec *spec);
void kd_job_append(struct kd_jobs *all, struct kd_job *job); /* adds the job to the list, as the youngest */
/* resume.c, callback of kd_job_store_load: resumes a stored job. user: the jobs. Call it before any other thread
 * uses the jobs. */
void kd_job_resume(void *user, const struct kd_job_record *known, struct kd_buffer *request);

/* Removes at most `files` files of deleted jobs. Called without the lock, by one thread at a time. */
void kd_jobs_bury(struct kd_jobs *all, unsigned files);

/* run.c: begins the next frame if possible. A worker plans it and pushes it to the render queue. */
void kd_jobs_pump(struct kd_jobs *all);
/* Frees the frame that waits to be planned. Call it only when no other thread uses the jobs. */
void kd_jobs_drop_unplanned(struct kd_jobs *all);
/* Finds the job of a frame from the user pointer of kd_job_preview_hook; number may be NULL. Any thread. */
struct kd_job *kd_job_of_frame(const void *render, unsigned *number);
extern const struct kd_preview_hook kd_job_preview_hook;
/* Handles the failure of a frame or its scene. If memory or disk space is short, the job is delayed; otherwise it
 * ends. */
void kd_job_give_up(struct kd_job *job, const struct kd_error *error);
/* film.c: gets the bodies that a frame of a film shows; the job owns them. *out is NULL if the film has not reached
 * the frame yet, or if another film is being made. In that case kd_jobs_pump is called as soon as the bodies exist.
 * Returns KD_OK or KD_ENOMEM. */
enum kd_status kd_job_film_at(struct kd_job *job, unsigned frame, struct kd_dynamic_bodies **out,
                              struct kd_error *error);
/* Frees the playground unless a worker owns it, and lets another film begin. */
void kd_job_film_drop(struct kd_job *job);
/* Cancels the frame of this job that is being rendered, if any. job NULL: the frame of any job. */
void kd_jobs_drop_frame(struct kd_jobs *all, const struct kd_job *job);

#endif
