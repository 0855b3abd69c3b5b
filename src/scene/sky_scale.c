#include "scene/sky_scale.h"

#include "physics/spacetime/scale.h"
#include "scene/table.h"

static double uas_of_m(const struct kd_scene *scene)
{
    return kd_scale_microarcseconds(scene->spacetime.mass_msun, scene->spacetime.distance_pc);
}

double kd_scene_field_of_uas(const struct kd_scene *scene) { return scene->camera.field_uas / uas_of_m(scene); }

void kd_scene_settle(struct kd_scene *scene, const uint64_t *given)
{
    const struct kd_row *in_m = kd_field_find("camera", "field_m"), *on_sky = kd_field_find("camera", "field_uas");
    if (given && kd_field_is_given(given, in_m) && !kd_field_is_given(given, on_sky))
        scene->camera.field_uas = INFINITY;
    const double width = kd_scene_field_of_uas(scene);
    if (isfinite(scene->camera.field_uas) && kd_row_holds(in_m, width))
        scene->camera.field_m = width;
}

/* Width in M, at the hole, of the field of view of a camera at a finite radius. */
static double width_m(const struct kd_camera *camera)
{
    return isfinite(camera->r) ? 2 * camera->r * tan(0.5 * camera->fov_deg * (M_PI / 180)) : camera->field_m;
}

double kd_scene_width_uas(const struct kd_scene *scene)
{
    if (!kd_scene_is_flat(scene))
        return NAN;
    return width_m(&scene->camera) * uas_of_m(scene);
}
