#include "scene/scene.h"

#include "physics/scale.h"

/* Half of the field of view has its tangent at the distance 1. */
static double width_m(const struct kd_camera *camera)
{
    return isfinite(camera->r) ? 2 * camera->r * tan(0.5 * camera->fov_deg * (M_PI / 180)) : camera->field_m;
}

double kd_scene_width_uas(const struct kd_scene *scene)
{
    if (!kd_scene_is_flat(scene))
        return NAN;
    return width_m(&scene->camera) * kd_scale_microarcseconds(scene->spacetime.mass_msun, scene->spacetime.distance_pc);
}
