/* Describes one scene by its difference from another, in the form of --set and of queries. Pure, any thread. */
#ifndef KD_SCENE_DIFFERENCE_H
#define KD_SCENE_DIFFERENCE_H

#include "scene/scene.h"

/* Appends "style.name=film spacetime.spin=0.99 camera.r=40", with `between` between. Set in this order these fields
 * make *scene of *base. KD_EINVAL, with *out as it was: no fields do, because a list of *base is longer, or *scene
 * names an asset by a name that nobody has resolved. KD_ENOMEM. */
enum kd_status kd_scene_difference(const struct kd_scene *base, const struct kd_scene *scene, char between,
                                   struct kd_buffer *out);

/* Appends what differs from the default scene, with blanks between, or "the default scene". */
enum kd_status kd_scene_line(const struct kd_scene *scene, struct kd_buffer *out);

#endif
