/* Pictures of a playground while it goes on, for the command line. Main thread only. */
#ifndef KD_CLI_PLAYGROUND_PICTURES_H
#define KD_CLI_PLAYGROUND_PICTURES_H

#include "cli/scene_options.h"
#include "playground/playground.h"
#include "render/output/format.h"
#include "render/render.h"

#include <stdint.h>

/* What is asked for. */
struct kd_pictures_asked {
    const struct kd_format *format; /* NULL without a path */
    const char *path; /* of one picture at the end, or with `every` a pattern with one %d, such as film/%05d.png; NULL:
                         none are asked for */
    double every;     /* M between pictures, from the begin on; 0: there is one */
    struct kd_scene_options scene;
    const char *device;
    uint64_t memory;
    bool stats;
};

struct kd_pictures {
    struct kd_pictures_asked *asked;
    struct kd_assets assets;
    struct kd_scene scene;
    struct kd_renderer *renderer;
    const struct kd_format *format;
    struct kd_encoder encoder;
    unsigned made;
    double ms; /* of rendering all of them */
};

/* KD_EINVAL, saying so, where path is no name for pictures: with `every` it has one %d, as printf takes it, without
 * it none. */
enum kd_status kd_pictures_check(const struct kd_pictures_asked *asked, struct kd_error *error);
/* view: JSON of a scene that shows this playground, for whoever names none; NULL: the default scene, as far as its
 * bodies are. */
enum kd_status kd_pictures_begin(struct kd_pictures_asked *asked, const char *view, const struct kd_playground *p,
                                 struct kd_pictures *out, struct kd_error *error);
/* Renders the playground as it is now, and writes the file. */
enum kd_status kd_pictures_take(struct kd_pictures *pictures, struct kd_playground *p, struct kd_error *error);
void kd_pictures_finish(struct kd_pictures *pictures);

#endif
