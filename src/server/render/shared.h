/* Scenes of shared links: /s/CODE, where CODE decodes to the text of a link (scene/link.h). A link of two pictures
 * side by side also has the fields in which the right picture differs, such as "pair.spacetime.spin=0.998", in the
 * same form as in the page's address. HTTP thread. */
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

#define KD_SHARED_PAIR "pair"
#define KD_SHARED_DATA "data"

struct kd_shared_scenes {
    struct kd_scene left, right; /* right: equal to left, unless the link is a pair */
    bool measured;               /* the right side shows measurements of M87* in place of a picture (pair.data=1) */
};

/* Decodes and validates scenes. Returns false with *problem filled; its texts are in *error. The status is 404 if the
 * code is malformed, and 422 if a scene is not valid or uses an asset. */
bool kd_shared_read(const char *code, struct kd_shared_scenes *scenes, struct kd_problem *problem,
                    struct kd_error *error);

/* Builds the scenes from the request's scene and its parameter "pair", a query of the fields that differ on the
 * right. In all other respects it works like kd_shared_read. */
bool kd_shared_of_request(const struct kd_request *request, struct kd_shared_scenes *scenes, struct kd_problem *problem,
                          struct kd_error *error);

/* Builds the scene of a preview picture from the request's path and the width in its query. For a pair, it shows the
 * picture on the left. */
bool kd_shared_preview(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                       struct kd_error *error);

#endif
