/* The parts of a scene that move by themselves in a live session, by emitter (emitter.h). Pure; any thread. */
#ifndef KD_RENDER_EMIT_MOTION_H
#define KD_RENDER_EMIT_MOTION_H

#include "scene/scene.h"

#include <stdbool.h>

enum kd_varies {
    KD_MOVES_WITH_TIME = 1, /* something moves */
    KD_DIMS_WITH_TIME = 2,  /* only the brightness changes with time; each pixel keeps showing the same object */
    KD_MOVES_WITH_AZIMUTH = 4,
    KD_MOVES_BY_FALL = 8, /* the camera falls, so its radius changes; independent of emitters */
};

/* Returns flags of enum kd_varies: what would change in the picture at another time or azimuth. The scene's rates of
 * change are ignored, even if they are 0. */
unsigned kd_emit_varies(const struct kd_scene *scene);
/* True if anything visible changes with time at the scene's rates. */
bool kd_emit_moves(const struct kd_scene *scene);
/* True if only brightness changes and nothing moves. */
bool kd_emit_only_dims(const struct kd_scene *scene);

#endif
