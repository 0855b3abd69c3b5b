/* Computes requests for rays. Workers parse a request. They trace its rays in slices on all free threads, or the
 * device traces them when the render queue permits. Workers then add up the results. */
#ifndef KD_SERVER_ANSWERS_RAYS_WORK_H
#define KD_SERVER_ANSWERS_RAYS_WORK_H

#include "server/render/task.h"

#include "render/rays/answer.h"
#include "render/rays/request.h"
#include "server/render/queue.h"

struct kd_rays_job {
    struct kd_task task;            /* must be the first member */
    struct kd_rays_request request; /* initialised when the job is made; a JSON body is merged into it */
    bool npy;                       /* the body is an array in NPY */
    /* results in addition to those of the task */
    bool malformed; /* KD_EINVAL because the body is not JSON */
    struct kd_rays_answer answer;
    double read_ms, trace_ms;
    /* private to the job */
    enum { KD_RAYS_NEW, KD_RAYS_HERE, KD_RAYS_ON_DEVICE } where;
    double traced_from_ms;
    _Atomic size_t begun; /* number of rays that workers have begun */
    struct kd_render_job device;
    size_t traced, turn; /* numbers of rays on the device: rays that are finished, and rays of the next call */
};

/* Makes a job. Set `request` and `npy`, then submit it. If the job is not admitted, sets *refused and returns NULL. */
struct kd_rays_job *kd_rays_job_begin(struct kd_request *request, enum MHD_Result *refused);

#endif
