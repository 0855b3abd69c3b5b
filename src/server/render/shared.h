/* Scenes of shared links: /s/CODE, where CODE decodes to the text of a link (scene/link.h). HTTP thread. */
#ifndef KD_SERVER_RENDER_SHARED_H
#define KD_SERVER_RENDER_SHARED_H

#include "scene/scene.h"
#include "server/http/problem.h"
#include "server/http/request.h"

/* Size of the picture for other sites, as Open Graph recommends. A narrower picture has the same aspect ratio. */
enum { KD_SHARED_WIDTH = 1200, KD_SHARED_HEIGHT = 630, KD_SHARED_NARROWEST = 64 };
#define KD_SHARED_WIDTH_NAME "width"
static inline int32_t kd_shared_height(int32_t width)
{
    return (width * KD_SHARED_HEIGHT + KD_SHARED_WIDTH / 2) / KD_SHARED_WIDTH;
}

/* Decodes and validates a scene. Returns false with *problem filled; its texts are in *error. The status is 404 if
 * the code is malformed, and 422 if the scene is not valid or uses an asset. */
bool kd_shared_read(const char *code, struct kd_scene *scene, struct kd_problem *problem, struct kd_error *error);

/* Builds the scene of a preview picture from the request's path and the width in its query. */
bool kd_shared_preview(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                       struct kd_error *error);

#endif
