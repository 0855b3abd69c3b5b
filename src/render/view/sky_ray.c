#include "render/view/sky_ray.h"

#include <math.h>

struct kd_sky_rays kd_sky_rays_of(const struct kd_scene *scene)
{
    const struct kd_scene whole = kd_scene_whole(scene);
    return (struct kd_sky_rays) { kd_camera_exact(&whole), kd_scene_vantage(scene) };
}

bool kd_sky_ray_bend(const struct kd_sky_rays *rays, const double look[3], struct kd_null_bend *out)
{
    const struct kd_vantage *at = &rays->at;
    struct kd_null_ray ray = { .hole = at->hole, .radius = at->r, .cos_theta = at->u, .sin_theta = at->s };
    struct kd_camera_label label = { .alpha = look[0], .beta = look[1] };
    if (isfinite(at->r))
        kd_camera_label_towards(&rays->camera, look, &label);
    ray.alpha = label.alpha, ray.beta = label.beta, ray.outward = label.outward;
    const bool escapes = kd_null_bend_of(&ray, out);
    out->drag += rays->camera.twist;
    return escapes;
}

bool kd_sky_ray(const struct kd_sky_rays *rays, const double look[3], double out[3])
{
    struct kd_null_bend bend;
    const bool escapes = kd_sky_ray_bend(rays, look, &bend);
    if (escapes)
        kd_null_bend_sky(&bend, rays->at.u, rays->at.s, out);
    return escapes;
}
