/* Builds the scene of a request from its query and its body. HTTP thread. */
#ifndef KD_SERVER_RENDER_SCENE_SOURCE_H
#define KD_SERVER_RENDER_SCENE_SOURCE_H

#include "server/http/problem.h"
#include "server/http/request.h"
#include "scene/scene.h"

/* Checks a query, in which each name may occur only once. If `fields` is false, only preset and the route's own
 * parameters are permitted. route may be NULL. Returns KD_EINVAL with a pointer. */
enum kd_status kd_scene_query_check(const struct kd_target *target, bool fields, const struct kd_route *route,
                                    struct kd_error *error);

/* Builds a scene from a query, as in GET /v1/render: first the defaults, then the preset, then the fields. The
 * route's own parameters are ignored. Assets are not resolved, and the scene is not validated. Returns KD_EINVAL
 * with a pointer. */
enum kd_status kd_scene_of_query(const struct kd_target *target, const struct kd_route *route, struct kd_scene *scene,
                                 struct kd_error *error);

/* Builds the scene from the defaults, then ?preset=NAME, and then the body (POST) or the fields of the query (GET).
 * Validates it. If it returns false, it has filled *problem, whose texts are in *error. */
bool kd_scene_of_request(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                         struct kd_error *error);

#endif
