/* Plans the scene of a request. If its body is large or its picture has many pixels, workers plan it, because the HTTP
 * thread serves every client. HTTP thread. */
#ifndef KD_SERVER_RENDER_PLANNED_H
#define KD_SERVER_RENDER_PLANNED_H

#include "server/render/task.h"
#include "render/render.h"
#include "scene/scene.h"

struct kd_planned {
    struct kd_task task;            /* must be the first member */
    struct kd_scene scene;          /* the scene that was requested */
    struct kd_scene drawn;          /* the scene that is rendered and that the plan is for (kd_format_plan) */
    const struct kd_format *format; /* of the answer, from request->accepts; NULL: no picture */
    char hash[65];                  /* hash of `scene`; set when the ETag is made from it */
    struct kd_plan plan;
    struct kd_problem problem; /* points to texts in the task's error */
};

/* Returns the plan, which the request owns. Returns NULL if the request is refused or workers must plan it first. Then
 * *result is what the handler must return; in the second case it will be called again. */
struct kd_planned *kd_planned_of(struct kd_request *request, enum MHD_Result *result);

#endif
