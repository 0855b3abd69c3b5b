/* Links to scenes. A link contains the scene's difference from a preset, as in
 * "preset=gargantua&spacetime.spin=0.5". This is also the form of the query of GET /v1/render and of the page's
 * address. A link does not contain the size of the picture. Pure, any thread. */
#ifndef KD_SCENE_LINK_H
#define KD_SCENE_LINK_H

#include "scene/scene.h"

/* Appends the shortest of all links from a preset or from the default scene, and a NUL that out->size does not
 * count. Equal scenes have equal links; the link of the default scene is "". Returns KD_EINVAL with a pointer if the
 * scene names an asset. The only other error is KD_ENOMEM. */
enum kd_status kd_scene_link(const struct kd_scene *scene, struct kd_buffer *out, struct kd_error *error);

/* Checks that a scene uses no asset, because the server that reads the link may not have this asset. */
enum kd_status kd_scene_link_check(const struct kd_scene *scene, struct kd_error *error);

/* Describes n changed fields of a link in readable form, as in "camera inclination 60°, camera r 30 M and 3 more". */
struct kd_scene_changed { const char *path, *value; };
enum kd_status kd_scene_link_tell(const struct kd_scene_changed *changed, size_t n, struct kd_buffer *out);

/* Turns the scene of a link into that of its preview: one eye, no tile, 8 bits per channel, and 2 x 2 rays per
 * pixel. If a volume or jets shine, it has 1 ray per pixel and the profile "draft". width and height are in pixels;
 * width / height must be at least 16 / 9, the aspect ratio of the presets. */
void kd_scene_link_preview(struct kd_scene *scene, int32_t width, int32_t height);

#endif
