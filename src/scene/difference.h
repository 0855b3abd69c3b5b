/* Describes a scene by its difference from another one, in the form of --set and of queries. Pure, any thread. */
#ifndef KD_SCENE_DIFFERENCE_H
#define KD_SCENE_DIFFERENCE_H

#include "scene/scene.h"

/* Appends the difference, such as "style.name=film spacetime.spin=0.99 camera.r=40". `between` is the separator. If
 * these fields are applied in this order to *base, the result is *scene. Returns KD_EINVAL, with *out unchanged, if
 * no such difference exists: a list of *base is longer, or *scene names an asset by an unresolved name. The only
 * other error is KD_ENOMEM. */
enum kd_status kd_scene_difference(const struct kd_scene *base, const struct kd_scene *scene, char between,
                                   struct kd_buffer *out);

/* Appends the difference from the default scene, separated by blanks. If there is no difference, appends "the
 * default scene". */
enum kd_status kd_scene_line(const struct kd_scene *scene, struct kd_buffer *out);

#endif
