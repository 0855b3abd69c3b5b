/* Computes a request for rays: the workers parse it, trace it in slices on as many threads as are free, or on the
 * device at each turn that the render queue gives it, and sum it up. */
#ifndef KD_SERVER_ANSWERS_RAYS_WORK_H
#define KD_SERVER_ANSWERS_RAYS_WORK_H

#include "server/render/task.h"

#include "render/rays/answer.h"
#include "render/rays/request.h"
#include "server/render/queue.h"

struct kd_rays_job {
    struct kd_task task;            /* first */
    struct kd_rays_request request; /* initialised; a body that is JSON is merged into it */
    bool npy;                       /* the body */
    /* the outcome, beside the task's */
    bool malformed; /* KD_EINVAL because the body is no JSON document */
    struct kd_rays_answer answer;
    double read_ms, trace_ms;
    /* its own */
    enum { KD_RAYS_NEW, KD_RAYS_HERE, KD_RAYS_ON_DEVICE } where;
    double traced_from_ms;
    _Atomic size_t begun; /* rays handed to workers */
    struct kd_render_job device;
    size_t traced, turn; /* rays, on the device: so far, and those of the next turn */
};

/* To be filled in, `request` and `npy`, and submitted. NULL: the client has been told why not, *refused. */
struct kd_rays_job *kd_rays_job_begin(struct kd_request *request, enum MHD_Result *refused);

#endif
