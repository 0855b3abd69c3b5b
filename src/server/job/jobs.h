/* Jobs: pictures, and sequences of them, that take longer than a client wants to hold a connection for.
 *
 * The oldest unfinished job renders, one frame at a time and with the smallest share of the device; its frames are
 * written to files. A job does not depend on its client: it ends when it is done, fails or is deleted, and continues
 * after a restart if the server has a state folder. Any thread; functions on watchers belong to the HTTP thread. */
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

#define KD_JOB_ATTEMPTS \
    3 /* ends of the server without a frame after which a job waits before it is tried again: it may be the cause */
#define KD_JOB_WAIT_MS 30e3 /* then, and twice as long after each further one, ... */
#define KD_JOB_WAIT_MAX_MS 3600e3

struct kd_jobs_params {
    struct kd_render_queue *renders;
    struct kd_turns *turns; /* whose workers move the bodies of films */
    const char *state;      /* a folder, NULL: jobs end with the server */
    unsigned limit, kept;   /* unfinished jobs; those and finished ones */
    unsigned client_limit;  /* unfinished jobs of one address; 0: as many as any */
    unsigned longest_s;     /* a frame may take, by its plan */
    double longest_job_s;   /* all frames of a job */
    uint64_t bytes;         /* of the frames of all jobs */
    double keep_s;          /* that a finished job stays */
};
/* Creates the jobs, with a state folder those that it holds. params->state need not live on. */
enum kd_status kd_jobs_create(const struct kd_jobs_params *params, struct kd_jobs **out, struct kd_error *error);
/* Goes on with jobs of before, once all that they need is there. */
void kd_jobs_begin(struct kd_jobs *all);
/* Called after kd_jobs_close, and when the render queue has finished. Accepts NULL. */
void kd_jobs_destroy(struct kd_jobs *all);

/* A job that is asked for: what kd_job_spec_parse makes of the request, and how far its frames have been looked at.
 * One thread at a time. */
struct kd_job_draft {
    struct kd_job_spec spec;
    struct kd_cost cost; /* of the frames that have been looked at: cost.frames of spec.frames */
    struct kd_once once; /* what asks for it */
    char preset[32];     /* as the spec was parsed with */
};
void kd_job_draft_finish(struct kd_job_draft *draft);
/* Checks further frames until it is time, at least one, and makes their order when all are. KD_EINVAL and KD_ETOOBIG
 * with a pointer into the request. */
enum kd_status kd_jobs_check(const struct kd_jobs *all, struct kd_job_draft *draft, double until_ms,
                             struct kd_error *error);
/* Makes a job, of which the caller holds a reference, from a checked draft, which it empties. text: the
 * request; client: its address. KD_EBUSY: there are as many jobs as there may be, or with *quota as many of this
 * client. */
enum kd_status kd_jobs_open(struct kd_jobs *all, struct kd_job_draft *draft, const char *text, size_t length,
                            const char *client, bool *quota, struct kd_job **out, struct kd_error *error);
struct kd_job *kd_jobs_find(struct kd_jobs *all, const char *id); /* a reference, or NULL */
/* The same by the key of what has asked for it; "" finds none. */
struct kd_job *kd_jobs_find_once(struct kd_jobs *all, const char *key);
const struct kd_once *kd_job_once(const struct kd_job *job);
void kd_job_release(struct kd_job *job);
double kd_jobs_remaining_s(struct kd_jobs *all); /* until there is room for one more, estimated */

const char *kd_job_id(const struct kd_job *job);
const char *kd_job_token(const struct kd_job *job);

struct kd_job_status {
    enum kd_job_state state;
    bool deleted;
    const struct kd_series *series;
    unsigned frames, finished, place; /* place: jobs before it */
    double fraction;                  /* of the whole job */
    double remaining_s;               /* NAN: it waits for others, or is over */
    double created, ended;            /* seconds since 1970 */
    unsigned traced;                  /* lens maps */
    double exposure;                  /* of all frames, in stops, as it was measured; NAN: it was not, or not yet */
    const struct kd_sweep *sweep;     /* as long as the job; NULL: none */
    uint64_t bytes;
    char error[480];
    char delayed[160]; /* why it is not tried at present; "": it is */
};
void kd_job_status(struct kd_job *job, struct kd_job_status *out);

struct kd_jobs_counts;
/* Counts the jobs; false, with nothing known, where that takes more than a moment. */
bool kd_jobs_counts(struct kd_jobs *all, struct kd_jobs_counts *out);

/* Opens a finished frame as kd_job_store_get does. */
bool kd_job_frame(struct kd_job *job, unsigned frame, struct kd_job_file *out);
/* Gives what there is to see of a job of pictures, and asks for more of it to come: the frame under way as `png`,
 * drawn down to some row, else the last frame that is finished. False: nothing yet. */
struct kd_job_sight {
    unsigned frame;
    bool finished;         /* it is in its file: kd_job_frame */
    uint32_t rows, height; /* of a frame under way: rows drawn, and all rows */
};
bool kd_job_glimpse(struct kd_job *job, struct kd_buffer *png, struct kd_job_sight *out);
/* Deletes a job: it is found no more, nor after a restart, and its files go with the last reference. It takes as
 * long as the disk does: for workers. */
void kd_job_delete(struct kd_job *job);
/* The same for who must not wait: until its files go, a restart may find it. */
void kd_job_drop(struct kd_job *job);

/* A stream that follows a job. */
struct kd_job_watcher {
    struct kd_job *job; /* a reference */
    struct MHD_Connection *mhd;
    bool by_frame; /* waits for the frame `next`, else for any change */
    unsigned next, revision;
    double deadline_ms; /* on kd_clock_ms, of waiting; INFINITY: none */
    bool waiting;       /* suspended */
    struct kd_job_watcher *previous, *next_watcher;
};
void kd_job_watch(struct kd_job_watcher *watcher); /* takes the reference over */
void kd_job_unwatch(struct kd_job_watcher *watcher);
enum kd_job_news {
    KD_JOB_NEWS,  /* what it waits for is there */
    KD_JOB_LATE,  /* its deadline has passed */
    KD_JOB_OVER,  /* it is not, and will not be */
    KD_JOB_LATER, /* the connection has been suspended, and is resumed for one of these */
};
enum kd_job_news kd_job_await(struct kd_job_watcher *watcher);

/* Wake who waits; delete what has been kept long enough. One thread, ten times a second. */
void kd_jobs_sweep(struct kd_jobs *all);
/* Stops taking jobs and beginning frames. The running frame is dropped, and rendered again after a restart; all
 * watchers are told that it is over. */
void kd_jobs_close(struct kd_jobs *all);

#endif
