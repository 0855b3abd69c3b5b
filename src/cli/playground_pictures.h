/* Pictures of a running playground, for the command line. Main thread only. */
#ifndef KD_CLI_PLAYGROUND_PICTURES_H
#define KD_CLI_PLAYGROUND_PICTURES_H

#include "cli/scene_options.h"
#include "playground/playground.h"
#include "render/output/format.h"
#include "render/render.h"

#include <stdint.h>

struct kd_pictures_asked {
    const struct kd_format *format; /* format of the pictures; NULL if path is NULL */
    /* path: file for one picture at the end. If `every` is set, it is a pattern with one %d, such as film/%05d.png.
     * NULL: no pictures are made. */
    const char *path;
    double every; /* time in M between two pictures, counted from the start; 0: one picture at the end */
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
    double ms; /* total render time of all pictures */
};

/* Returns KD_EINVAL if path is not valid. If `every` is set, the path must contain exactly one %d, as in printf.
 * Otherwise it must contain none. */
enum kd_status kd_pictures_check(const struct kd_pictures_asked *asked, struct kd_error *error);
/* Prepares rendering. view: JSON of the scene to use if no scene was given. If view is NULL as well, the default
 * scene is used, and the distance of its camera is chosen by the distance of the bodies. */
enum kd_status kd_pictures_begin(struct kd_pictures_asked *asked, const char *view, const struct kd_playground *p,
                                 struct kd_pictures *out, struct kd_error *error);
/* Renders the playground in its present state and writes the file. */
enum kd_status kd_pictures_take(struct kd_pictures *pictures, struct kd_playground *p, struct kd_error *error);
void kd_pictures_finish(struct kd_pictures *pictures);

#endif
