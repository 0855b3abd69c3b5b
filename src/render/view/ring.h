/* The ring projection. Across the picture runs the angle round the critical curve; upwards runs the distance to the
 * curve as a signed logarithm. On this scale every image order has the same width. Double precision; pure, any
 * thread. The scene must be valid and have the projection "ring".
 *
 * Across, left to right: one turn about the curve's centre, with camera.roll_deg in the middle; angle 0 is where
 * alpha > 0 (physics/null/critical.h). Upper half: outside the curve, from d = 10^ring_decades_max at the top to
 * 10^ring_decades_min at the middle. Lower half: inside the curve, mirrored. d = rho/rho_c - 1
 * (physics/null/lensing.h). Rays go through the centres of their rows and columns. */
#ifndef KD_RENDER_VIEW_RING_H
#define KD_RENDER_VIEW_RING_H

#include "physics/null/critical.h"
#include "render/view/camera.h"

struct kd_ring {
    struct kd_critical curve;
    double middle;          /* angle                      */
    double most, least;     /* decades                    */
    uint32_t width, height; /* number of rays across and down */
};

struct kd_ring kd_ring_of(const struct kd_scene *scene);

/* kd_ring_column: the point of the critical curve for a column. kd_ring_distance: the distance d of a row. */
struct kd_critical_point kd_ring_column(const struct kd_ring *ring, uint32_t x);
double kd_ring_distance(const struct kd_ring *ring, uint32_t y);

/* Labels of the ray in a column and row. The relative error of d, computed back from alpha and beta, is 1e-15 / d. */
struct kd_camera_label kd_ring_label(const struct kd_ring *ring, const struct kd_critical_point *column, uint32_t y);

#endif
