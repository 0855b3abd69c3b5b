/* kd_format_png: a PNG file that holds its scene, so that it can be rendered again. Any thread.
 *
 * Text chunks: "kerrd:scene" (canonical JSON), "kerrd:hash", "kerrd:version", "kerrd:approximations" (one a line),
 * "kerrd:accuracy" (as kd_accuracy_text), "kerrd:device", "Software", and "Copyright" if the picture contains others'
 * work. With KD_EFFORT_LIVE the file has none of these chunks. */
#ifndef KD_RENDER_OUTPUT_PNG_H
#define KD_RENDER_OUTPUT_PNG_H

#include "render/output/format.h"

/* Encodes like kd_format_png, with a compression as in kd_png_params. */
enum kd_status kd_png_of_picture(const struct kd_picture *picture, int compression, struct kd_buffer *out,
                                 struct kd_error *error);

#endif
