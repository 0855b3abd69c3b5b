/* Orientation of the sky: rotations between three frames. The hole's frame has z along its spin and x towards azimuth
 * 0. The equatorial frame (J2000) has x towards the equinox. The galactic frame has x towards l = 0. All are
 * right-handed. Double precision; pure, any thread. */
#ifndef KD_RENDER_SKY_FRAME_H
#define KD_RENDER_SKY_FRAME_H

#include "scene/scene.h"

struct kd_vec { double x, y, z; };
struct kd_rotation { double m[3][3]; }; /* m[i]: row i of the matrix; out = m in */

struct kd_vec kd_sky_direction(double longitude, double latitude); /* radians */
struct kd_vec kd_rotate(const struct kd_rotation *by, struct kd_vec v);
struct kd_rotation kd_rotation_then(const struct kd_rotation *first, const struct kd_rotation *then);

/* The rotation from equatorial to galactic directions. The galactic pole is at RA 192.85948, Dec 27.12825 degrees;
 * the equatorial pole is at l = 122.93192 (J2000 by ESA, The Hipparcos Catalogue, vol. 1, 1.5.3). */
struct kd_rotation kd_rotation_galactic(void);

/* The rotation from directions in which rays escape, with azimuth measured from the observer's, to galactic directions.
 * Depends on sky.orientation, sky.tilt_deg, sky.turn_deg and the camera's azimuth. */
struct kd_rotation kd_sky_rotation(const struct kd_scene *scene);

#endif
