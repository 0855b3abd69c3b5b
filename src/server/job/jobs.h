/* Jobs: pictures, and sequences of pictures, that take longer than a client wants to keep a connection open. The
 * oldest unfinished job is rendered, one frame at a time, with the smallest share of the device. Its frames are
 * written to files. A job continues when its client disconnects: it ends when it is done, when it fails, or when it
 * is deleted. If the server has a state folder, its jobs continue after a restart. Any thread; functions on watchers
 * belong to the HTTP thread. */
#ifndef KD_SERVER_JOB_JOBS_H
#define KD_SERVER_JOB_JOBS_H

#include "render/output/cost.h"
#include "job/spec.h"
#include "server/job/store.h"
#include "server/render/queue.h"
#include "server/http/counts.h"

#include <microhttpd.h>

struct kd_jobs;
struct kd_job;

/* A job is delayed after this number of crashes without a new frame, because it may cause the crashes. */
#define KD_JOB_ATTEMPTS 3
/* length in ms of the first delay; it doubles with each further crash, up to the limit below */
#define KD_JOB_WAIT_MS 30e3
#define KD_JOB_WAIT_MAX_MS 3600e3

struct kd_jobs_params {
    struct kd_render_queue *renders;
    struct kd_scheduler *scheduler; /* its workers move the bodies of films */
    const char *state;              /* the state folder; NULL: jobs end with the server */
    /* limit: maximum number of unfinished jobs; stored: maximum number of all stored jobs */
    unsigned limit, stored;
    unsigned client_limit; /* maximum number of unfinished jobs of one client; 0: no separate limit */
    unsigned longest_s;    /* maximum estimated time of one frame, in s */
    double longest_job_s;  /* maximum estimated time of all frames of a job, in s */
    uint64_t bytes;        /* maximum size of the frames of all jobs, in bytes */
    double keep_s;         /* seconds after which a finished job is deleted */
};
/* Creates the table of jobs, and loads the jobs of the state folder, if there is one. params->state may be freed
 * after this call. */
enum kd_status kd_jobs_create(const struct kd_jobs_params *params, struct kd_jobs **out, struct kd_error *error);
/* Starts the loaded jobs. Call this when everything that jobs use exists. */
void kd_jobs_begin(struct kd_jobs *all);
/* Call this after kd_jobs_close, when the render queue has finished. Accepts NULL. */
void kd_jobs_destroy(struct kd_jobs *all);

/* A request for a job that is being checked: the result of kd_job_spec_parse, and the cost of the frames that were
 * checked so far. One thread at a time. */
struct kd_job_draft {
    struct kd_job_spec spec;
    struct kd_cost cost; /* cost of the frames that were checked so far: the first cost.frames frames of the spec */
    struct kd_once once; /* hashes of the Idempotency-Key and of the request */
    char preset[32];     /* the preset with which the spec was parsed */
};
void kd_job_draft_finish(struct kd_job_draft *draft);
/* Checks more frames (at least one) until the time until_ms. After the last frame, computes the order of the frames.
 * Returns KD_EINVAL or KD_ETOOBIG with a pointer into the request. */
enum kd_status kd_jobs_check(const struct kd_jobs *all, struct kd_job_draft *draft, double until_ms,
                             struct kd_error *error);
/* Makes a job from a draft that was checked, and empties the draft. The caller gets a reference to the job. text:
 * the request. client: the client that has sent the request. Returns KD_EBUSY at a limit; *quota is then true if it
 * is the client's own limit. */
enum kd_status kd_jobs_open(struct kd_jobs *all, struct kd_job_draft *draft, const char *text, size_t length,
                            const char *client, bool *quota, struct kd_job **out, struct kd_error *error);
struct kd_job *kd_jobs_find(struct kd_jobs *all, const char *id); /* returns a counted reference, or NULL */
/* Like kd_jobs_find, but by the hash of the job's Idempotency-Key. The key "" finds no job. */
struct kd_job *kd_jobs_find_once(struct kd_jobs *all, const char *key);
const struct kd_once *kd_job_once(const struct kd_job *job);
void kd_job_release(struct kd_job *job);
double kd_jobs_remaining_s(struct kd_jobs *all); /* estimated time in s until another job can be accepted */

