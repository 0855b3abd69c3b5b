/* Plans the scene of a request. Large bodies and pictures of many pixels are planned by the workers, since the HTTP
 * thread serves every client. HTTP thread. */
#ifndef KD_SERVER_RENDER_PLANNED_H
#define KD_SERVER_RENDER_PLANNED_H

#include "server/render/task.h"
#include "render/render.h"
#include "scene/scene.h"

struct kd_planned {
    struct kd_task task;   /* first member */
    struct kd_scene scene; /* as requested */
    struct kd_scene drawn; /* the scene that the plan is for: kd_format_plan */
    char hash[65];         /* of `scene`; set when an answer is tagged by it */
    struct kd_plan plan;
    struct kd_problem problem; /* points to texts in the task's error */
};

/* Returns the plan, or NULL: then *result is the handler's result, which has either refused or will be called again
 * when the workers are done. Owned by the request. */
struct kd_planned *kd_planned_of(struct kd_request *request, enum MHD_Result *result);

#endif
