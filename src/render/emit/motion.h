/* Which parts of a scene move by themselves in a live session, by emitter (emitter.h). Pure; any thread. */
#ifndef KD_RENDER_EMIT_MOTION_H
#define KD_RENDER_EMIT_MOTION_H

#include "scene/scene.h"

#include <stdbool.h>

enum kd_varies {
    KD_MOVES_WITH_TIME = 1, /* something is elsewhere a moment later */
    KD_DIMS_WITH_TIME = 2,  /* light alone changes: each pixel keeps what it shows */
    KD_MOVES_WITH_AZIMUTH = 4,
    KD_MOVES_BY_FALL = 8, /* the camera's radius does, whatever there is to see */
};

/* What a picture of the scene would show of another time or azimuth, whether they go on or not: enum kd_varies. */
unsigned kd_emit_varies(const struct kd_scene *scene);
/* Says whether anything that can be seen changes, by the scene's rates. */
bool kd_emit_moves(const struct kd_scene *scene);
/* Says whether all that changes is light that grows or fades, and nothing moves. */
bool kd_emit_only_dims(const struct kd_scene *scene);

#endif
