/* Units of light at a radio frequency: 1 in the picture is KD_RADIO_KELVIN of brightness temperature. Pure functions
 * of valid scenes, any thread. */
#ifndef KD_RENDER_EMIT_RADIO_H
#define KD_RENDER_EMIT_RADIO_H

#include "scene/scene.h"

#define KD_RADIO_KELVIN 1e10

/* Specific intensity of light 1, 2 nu^2 k T/c^2, W m^-2 Hz^-1 sr^-1. */
double kd_radio_unit(const struct kd_scene *scene);

/* Flux in Jy of so much light times solid angle as kd_light_report has it: in M^2 of the image plane, or in sr of a
 * camera at a finite radius, which is what the same picture would be seen as from spacetime.distance_pc
 * (kd_scene_width_uas). */
double kd_radio_jansky(const struct kd_scene *scene, double flux);

/* Jy that arrive from a pixel whose light is 1, seen from infinity: each stands for the same part of the image plane.
 */
double kd_radio_jansky_pixel(const struct kd_scene *scene);

#endif
