/* Describes the emitters of a scene: their names, and what is seen of them in words. Pure functions of valid scenes,
 * any thread. */
#ifndef KD_RENDER_EMIT_TOLD_H
#define KD_RENDER_EMIT_TOLD_H

#include "base/buffer.h"
#include "scene/scene.h"

/* Writes those that the scene has as JSON, a list of
 *   {"name", "title": what it is called, "at": "crossing", "end" or "" (which shines nowhere by itself),
 *    "apart": true where its light is kept apart, "sentence": what is seen, where there is something to say}. */
enum kd_status kd_emit_to_json(const struct kd_scene *scene, struct kd_buffer *out);

#endif
