/* Finds the density at which matter at a radio frequency has a given flux (volume.normalise_to_jy), by rendering
 * small pictures. Only the thread that owns the renderer. */
#ifndef KD_RENDER_FRAME_NORMALISE_H
#define KD_RENDER_FRAME_NORMALISE_H

#include "render/frame/frame.h"

/* Multiplies the density of a scene that requests a flux, so that the picture has this flux. *scale: the factor; 1 if
 * no flux is requested. The factor is the same to the last bit for any size in pixels and any colours. It is also the
 * same for any time, unless the camera is at a finite radius and the matter is no series of grids. The search renders
 * about ten pictures of 48 pixels and two or three of 128, in the renderer's own buffers. progress is called between
 * these pictures. Returns KD_EINVAL at the field if there is no light, or if no density is bright enough. With
 * plan->light.reuse_normalisation, a density that was found earlier for the same matter is reused, even from another
 * viewpoint. */
enum kd_status kd_frame_normalise(struct kd_renderer *renderer, struct kd_scene *scene, const struct kd_plan *plan,
                                  kd_progress_fn progress, void *user, double *scale, struct kd_error *error);
/* Requests, for kd_kernels_note, the kernels of the pictures that kd_frame_normalise will render. */
enum kd_status kd_frame_normalise_ask(struct kd_renderer *renderer, const struct kd_scene *scene,
                                      const struct kd_plan *plan, struct kd_error *error);

#endif
