/* Jobs: pictures, and sequences of pictures, that take longer than a client wants to keep a connection open.
 * The oldest unfinished job is rendered, one frame at a time and with the smallest share of the device. Its frames
 * are written to files. A job does not depend on its client: it ends when it is done, when it fails, or when it is
 * deleted. If the server has a state folder, its jobs continue after a restart. Any thread; functions on watchers
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

/* number of crashes without a new frame after which a job is delayed, because it may be the cause of the crashes */
#define KD_JOB_ATTEMPTS 3
#define KD_JOB_WAIT_MS 30e3 /* length of the first delay; it doubles with each further crash, up to the limit below */
#define KD_JOB_WAIT_MAX_MS 3600e3

struct kd_jobs_params {
    struct kd_render_queue *renders;
    struct kd_scheduler *scheduler; /* scheduler whose workers move the bodies of films */
    const char *state;              /* state folder; NULL: jobs end with the server */
    /* limit: largest number of unfinished jobs; stored: largest number of all stored jobs */
    unsigned limit, stored;
    unsigned client_limit; /* limit of unfinished jobs of one client; 0: no separate limit */
    unsigned longest_s;    /* limit of one frame's estimated time, in s */
    double longest_job_s;  /* limit of the estimated time of all frames of a job, in s */
    uint64_t bytes;        /* limit of the size of all jobs' frames */
    double keep_s;         /* time until a finished job is deleted */
};
/* Loads the jobs of the state folder, if there is one. params->state may be freed afterwards. */
enum kd_status kd_jobs_create(const struct kd_jobs_params *params, struct kd_jobs **out, struct kd_error *error);
/* Starts the loaded jobs. Call this after everything that the jobs use has been created. */
void kd_jobs_begin(struct kd_jobs *all);
/* Call it after kd_jobs_close, when the render queue has finished. Accepts NULL. */
void kd_jobs_destroy(struct kd_jobs *all);

/* A requested job that is being checked: the result of kd_job_spec_parse, and the cost of the frames that are
 * checked so far. One thread at a time. */
struct kd_job_draft {
    struct kd_job_spec spec;
    struct kd_cost cost; /* cost of the frames checked so far, which are the first cost.frames of the spec */
    struct kd_once once; /* hashes of the Idempotency-Key and the request */
    char preset[32];     /* preset with which the spec was parsed */
};
void kd_job_draft_finish(struct kd_job_draft *draft);
/* Checks further frames until until_ms, and at least one frame. After the last frame it computes the frames' order.
 * Returns KD_EINVAL or KD_ETOOBIG with a pointer into the request. */
enum kd_status kd_jobs_check(const struct kd_jobs *all, struct kd_job_draft *draft, double until_ms,
                             struct kd_error *error);
/* Makes a job from a checked draft, and empties the draft. The caller gets a reference to the job. text: the
 * request; client: the client that sent it. Returns KD_EBUSY at a limit. *quota: true if that limit is the client's
 * own. */
enum kd_status kd_jobs_open(struct kd_jobs *all, struct kd_job_draft *draft, const char *text, size_t length,
                            const char *client, bool *quota, struct kd_job **out, struct kd_error *error);
struct kd_job *kd_jobs_find(struct kd_jobs *all, const char *id); /* returns a counted reference, or NULL */
/* Like kd_jobs_find, by the hash of the job's Idempotency-Key; "" finds none. */
struct kd_job *kd_jobs_find_once(struct kd_jobs *all, const char *key);
const struct kd_once *kd_job_once(const struct kd_job *job);
void kd_job_release(struct kd_job *job);
double kd_jobs_remaining_s(struct kd_jobs *all); /* estimated time until another job is accepted */

const char *kd_job_id(const struct kd_job *job);
const char *kd_job_token(const struct kd_job *job);

struct kd_job_status {
    enum kd_job_state state;
    bool deleted;
    const struct kd_series *series;
    unsigned frames, finished, place; /* place: number of unfinished jobs before this one in the queue */
    double fraction;                  /* finished fraction of the whole job */
    double remaining_s;               /* NAN: unknown, because the job waits for others or has ended */
    double created, ended;            /* seconds since 1970 */
    unsigned traced;                  /* number of lens maps traced */
    double exposure;                  /* measured exposure of all frames in stops; NAN: none, or not yet */
    const struct kd_sweep *sweep;     /* valid as long as the job; NULL: the job is not a sweep */
    uint64_t bytes;
    char error[480];
    char delayed[160]; /* the reason why the job waits before a retry; "": the job is not waiting for one */
};
void kd_job_status(struct kd_job *job, struct kd_job_status *out);

struct kd_jobs_counts;
/* Reads the counts. Returns false if the lock does not become free soon. */
bool kd_jobs_counts(struct kd_jobs *all, struct kd_jobs_counts *out);

/* Opens the file of a finished frame, like kd_job_store_get. */
bool kd_job_frame(struct kd_job *job, unsigned frame, struct kd_job_file *out);
/* Gets the preview of a job of pictures, and requests that further previews are made. `png` is the frame under way,
 * rendered down to some row. If no frame is under way, `out` names the last finished frame. Returns false if there
 * is no finished frame either. */
struct kd_job_sight {
    unsigned frame;
    bool finished;         /* the frame is finished; kd_job_frame opens its file */
    uint32_t rows, height; /* for a frame under way: number of rendered rows, and number of all rows */
};
bool kd_job_glimpse(struct kd_job *job, struct kd_buffer *png, struct kd_job_sight *out);
/* Deletes a job: it cannot be found any more, not even after a restart. Its files are deleted with the last
 * reference. Call it on workers only, because it waits for the disk. */
void kd_job_delete(struct kd_job *job);
/* Like kd_job_delete, without waiting. Until its files are deleted, a restart may find the job. */
void kd_job_drop(struct kd_job *job);

/* A stream that follows a job. */
struct kd_job_watcher {
    struct kd_job *job; /* a reference */
    struct MHD_Connection *mhd;
    bool by_frame; /* true: the watcher waits for the frame `next`; false: it waits for any change */
    unsigned next, revision;
    double deadline_ms; /* end of waiting on kd_clock_ms; INFINITY: no end */
    bool waiting;       /* the connection of the watcher is suspended */
    struct kd_job_watcher *previous, *next_watcher;
};
void kd_job_watch(struct kd_job_watcher *watcher); /* takes over the caller's reference */
void kd_job_unwatch(struct kd_job_watcher *watcher);
enum kd_job_news {
    KD_JOB_NEWS,  /* the event that the watcher waited for has happened */
    KD_JOB_LATE,  /* the watcher's deadline has passed */
    KD_JOB_OVER,  /* the event that the watcher waits for cannot happen any more */
    KD_JOB_LATER, /* the connection is suspended, and will be resumed for one of the other results */
};
enum kd_job_news kd_job_await(struct kd_job_watcher *watcher);

/* Resumes watchers that have news, and deletes expired jobs. Called by one thread, ten times a second. */
void kd_jobs_sweep(struct kd_jobs *all);
/* Accepts no more jobs and begins no more frames. The frame under way is cancelled; it is rendered again after a
 * restart. Watchers are notified. */
void kd_jobs_close(struct kd_jobs *all);

#endif
