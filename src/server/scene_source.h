/* The scene that a request asks for, from its query and body. HTTP thread. */
#ifndef KD_SERVER_SCENE_SOURCE_H
#define KD_SERVER_SCENE_SOURCE_H

#include "server/problem.h"
#include "server/request.h"

/* Defaults, then ?preset=NAME, then (POST) the body or (GET) the query's fields; validated. False with
 * *problem filled, its texts in *error. */
bool kd_scene_of_request(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                         struct kd_error *error);

#endif
