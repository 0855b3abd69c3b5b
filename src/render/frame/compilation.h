/* Compiles kernels while other work has the device.
 *
 * A driver compiles a kernel when its pipeline is created, or at its first dispatch on the device's queue (lavapipe:
 * half a second to some seconds). So pipelines are created beside the device. For a driver of the second kind, the
 * picture is also rendered (or other work that needs the kernels dispatched) on a second device that computes nothing
 * (kd_vk_params.compiles_only). That fills the driver's cache on disk, from which the first device then reads. */
#ifndef KD_RENDER_FRAME_COMPILATION_H
#define KD_RENDER_FRAME_COMPILATION_H

#include "render/frame/frame.h"

struct kd_compilation;

/* Asks for kernels, as whoever needs them will (kd_kernels_note). */
typedef enum kd_status (*kd_kernels_ask_fn)(struct kd_renderer *renderer, const void *user);

/* Of the kernels that the device lacks among those that are asked for. NULL: it has all. By who has the device. */
struct kd_compilation *kd_compilation_of(struct kd_renderer *renderer, kd_kernels_ask_fn ask, const void *user);
/* Of those that it lacks for a picture, and that take long. */
struct kd_compilation *kd_compilation_begin(struct kd_renderer *renderer, const struct kd_scene *scene,
                                            const struct kd_plan *plan);
/* Any thread; the renderer must not be closed or reopened meanwhile. What goes wrong is left to who renders. progress
 * returns false to stop it soon. KD_EDEVICE: the device beside hangs, as in kd_renderer_hangs. */
enum kd_status kd_compilation_run(struct kd_compilation *compilation, kd_progress_fn progress, void *user,
                                  struct kd_error *error);
/* Hands the kernels to the renderer, and frees it. By who has the device. */
void kd_compilation_end(struct kd_compilation *compilation);

/* In the midst of a picture, where nothing is recorded: has kernels that it lacks compiled, by whoever the renderer
 * tells (kd_renderer_params.lacks). KD_ECANCELLED: it is to begin once more. */
struct kd_frame_job;
enum kd_status kd_frame_await_kernels(struct kd_frame_job *job, kd_kernels_ask_fn ask, const void *user);

void kd_compilation_drop(struct kd_compilation *compilation); /* frees one that was not run. Any thread */

/* Whether this is of any use with this device; the log says why it is not, where that can be mended. */
bool kd_compilation_helps(const struct kd_renderer *renderer);

#endif
