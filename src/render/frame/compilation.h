/* Compiles the kernels of a picture while others have the device.
 *
 * A driver compiles a kernel as its pipeline is made, or at its first dispatch, on the device's queue (lavapipe, half a
 * second to some seconds). So pipelines are made beside the device. For a driver of the second kind the picture is also
 * rendered on a device of its own that computes nothing (kd_vk_params.compiles_only): what is compiled there goes to
 * the driver's files, and the picture's device reads it from there. */
#ifndef KD_RENDER_FRAME_COMPILATION_H
#define KD_RENDER_FRAME_COMPILATION_H

#include "render/frame/frame.h"

struct kd_compilation;

/* Of the kernels that the device lacks for a picture. NULL: it has all that are looked for, those that take long. By
 * who has the device. */
struct kd_compilation *kd_compilation_begin(struct kd_renderer *renderer, const struct kd_scene *scene,
                                            const struct kd_plan *plan);
/* Any thread; the renderer must not be closed or reopened meanwhile. What goes wrong is left to who renders. progress
 * returns false to stop it soon. KD_EDEVICE: the device beside hangs, as in kd_renderer_hangs. */
enum kd_status kd_compilation_run(struct kd_compilation *compilation, kd_progress_fn progress, void *user,
                                  struct kd_error *error);
/* Hands the kernels to the renderer, and frees it. By who has the device. */
void kd_compilation_end(struct kd_compilation *compilation);

void kd_compilation_drop(struct kd_compilation *compilation); /* frees one that was not run. Any thread */

/* Whether this is of any use with this device; the log says why it is not, where that can be mended. */
bool kd_compilation_helps(const struct kd_renderer *renderer);

#endif
