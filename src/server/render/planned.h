/* Plans the scene of a request. Large bodies and pictures of many pixels are planned by the workers, since the HTTP
 * thread serves every client. HTTP thread. */
#ifndef KD_SERVER_RENDER_PLANNED_H
#define KD_SERVER_RENDER_PLANNED_H

#include "server/render/task.h"
#include "render/render.h"
#include "scene/scene.h"

struct kd_planned {
    struct kd_task task;   /* first */
    struct kd_scene scene; /* as asked, */
    struct kd_scene drawn; /* and as the plan is for: kd_format_plan */
    char hash[65];         /* of `scene`, once an answer is tagged by it */
    struct kd_plan plan;
    struct kd_problem problem; /* its texts in the task's error */
};

/* NULL: *result is the handler's, which either has refused or is called again when the workers are done. Owned by
 * the request. */
struct kd_planned *kd_planned_of(struct kd_request *request, enum MHD_Result *result);

#endif
