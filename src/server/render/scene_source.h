/* Finds the scene that a request asks for, in its query and body. HTTP thread. */
#ifndef KD_SERVER_RENDER_SCENE_SOURCE_H
#define KD_SERVER_RENDER_SCENE_SOURCE_H

#include "server/http/problem.h"
#include "server/http/request.h"
#include "scene/scene.h"

/* No name twice, and without `fields` none but preset and the route's own, each NULL: it has none. KD_EINVAL with a
 * pointer. */
enum kd_status kd_scene_query_check(const struct kd_target *target, bool fields, const char *const own[2],
                                    struct kd_error *error);

/* Makes the scene that a query names, as GET /v1/render has it: defaults, preset, fields but for the route's own
 * parameters. Assets are not looked up and nothing is validated. KD_EINVAL with a pointer. */
enum kd_status kd_scene_of_query(const struct kd_target *target, const char *const own[2], struct kd_scene *scene,
                                 struct kd_error *error);

/* Defaults, then ?preset=NAME, then (POST) the body or (GET) the query's fields but for the route's own parameter;
 * validated. False with *problem filled, its texts in *error. */
bool kd_scene_of_request(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                         struct kd_error *error);

#endif
