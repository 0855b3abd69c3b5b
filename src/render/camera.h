/* From the camera of a scene to the constants from which a kernel makes each ray. Double precision, pure, any thread. */
#ifndef KD_RENDER_CAMERA_H
#define KD_RENDER_CAMERA_H

#include "render/layout.h"
#include "scene/scene.h"

/* Everything but the rows of a slice (row0, rows, band0, stride). The scene must be valid. */
struct kd_camera_push kd_camera_push(const struct kd_scene *scene);

#endif
