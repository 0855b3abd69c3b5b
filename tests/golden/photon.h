/* The photon that a pixel with one ray receives, for the Kerr-Schild oracle. Cameras: the plane camera, and the pinhole
 * camera of a static observer. */
#ifndef KD_TESTS_GOLDEN_PHOTON_H
#define KD_TESTS_GOLDEN_PHOTON_H

#include "kerr_schild.h"
#include "scene/scene.h"

#include <math.h>

static inline struct ks_photon photon_of(const struct kd_scene *scene, uint32_t x, uint32_t y)
{
    double theta = scene->camera.inclination_deg * (M_PI / 180), width = scene->image.width,
           height = scene->image.height;
    bool far = isinf(scene->camera.r);
    double step = far ? scene->camera.field_m / width : 2 * tan(scene->camera.fov_deg * (M_PI / 360)) / width;
    double right = step * (x - 0.5 * (width - 1)), up = -step * (y - 0.5 * (height - 1)),
           n = sqrt(1 + right * right + up * up);
    const double k[3] = { -1 / n, -up / n, right / n };
    return far ? ks_from_infinity(scene->spacetime.spin, cos(theta), right, up)
               : ks_from_camera(scene->spacetime.spin, scene->camera.r, theta, false, k);
}

#endif
