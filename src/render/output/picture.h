/* A frame as a PNG file that can be rendered again from itself, and back. Any thread.
 *
 * Text chunks: "kerrd:scene" (canonical JSON), "kerrd:hash", "kerrd:version", "kerrd:approximations"
 * (one a line), "kerrd:accuracy" (as kd_accuracy_text), "kerrd:device", "Software". */
#ifndef KD_RENDER_OUTPUT_PICTURE_H
#define KD_RENDER_OUTPUT_PICTURE_H

#include "base/buffer.h"
#include "render/frame/frame.h"

/* One line: "rays=921600 engine=mino-rkn6 precision=f32 steps=8 undecided=0 sampled=768 crossings=927 differ=0 median=1.6e-07
 * worst=2.0e-05"; without the last four where nothing was sampled. */
#define KD_ACCURACY_TEXT 200
void kd_accuracy_text(const struct kd_accuracy_report *report, const struct kd_plan *plan, char out[KD_ACCURACY_TEXT]);

/* compression: as kd_png_params. */
enum kd_status kd_picture_encode(const struct kd_frame *frame, const struct kd_scene *scene,
                                 const struct kd_plan *plan, const char *device, int compression,
                                 struct kd_buffer *png, struct kd_error *error);

/* The scene inside a picture made by kd_picture_encode; KD_EINVAL if there is none. */
enum kd_status kd_picture_scene(const void *png, size_t size, struct kd_scene *out, struct kd_error *error);

#endif
