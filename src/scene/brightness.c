#include "scene/scene.h"

#include <math.h>

#define ALONE 0.2 /* value for sky.brightness "auto" if the volume is a grid, or if nothing shines except the sky */
/* value for sky.brightness "auto" in all other cases; it is small, so that bright stars beside a disk do not make
 * the whole sky white */
#define BEHIND 0.01

static bool shines_before(const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    const struct kd_body *bodies[KD_SCENE_BODIES];
    return scene->disk.model != KD_DISK_NONE || scene->volume.model != KD_VOLUME_NONE || scene->jets.brightness > 0 ||
           scene->flash.brightness > 0 || kd_scene_spots(scene, on) || kd_scene_bodies(scene, bodies) ||
           scene->dynamic.at;
}

double kd_scene_sky_brightness(const struct kd_scene *scene)
{
    if (isfinite(scene->sky.brightness))
        return scene->sky.brightness;
    return scene->sky.model != KD_SKY_GRID && shines_before(scene) ? BEHIND : ALONE;
}

/* maximum brightness of one unit of the sky, as a fraction of white; it is small, so that the space between the
 * stars stays black */
#define DARK 0.25

double kd_scene_exposure_most(const struct kd_scene *scene)
{
    const double brightness = kd_scene_sky_brightness(scene);
    const bool chosen = isfinite(scene->sky.brightness) && shines_before(scene);
    if (scene->sky.model == KD_SKY_NONE || scene->sky.model == KD_SKY_GRID ||
        scene->style.palette != KD_PALETTE_COLOUR || chosen || !(brightness > 0))
        return INFINITY;
    return log2(DARK / brightness);
}
