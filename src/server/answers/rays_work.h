/* Computes requests for rays. Workers parse a request. Its rays are traced either by workers, in slices on all free
 * threads, or by the device, when the render queue permits that. At the end workers add up the results. */
#ifndef KD_SERVER_ANSWERS_RAYS_WORK_H
#define KD_SERVER_ANSWERS_RAYS_WORK_H

#include "server/render/task.h"

#include "render/rays/answer.h"
#include "render/rays/request.h"
#include "server/render/queue.h"

struct kd_rays_job {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    /* initialised when the job is made; the members of a JSON body are merged into it */
    struct kd_rays_request request;
    bool npy; /* true if the body is an NPY array */
    /* The members up to trace_ms are results, in addition to those of the task. */
    bool malformed; /* true if a status KD_EINVAL means that the body is not JSON */
    struct kd_rays_answer answer;
    double read_ms, trace_ms;
    /* The following members are private to the job. */
    enum { KD_RAYS_NEW, KD_RAYS_HERE, KD_RAYS_ON_DEVICE } where;
    double traced_from_ms;
    _Atomic size_t begun; /* number of rays that workers have started */
    struct kd_render_job device;
    /* for rays on the device: traced: number of finished rays; turn: number of rays in the next call */
    size_t traced, turn;
};

/* Makes a job. The caller then sets `request` and `npy`, and submits the job. If the job is not admitted, sets
 * *refused and returns NULL. */
struct kd_rays_job *kd_rays_job_begin(struct kd_request *request, enum MHD_Result *refused);

#endif
