/* Compiles kernels while other work uses the device.
 *
 * Some drivers compile a kernel when its pipeline is created. Others, such as lavapipe, compile it at its first
 * dispatch on the device's queue, which takes half a second to some seconds. So pipelines are created while the device
 * works. For a driver of the second kind, the work that needs the kernels is also run on a second device that computes
 * nothing (kd_vk_params.compiles_only). This run fills the driver's cache on disk, from which the first device then
 * reads. */
#ifndef KD_RENDER_FRAME_COMPILATION_H
#define KD_RENDER_FRAME_COMPILATION_H

#include "render/frame/frame.h"

struct kd_compilation;

/* Requests the same kernels that the work will need (kd_kernels_note). */
typedef enum kd_status (*kd_kernels_ask_fn)(struct kd_renderer *renderer, const void *user);

/* Makes a compilation of the requested kernels that the device lacks. Returns NULL if the device has all of them, if
 * `ask` fails, or if memory is short. Called only by the thread that owns the device. */
struct kd_compilation *kd_compilation_of(struct kd_renderer *renderer, kd_kernels_ask_fn ask, const void *user);
/* Like kd_compilation_of, for the kernels of a picture that take long to compile. */
struct kd_compilation *kd_compilation_begin(struct kd_renderer *renderer, const struct kd_scene *scene,
                                            const struct kd_plan *plan);
/* Compiles the kernels. Any thread; the renderer must not be closed or reopened meanwhile. An error of a kernel is
 * reported by the render that needs the kernel. If progress returns false, the compilation stops soon. Returns
 * KD_EDEVICE if the second device hangs, as in kd_renderer_hangs. */
enum kd_status kd_compilation_run(struct kd_compilation *compilation, kd_progress_fn progress, void *user,
                                  struct kd_error *error);
/* Adds the kernels to the renderer's cache, and frees the compilation. Called only by the thread that owns the
 * device. */
void kd_compilation_end(struct kd_compilation *compilation);

/* Has missing kernels compiled through kd_renderer_params.lacks. Called during a picture, while nothing is recorded.
 * After KD_ECANCELLED the picture must start again. */
struct kd_frame_job;
enum kd_status kd_frame_await_kernels(struct kd_frame_job *job, kd_kernels_ask_fn ask, const void *user);

void kd_compilation_drop(struct kd_compilation *compilation); /* frees a compilation that was not run; any thread */

/* True if compiling in advance is of use with this device. If not, the log says why, and what the user can change. */
bool kd_compilation_helps(const struct kd_renderer *renderer);

#endif