const char *kd_job_id(const struct kd_job *job);
const char *kd_job_token(const struct kd_job *job);

struct kd_job_status {
    enum kd_job_state state;
    bool deleted;
    const struct kd_series *series;
    unsigned frames, finished, place; /* place: number of unfinished jobs that precede this one in the queue */
    double fraction;                  /* fraction of the whole job that is done */
    double remaining_s;               /* NAN if it is unknown, because the job waits for other jobs or has ended */
    double created, ended;            /* seconds since 1970 */
    unsigned traced;                  /* number of lens maps that were traced */
    /* measured common exposure of the frames, in stops; NAN: there is none, or it is not measured yet */
    double exposure;
    const struct kd_sweep *sweep; /* valid as long as the job; NULL if the job is not a sweep */
    uint64_t bytes;
    char error[480];
    char delayed[160]; /* the reason why the job waits for a retry; "" if it does not wait */
};
void kd_job_status(struct kd_job *job, struct kd_job_status *out);

struct kd_jobs_counts;
/* Reads the counts. Returns false if the lock is not free soon. */
bool kd_jobs_counts(struct kd_jobs *all, struct kd_jobs_counts *out);

/* Opens the file of a finished frame, like kd_job_store_get. */
bool kd_job_frame(struct kd_job *job, unsigned frame, struct kd_job_file *out);
/* Gets the preview of a job whose frames are pictures, and requests that more previews are made. `png` is the frame
 * in progress, rendered down to some row. If no frame is in progress, `out` names the last finished frame. Returns
 * false if there is no such frame either. */
struct kd_job_sight {
    unsigned frame;
    bool finished;         /* true if the frame is finished; kd_job_frame then opens its file */
    uint32_t rows, height; /* for a frame in progress: number of rendered rows, and total number of rows */
};
bool kd_job_glimpse(struct kd_job *job, struct kd_buffer *png, struct kd_job_sight *out);
/* Deletes a job. After this call the job cannot be found any more, not even after a restart. Its files are deleted
 * with the last reference. Call this only on workers, because it waits for the disk. */
void kd_job_delete(struct kd_job *job);
/* Like kd_job_delete, but does not wait. Until the files are deleted, the job may be found again after a restart. */
void kd_job_drop(struct kd_job *job);

/* A stream that follows a job. */
struct kd_job_watcher {
    struct kd_job *job; /* a reference */
    struct MHD_Connection *mhd;
    bool by_frame; /* true: the watcher waits for the frame `next`; false: the watcher waits for any change */
    unsigned next, revision;
    double deadline_ms; /* end of the waiting time, on the clock of kd_clock_ms; INFINITY: no end */
    bool waiting;       /* true while the watcher's connection is suspended */
    struct kd_job_watcher *previous, *next_watcher;
};
void kd_job_watch(struct kd_job_watcher *watcher); /* takes over the caller's reference */
void kd_job_unwatch(struct kd_job_watcher *watcher);
enum kd_job_news {
    KD_JOB_NEWS,  /* the event for which the watcher waits has happened */
    KD_JOB_LATE,  /* the deadline of the watcher has passed */
    KD_JOB_OVER,  /* the event for which the watcher waits can no longer happen */
    KD_JOB_LATER, /* the connection is suspended, and is resumed as soon as one of the other results applies */
};
enum kd_job_news kd_job_await(struct kd_job_watcher *watcher);

/* Resumes watchers that have news, and deletes expired jobs. Called ten times a second, by one thread. */
void kd_jobs_sweep(struct kd_jobs *all);
/* After this call no job is accepted and no frame starts. The frame in progress is cancelled, and is rendered again
 * after a restart. Watchers are notified. */
void kd_jobs_close(struct kd_jobs *all);

#endif
