/* Units of light of one frequency (kd_scene_is_radio_alone). The unit of light of a volume is a brightness
 * temperature of KD_RADIO_KELVIN. The unit of light of a disk is the intensity of its hottest place without
 * redshift. Pure functions of valid scenes, any thread. */
#ifndef KD_RENDER_EMIT_RADIO_H
#define KD_RENDER_EMIT_RADIO_H

#include "scene/scene.h"

#define KD_RADIO_KELVIN 1e10

/* Specific intensity of a brightness temperature: 2 nu^2 k T/c^2, W m^-2 Hz^-1 sr^-1. */
double kd_radio_unit(double ghz, double kelvin);

/* The unit of light as a brightness temperature c^2 I/(2 k nu^2) in K, and as Jy per steradian. */
double kd_radio_kelvin(const struct kd_scene *scene);
double kd_radio_jansky_steradian(const struct kd_scene *scene);

/* Converts a flux of kd_light_report to Jy. Such a flux is light times solid angle. The unit of the solid angle is
 * M^2 of the image plane, or sr for a camera at a finite radius r. A flux in sr is multiplied by r^2. The result is
 * that of a picture with the same width at the hole, seen from spacetime.distance_pc (kd_scene_width_uas). */
double kd_radio_jansky(const struct kd_scene *scene, double flux);

/* Flux in Jy of one pixel with light 1. For an observer at infinity only, because then all pixels cover the same area
 * of the image plane. */
double kd_radio_jansky_pixel(const struct kd_scene *scene);

#endif
