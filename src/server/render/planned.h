/* Plans the scene of a request. Large bodies, and pictures with many pixels, are planned by workers, because the
 * HTTP thread serves all clients. HTTP thread. */
#ifndef KD_SERVER_RENDER_PLANNED_H
#define KD_SERVER_RENDER_PLANNED_H

#include "server/render/task.h"
#include "render/render.h"
#include "scene/scene.h"

struct kd_planned {
    struct kd_task task;            /* must be first: callbacks cast its address to this struct */
    struct kd_scene scene;          /* the scene that was requested */
    struct kd_scene drawn;          /* the scene that is rendered, to which the plan belongs (kd_format_plan) */
    const struct kd_format *format; /* format of the answer, one of request->accepts; NULL: the answer is no picture */
    char hash[65];                  /* hash of `scene`, which is set when the ETag is made */
    struct kd_plan plan;
    struct kd_problem problem; /* its texts point into the task's error */
};

/* Returns the plan, which the request owns. If it returns NULL, the handler must return *result: either the request
 * is refused, or workers make the plan first and the handler is called again afterwards. */
struct kd_planned *kd_planned_of(struct kd_request *request, enum MHD_Result *result);

#endif
