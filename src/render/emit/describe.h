/* Describes the emitters of a scene in words. Pure functions of valid scenes, any thread. */
#ifndef KD_RENDER_EMIT_DESCRIBE_H
#define KD_RENDER_EMIT_DESCRIBE_H

#include "base/buffer.h"
#include "scene/scene.h"

/* Writes the scene's emitters as JSON: a list of {"name", "title": common name, "at": "crossing", "end", "along", "met"
 * or "" (the emitter emits nothing itself), "apart": true if its light is kept separate, "sentence": how it appears, if
 * the emitter has such a sentence}. */
enum kd_status kd_emit_to_json(const struct kd_scene *scene, struct kd_buffer *out);

#endif
