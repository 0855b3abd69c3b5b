/* A scene is told in one line, by what differs from the default one. Any thread. */
#ifndef KD_CLI_SCENE_LINE_H
#define KD_CLI_SCENE_LINE_H

#include "scene/scene.h"

/* Appends "spacetime.spin=0.99 camera.r=40", as --set takes them, or "the default scene". KD_ENOMEM. */
enum kd_status kd_scene_line(const struct kd_scene *scene, struct kd_buffer *out);

#endif
