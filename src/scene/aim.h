/* The viewing direction of a moving camera. It points to the hole or to a place, or is given by yaw and pitch. The
 * aberration by the observer's motion is included; the bending of light is ignored. Double precision, pure, any
 * thread. */
#ifndef KD_SCENE_AIM_H
#define KD_SCENE_AIM_H

#include "scene/scene.h"

/* HOLE: the camera looks towards light that moves straight outwards, along the outgoing principal null direction: E
 * = 1, L = a sin^2(theta), p_theta = 0, Sigma p^r = Sigma (Chandrasekhar 1983, The Mathematical Theory of Black
 * Holes, section 62). Without spin this direction is straight ahead for an observer in radial motion.
 *
 * PLACE: the camera looks along the straight line, in flat space, from itself to (r, theta, phi). Both points are
 * read as spherical coordinates, and phi is measured like camera.azimuth_deg. With r = INFINITY the camera looks in
 * the direction (theta, phi). The camera sees light that arrives along this line in the frame of zero angular
 * momentum. For an infalling observer the rain frame is used instead, whose space is flat if there is no spin. */
struct kd_aim {
    enum kd_aim_kind { KD_AIM_FREE, KD_AIM_HOLE, KD_AIM_PLACE } kind; /* FREE: yaw and pitch give the direction */
    double r, theta_deg, phi_deg;
};

/* Computes the viewing direction of a camera with this aim, as a unit vector. Its components are right, up and
 * inwards, in the sense of yaw and pitch. The scene must be valid. Returns KD_EINVAL if the camera is at infinity,
 * or at the place at which it aims. */
enum kd_status kd_aim_look(const struct kd_aim *aim, const struct kd_scene *scene, double look[3],
                           struct kd_error *error);

/* Interpolates between two directions along a great circle, t in [0, 1]. If they are opposite, the path goes through
 * a direction that is perpendicular to both. */
void kd_aim_between(const double from[3], const double to[3], double t, double look[3]);

/* Sets the camera's yaw and pitch to this direction. */
void kd_aim_turn(struct kd_scene *scene, const double look[3]);

#endif
