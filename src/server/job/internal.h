/* Internals of jobs, shared by jobs.c, resume.c, run.c and watch.c. */
#ifndef KD_SERVER_JOB_INTERNAL_H
#define KD_SERVER_JOB_INTERNAL_H

#include "server/job/films.h"
#include "server/job/jobs.h"
#include "job/exposure.h"
#include "render/plan/sweep_order.h"
#include "server/http/turns.h"

#include <pthread.h>

struct kd_job_render; /* a frame on its way through the render queue */

/* The part of a frame that can be seen so far (glance.c). */
struct kd_job_glance {
    struct kd_buffer png;
    unsigned frame;
    uint32_t rows, height;
    double until_ms; /* until when it is wanted, on kd_clock_ms as the others */
    double due_ms;   /* before which none is made */
    double began_ms; /* when the last one was begun */
};

/* Where the playground of a film is (film.c). */
struct kd_job_film {
    /* While `moving`: the worker's, who takes no lock for them; else the lock's. */
    struct kd_playground *p; /* NULL: it has still to be read */
    unsigned at;             /* the frame that it is at, or on its way from */
    double begin;            /* its time at frame 0 */
    double spent_ms;         /* on moving it */
    /* The lock's, always. */
    bool moving;
    unsigned to;            /* the frame that it is on its way to, or has come to; */
    struct kd_crowd *crowd; /* what that shows, held; NULL: it is not there yet */
};

/* The one exposure of frames that have one, as it is measured before the first of them (job/exposure.h). */
struct kd_job_exposure {
    unsigned n, done; /* pictures that it takes; n 0: it takes none */
    unsigned frames[KD_JOB_EXPOSURE_FRAMES];
    double stops[KD_JOB_EXPOSURE_FRAMES];
};

struct kd_job {
    struct kd_jobs *all;
    unsigned references;
    struct kd_job_record record;
    struct kd_job_spec spec; /* empty where this version cannot read the request */
    struct kd_sweep_order order;
    struct kd_job_film film;
    struct kd_job_exposure exposure;
    bool unordered; /* it is still being made, after a restart (watch.c), before which no frame is begun */
    const struct kd_series *series;
    unsigned frames, next, finished; /* next: a place in the order, none before which has still to be begun */
    unsigned char *have;             /* which are in their files */
    double fraction;                 /* of the frame being rendered */
    double estimate_ms;              /* of all frames, by their plans */
    double began_ms;                 /* by this server; 0: not yet */
    double due_ms;                   /* not before; on kd_clock_ms */
    double delay_ms;                 /* before the next try, once something has run out; 0: nothing has */
    double counted_ms;               /* when lens maps were last written to its record */
    double ended_ms;                 /* on kd_clock_ms, whatever happens to the clock on the wall */
    char delayed[160];               /* why it waits until due_ms */
    bool begun_here;                 /* this server has begun a frame of it, or moved its bodies, */
    bool struck;                     /* and one attempt of the record is for that */
    unsigned finished_here;
    struct kd_job_kept_film films[KD_JOB_FILMS]; /* oldest first */
    unsigned n_films;
    bool filming;           /* one is being encoded (films.c) */
    unsigned encoding;      /* frames that are drawn, and not yet in their files */
    uint64_t bytes;         /* of frames and films */
    unsigned revision;      /* of what its status says */
    char client[KD_CLIENT]; /* "": nobody knows any more */
    bool listed;
    bool creating;  /* its files are still being made: no frame of it is begun */
    bool unwritten; /* its record has changed since it was last written, */
    bool keeping;   /* and no frame is begun before it is written */
    bool measured;  /* the exposure in it is what keeps the frames waiting */
    bool forgotten; /* its request is off the disk */
    struct kd_job_glance glance;
    struct kd_job_watcher *watchers;
    struct kd_job *link;
};

