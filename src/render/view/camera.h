/* Converts the camera of a scene to the constants from which a kernel makes each ray. Double precision, pure, any
 * thread. */
#ifndef KD_RENDER_VIEW_CAMERA_H
#define KD_RENDER_VIEW_CAMERA_H

#include "render/view/layout.h"
#include "scene/scene.h"

/* The camera of the kernels before it is rounded. */
#define F(name) double name;
#define U(name) uint32_t name;
struct kd_camera_exact { KD_CAMERA_FIELDS_(F, U) };
#undef F
#undef U

/* The scene must be valid. */
struct kd_camera_exact kd_camera_exact(const struct kd_scene *scene);
struct kd_camera_block kd_camera_block(const struct kd_scene *scene);

/* KD_SIGHT_ of shaders/shared/interface.h: how it looks. */
uint32_t kd_camera_sight(const struct kd_scene *scene);

/* What the direction at (x, y), in steps from the middle, has of c0; x and y become what it has of cx and cy. */
double kd_camera_ahead(uint32_t sight, double turn_x, double turn_y, double *x, double *y);

/* The Boyer-Lindquist azimuth of the observer less camera.azimuth_deg. */
double kd_camera_twist(const struct kd_scene *scene);

/* From pixel to pixel: M in the image plane, or over the distance of the picture from a pinhole. Of these two alone. */
double kd_camera_pixel(const struct kd_scene *scene);

/* The ray at (x, y) by its labels (render/rays/rays.h), as shaders/ray/camera.glsl makes it, in double. In the
 * ergosphere E may be negative: r and theta along the ray are those of the labels L/E and Q/E^2 all the same, as if
 * E were positive; azimuth and time run the other way. */
struct kd_camera_label {
    double alpha, beta;
    bool outward;  /* at a finite radius: the traced ray starts away from the hole */
    double energy; /* at infinity, per unit that the observer measures; not 0 */
};
/* Where the ray at (x, y), in rays from the upper left one, comes from in the observer's own frame: a unit vector
 * along e_r, e_theta, e_phi. Of a camera at a finite radius. */
void kd_camera_direction(const struct kd_camera_exact *camera, double x, double y, double out[3]);

/* The same of any length, and of a camera at infinity alpha and beta. */
void kd_camera_look(const struct kd_camera_exact *camera, double x, double y, double out[3]);

/* The place at which it sees a direction of any length, in rays as above; at infinity that of alpha and beta. False:
 * none, behind a pinhole. */
bool kd_camera_seen(const struct kd_camera_exact *camera, const double direction[3], double *x, double *y);

/* From E, L/sin(theta), and what beta is times |E|. */
void kd_camera_label_of(double energy, double momentum, double up, bool outward, struct kd_camera_label *out);
void kd_camera_label_towards(const struct kd_camera_exact *camera, const double direction[3],
                             struct kd_camera_label *out); /* of any length; at a finite radius */
void kd_camera_label(const struct kd_camera_exact *camera, uint32_t x, uint32_t y, struct kd_camera_label *out);

#endif
