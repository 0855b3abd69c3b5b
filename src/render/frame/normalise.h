/* Finds the density at which matter at a radio frequency has a given flux, volume.normalise_to_jy, by pictures
 * of its own. The thread that has the renderer. */
#ifndef KD_RENDER_FRAME_NORMALISE_H
#define KD_RENDER_FRAME_NORMALISE_H

#include "render/frame/frame.h"

/* Multiplies the density of a scene that asks for it, and says by what; 1 where it does not. The same scene has the
 * same to the bit, whatever its size in pixels, its colours and its time. Some ten pictures of 48 pixels, and two or
 * three of 128, in the renderer's own buffers; progress is asked between them. KD_EINVAL names the field: there is
 * no light, or none so bright. With
 * plan->held a density that was found for the same matter before will do, from wherever it was seen. */
enum kd_status kd_frame_normalise(struct kd_renderer *renderer, struct kd_scene *scene, const struct kd_plan *plan,
                                  kd_progress_fn progress, void *user, double *scale, struct kd_error *error);
/* Asks for the kernels that those pictures take, as far as they will be rendered: for kd_kernels_note. */
enum kd_status kd_frame_normalise_ask(struct kd_renderer *renderer, const struct kd_scene *scene,
                                      const struct kd_plan *plan, struct kd_error *error);

#endif