struct kd_jobs {
    struct kd_jobs_params params;
    struct kd_job_store *store;
    bool temporary;          /* the store is opened when there is something to keep */
    pthread_mutex_t opening; /* held while that is done */
    pthread_mutex_t
        lock; /* for what follows; never held while a file is written or removed: the HTTP thread takes it */
    struct kd_turns_job writer;      /* of records (records.c) */
    bool writes, begun;              /* it is under way; other threads have the jobs */
    struct kd_job *first;            /* oldest first */
    struct kd_job *gone;             /* whose files are to be removed */
    struct kd_job_render *rendering; /* or being planned */
    struct kd_job *filming;          /* whose bodies are moved; NULL: no film's */
    unsigned behind;
    uint64_t bytes;
    uint64_t frames; /* finished here, of all */
    bool closed;
};

/* These are called with all->lock held where nothing else is said. */

double kd_job_now_s(void); /* since 1970 */

/* Whether a job is being rendered, or waits for it. */
static inline bool kd_job_is_active(const struct kd_job *job)
{
    return job->listed && job->record.state == KD_JOB_ACTIVE;
}
/* records.c: lets a worker write a job's record; what fails is logged. */
void kd_job_write(struct kd_job *job);
void kd_jobs_begin_writing(struct kd_jobs *all); /* if there is anything to write */
/* Likewise, and no frame of it is begun before that. */
void kd_job_keep(struct kd_job *job);
/* Writes what is left to be written. When nobody else has the jobs any more. */
void kd_jobs_write_all(struct kd_jobs *all);
void kd_job_strike(struct kd_job *job); /* counts, once a server, that work on it may be what ends the server */
void kd_job_end(struct kd_job *job, enum kd_job_state state, const char *why);
/* Makes a job wait, each time for longer, because something has run out that may be there again later. */
void kd_job_delay(struct kd_job *job, const char *why);
/* Takes the job off the list, whose reference is then the caller's; its files go with the last one, the request
 * first (kd_jobs_bury). */
void kd_job_unlist(struct kd_job *job);
void kd_job_wake(struct kd_job *job, double now); /* those whose wait is over */

/* A job of a spec, which it empties; not on the list yet. NULL: out of memory. Unlocked. */
struct kd_job *kd_job_make(struct kd_jobs *all, struct kd_job_spec *spec);
void kd_job_append(struct kd_jobs *all, struct kd_job *job); /* to the list, as the youngest */
/* resume.c, for kd_job_store_load: goes on with a job that the store knows; user: the jobs. Before any other thread
 * has them. */
void kd_job_resume(void *user, const struct kd_job_record *known, struct kd_buffer *request);

/* Remove files of jobs that are gone, at most so many. Unlocked, on one thread. */
void kd_jobs_bury(struct kd_jobs *all, unsigned files);

/* run.c: begin with the next frame if it is time for one. A worker plans it and hands it to the render queue. */
void kd_jobs_pump(struct kd_jobs *all);
/* The frame that no worker will plan any more. When nobody else has the jobs. */
void kd_jobs_drop_unplanned(struct kd_jobs *all);
/* Finds the job of a frame by what its render job hands to kd_job_glance; number may be NULL. Any thread. */
struct kd_job *kd_job_of_frame(const void *render, unsigned *number);
extern const struct kd_glance kd_job_glance;
/* A frame, or what it shows, has failed: for good, or until there is memory and room on the disk again. */
void kd_job_give_up(struct kd_job *job, const struct kd_error *error);
/* film.c: what a frame of a film shows, the job's; NULL: it is on its way, or another film is, and kd_jobs_pump is
 * called when it is there. KD_ENOMEM. */
enum kd_status kd_job_film_at(struct kd_job *job, unsigned frame, struct kd_crowd **out, struct kd_error *error);
/* Frees what is there of it, but for what a worker has, and lets another film be made. */
void kd_job_film_drop(struct kd_job *job);
/* Drops the frame of this job that is being rendered, if there is one; job NULL: of any job. */
void kd_jobs_drop_frame(struct kd_jobs *all, const struct kd_job *job);

#endif
