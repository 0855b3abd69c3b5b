/* Follows one ray of an observer to the sky in double precision, by closed form: physics/null/null_bend.h for a
 * direction in which a camera looks. Pure; any thread. */
#ifndef KD_RENDER_VIEW_SKY_RAY_H
#define KD_RENDER_VIEW_SKY_RAY_H

#include "physics/null/null_bend.h"
#include "render/view/camera.h"

struct kd_sky_rays {
    struct kd_camera_exact camera;
    struct kd_vantage at;
};

/* Places are those of the whole picture, whatever tile is made of it. */
struct kd_sky_rays kd_sky_rays_of(const struct kd_scene *scene);

/* look: along e_r, e_theta, e_phi, of any length; of an observer at infinity alpha and beta. False: the ray does not
 * escape, or is one that null_bend.h does not follow, as one that crosses no equator. */
bool kd_sky_ray_bend(const struct kd_sky_rays *rays, const double look[3], struct kd_null_bend *out);
/* Where it comes from: a unit vector in the hole's frame, the observer at azimuth 0, as the lens map has it. */
bool kd_sky_ray(const struct kd_sky_rays *rays, const double look[3], double out[3]);

#endif
