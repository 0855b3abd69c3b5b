/* Scenes of shared links /s/CODE. CODE is the encoded text of a link (scene/link.h). A link of two pictures side by
 * side also has the fields in which the right picture differs, such as "pair.spacetime.spin=0.998", in the same form
 * as in the page's address. HTTP thread. */
#ifndef KD_SERVER_RENDER_SHARED_H
#define KD_SERVER_RENDER_SHARED_H

#include "scene/scene.h"
#include "server/http/problem.h"
#include "server/http/request.h"

/* Size of the picture for other sites, as recommended for Open Graph. A narrower picture has the same aspect ratio. */
enum { KD_SHARED_WIDTH = 1200, KD_SHARED_HEIGHT = 630, KD_SHARED_NARROWEST = 64 };
#define KD_SHARED_WIDTH_NAME "width"
static inline int32_t kd_shared_height(int32_t width)
{
    return (width * KD_SHARED_HEIGHT + KD_SHARED_WIDTH / 2) / KD_SHARED_WIDTH;
}

#define KD_SHARED_PAIR "pair"
#define KD_SHARED_DATA "data"

struct kd_shared_scenes {
    struct kd_scene left, right; /* right: equal to left, unless the link has two pictures */
    /* true if the right side shows measurements of M87* instead of a picture (pair.data=1) */
    bool measured;
};

/* Decodes the code, and validates the scenes. If it returns false, it has filled *problem, whose texts are in
 * *error. The status is 404 if the code is malformed, and 422 if a scene is not valid or uses an asset. */
bool kd_shared_read(const char *code, struct kd_shared_scenes *scenes, struct kd_problem *problem,
                    struct kd_error *error);

/* Builds the scenes from the scene of the request and its parameter "pair", which is a query of the fields that
 * differ on the right. Otherwise like kd_shared_read. */
bool kd_shared_of_request(const struct kd_request *request, struct kd_shared_scenes *scenes, struct kd_problem *problem,
                          struct kd_error *error);

/* Builds the scene of a preview picture from the path of the request and the width in its query. For two pictures,
 * the preview shows the left one. */
bool kd_shared_preview(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                       struct kd_error *error);

#endif
