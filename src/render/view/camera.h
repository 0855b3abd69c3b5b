/* Converts the camera of a scene to the constants from which a kernel makes each ray. Double precision, pure, any
 * thread. */
#ifndef KD_RENDER_VIEW_CAMERA_H
#define KD_RENDER_VIEW_CAMERA_H

#include "render/view/layout.h"
#include "scene/scene.h"

/* The camera of the kernels before its numbers are rounded. */
#define F(name) double name;
#define U(name) uint32_t name;
struct kd_camera_exact { KD_CAMERA_FIELDS_(F, U) };
#undef F
#undef U

/* The scene must be valid. */
struct kd_camera_exact kd_camera_exact(const struct kd_scene *scene);
struct kd_camera_block kd_camera_block(const struct kd_scene *scene);

/* The KD_SIGHT_ constant (shaders/shared/interface.h) of the camera's projection. */
uint32_t kd_camera_sight(const struct kd_scene *scene);

/* Takes a point (x, y), in steps from the middle of the picture. Returns the component of the point's direction along
 * c0, and replaces x and y by the components along cx and cy. */
double kd_camera_ahead(uint32_t sight, double turn_x, double turn_y, double *x, double *y);

/* Boyer-Lindquist azimuth of the observer minus camera.azimuth_deg. */
double kd_camera_twist(const struct kd_scene *scene);

/* Distance between neighbouring pixels: in M for the image plane; as a fraction of the picture's distance for a
 * pinhole. Defined only for these two projections. */
double kd_camera_pixel(const struct kd_scene *scene);

/* The labels (render/rays/rays.h) of the ray at (x, y), computed in double as shaders/ray/camera.glsl does. In the
 * ergosphere E may be negative. Then r and theta along the ray still follow from the labels L/E and Q/E^2 as if E were
 * positive, but azimuth and time run backwards. */
struct kd_camera_label {
    double alpha, beta;
    bool outward;  /* true if the traced ray of an observer at a finite radius starts away from the hole */
    double energy; /* energy at infinity, in units of the energy that the observer measures; not 0 */
};
/* Direction from which the ray at (x, y) arrives, in the observer's frame: a unit vector along e_r, e_theta, e_phi.
 * x and y count rays from the upper left one. The camera must be at a finite radius. */
void kd_camera_direction(const struct kd_camera_exact *camera, double x, double y, double out[3]);

/* As kd_camera_direction, but the vector is not normalised; for a camera at infinity it is (alpha, beta, 0). */
void kd_camera_look(const struct kd_camera_exact *camera, double x, double y, double out[3]);

/* The place in the picture at which the camera sees a direction. The place is in rays, as in kd_camera_direction. The
 * direction may have any length; at infinity it is alpha and beta. Returns false if the direction is behind a
 * pinhole. */
bool kd_camera_seen(const struct kd_camera_exact *camera, const double direction[3], double *x, double *y);

/* Computes labels from E, L/sin(theta), and beta |E|. */
void kd_camera_label_of(double energy, double momentum, double up, bool outward, struct kd_camera_label *out);
/* kd_camera_label_towards: direction of any length; the camera must be at a finite radius */
void kd_camera_label_towards(const struct kd_camera_exact *camera, const double direction[3],
                             struct kd_camera_label *out);
void kd_camera_label(const struct kd_camera_exact *camera, uint32_t x, uint32_t y, struct kd_camera_label *out);

#endif
