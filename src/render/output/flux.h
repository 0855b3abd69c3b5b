/* Writes the flux of a picture at a radio frequency, for answers. Any thread. */
#ifndef KD_RENDER_OUTPUT_FLUX_H
#define KD_RENDER_OUTPUT_FLUX_H

#include "render/frame/frame.h"

/* Flux of the whole picture in Jy, for the scene's spacetime.mass_msun and spacetime.distance_pc; NAN unless
 * kd_scene_is_radio_alone. */
double kd_flux_jy(const struct kd_scene *scene, const struct kd_frame *frame);

/* One line: "jy=2.0412 ghz=230 kelvin=1e+10"; "" if there is no flux. kelvin: brightness temperature of the unit of
 * light. With volume.normalise_to_jy the line ends with the factor applied to the density, such as "
 * density_scale=0.79". */
#define KD_FLUX_TEXT 128
void kd_flux_text(const struct kd_scene *scene, const struct kd_frame *frame, char out[KD_FLUX_TEXT]);

#endif
