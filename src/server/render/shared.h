/* Shared scenes: the code of /s/CODE, decoded, is the text of a link (scene/link.h). HTTP thread. */
#ifndef KD_SERVER_RENDER_SHARED_H
#define KD_SERVER_RENDER_SHARED_H

#include "scene/scene.h"
#include "server/http/problem.h"
#include "server/http/request.h"

/* The size of the picture that other sites show, as Open Graph asks for it; a narrower one has the same shape. */
enum { KD_SHARED_WIDTH = 1200, KD_SHARED_HEIGHT = 630, KD_SHARED_NARROWEST = 64 };
#define KD_SHARED_WIDTH_NAME "width"
static inline int32_t kd_shared_height(int32_t width)
{
    return (width * KD_SHARED_HEIGHT + KD_SHARED_WIDTH / 2) / KD_SHARED_WIDTH;
}

/* Reads the valid scene of a code. False with *problem filled, its texts in *error: 404 for what is no code, 422 for
 * a scene that is not valid, or names an asset. */
bool kd_shared_read(const char *code, struct kd_scene *scene, struct kd_problem *problem, struct kd_error *error);

/* Reads the scene of the picture that the path of a request names, as wide as its query says. */
bool kd_shared_preview(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                       struct kd_error *error);

#endif
