/* What goes on by itself in a live session, as the emitters have it (emitter.h). Pure; any thread. */
#ifndef KD_RENDER_EMIT_MOTION_H
#define KD_RENDER_EMIT_MOTION_H

#include "scene/scene.h"

#include <stdbool.h>

/* Whether anything that can be seen changes, by the scene's rates. */
bool kd_emit_moves(const struct kd_scene *scene);
/* Whether all that changes is light that grows or fades: nothing moves. */
bool kd_emit_only_dims(const struct kd_scene *scene);

#endif
