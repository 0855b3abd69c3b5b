/* Follows one ray of a camera to the sky in double precision by closed form, for any direction
 * (physics/null/null_bend.h). Pure; any thread. */
#ifndef KD_RENDER_VIEW_SKY_RAY_H
#define KD_RENDER_VIEW_SKY_RAY_H

#include "physics/null/null_bend.h"
#include "render/view/camera.h"

struct kd_sky_rays {
    struct kd_camera_exact camera;
    struct kd_vantage at;
};

/* Places are counted in the whole picture, even if the scene renders a tile of it. */
struct kd_sky_rays kd_sky_rays_of(const struct kd_scene *scene);

/* look: direction along e_r, e_theta, e_phi, of any length; for an observer at infinity (alpha, beta). Returns false
 * if the ray does not escape, or if null_bend.h does not cover the ray (because it does not cross the equator, for
 * example). */
bool kd_sky_ray_bend(const struct kd_sky_rays *rays, const double look[3], struct kd_null_bend *out);
/* Direction from which the ray comes: a unit vector in the hole's frame, with the observer at azimuth 0, as in the
 * lens map. */
bool kd_sky_ray(const struct kd_sky_rays *rays, const double look[3], double out[3]);

#endif
