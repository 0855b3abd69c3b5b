/* Where a camera looks while it moves: at the hole, at a place, or in a direction. The aberration of the observer's
 * motion is in it, the bending of light is not. Double precision, pure, any thread. */
#ifndef KD_SCENE_AIM_H
#define KD_SCENE_AIM_H

#include "scene/scene.h"

/* HOLE: where light comes from that flies straight out, along the outgoing principal null direction: E = 1, L = a
 * sin^2(theta), p_theta = 0, Sigma p^r = Sigma (Chandrasekhar 1983, The Mathematical Theory of Black Holes, section
 * 62). Without spin it is straight ahead for who moves along the radius alone.
 *
 * PLACE: along the straight line of flat space between the camera and (r, theta, phi), both taken as spherical
 * coordinates, phi as camera.azimuth_deg; r INFINITY: in that direction. Light that comes so in the frame of zero
 * angular momentum, or, to what falls, in that of rain, whose space is flat without spin, is seen there. */
struct kd_aim {
    enum kd_aim_kind { KD_AIM_FREE, KD_AIM_HOLE, KD_AIM_PLACE } kind; /* FREE: as yaw and pitch say */
    double r, theta_deg, phi_deg;
};

/* Gives the way that a camera looks which aims so: a unit vector, right, up and inwards, as yaw and pitch have it.
 * The scene is valid. KD_EINVAL where its camera is at infinity, or at the place itself. */
enum kd_status kd_aim_look(const struct kd_aim *aim, const struct kd_scene *scene, double look[3],
                           struct kd_error *error);

/* The way between two, at t of [0, 1], along the great circle; if they are opposite, round by the side. */
void kd_aim_between(const double from[3], const double to[3], double t, double look[3]);

/* Turns the camera that way: yaw and pitch. */
void kd_aim_turn(struct kd_scene *scene, const double look[3]);

#endif
