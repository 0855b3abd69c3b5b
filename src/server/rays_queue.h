/* Requests for rays: read, traced in slices by a few workers, and handed back. Requests take turns, a slice each, so that a
 * few rays do not wait for a million; what asks for an engine of the device goes through the render queue.
 *
 * Memory: bodies until they are read, which the server counts; answers from then on, which count here and may hold
 * `held_max` bytes together, or one of them more. */
#ifndef KD_SERVER_RAYS_QUEUE_H
#define KD_SERVER_RAYS_QUEUE_H

#include "render/rays_answer.h"
#include "render/rays_request.h"
#include "server/render_queue.h"

#include <stdatomic.h>

struct kd_rays_queue;

struct kd_rays_job {
    /* filled in by the submitter */
    struct kd_rays_request request; /* initialised; a body that is JSON is merged into it */
    const struct kd_buffer *body;
    bool npy;
    int socket;                            /* of the client; once it hangs up the job is dropped */
    void (*read)(struct kd_rays_job *job); /* on a worker: the body is not needed any more */
    void (*done)(struct kd_rays_job *job); /* on a worker: may free the job */
    void *user;
    /* the outcome: KD_ECANCELLED when dropped */
    enum kd_status status;
    struct kd_error error;
    bool malformed; /* KD_EINVAL because the body is no JSON document */
    struct kd_rays_answer answer;
    size_t held; /* bytes that count as held; the submitter gives them back */
    double queue_ms, read_ms, trace_ms;
    /* the queue's own */
    struct kd_rays_job *next;
    struct kd_rays_queue *queue;
    enum { KD_RAYS_NEW, KD_RAYS_TRACING, KD_RAYS_TRACED } state;
    bool listed;
    size_t begun;     /* rays handed to workers */
    unsigned workers; /* at work on it */
    double submitted_ms, traced_from_ms;
    struct kd_render_job device;
};

/* limit: unfinished requests. `held` is shared with others who count there. */
enum kd_status kd_rays_queue_create(unsigned limit, struct kd_render_queue *renders, _Atomic size_t *held,
                                    size_t held_max, struct kd_rays_queue **out, struct kd_error *error);
/* Nothing may be unfinished. Accepts NULL. */
void kd_rays_queue_destroy(struct kd_rays_queue *queue);

/* Whether one more fits: KD_EBUSY or KD_OK. The submitting thread. */
enum kd_status kd_rays_queue_admit(struct kd_rays_queue *queue, struct kd_error *error);
double kd_rays_queue_backlog_ms(struct kd_rays_queue *queue); /* estimated, of all that is accepted */
void kd_rays_queue_push(struct kd_rays_queue *queue, struct kd_rays_job *job);
unsigned kd_rays_queue_unfinished(struct kd_rays_queue *queue);

/* Drop everything: jobs notice at their next turn, as they do when their client has gone. Any thread. */
void kd_rays_queue_cancel(struct kd_rays_queue *queue);

#endif
