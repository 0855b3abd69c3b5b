#include "scene/scene.h"

void kd_scene_advance(struct kd_scene *scene, double seconds)
{
    scene->camera.azimuth_deg = remainder(scene->camera.azimuth_deg + scene->motion.azimuth_rate_deg * seconds, 360);
    scene->top.time = fmax(-1e12, fmin(1e12, scene->top.time + scene->motion.time_rate * seconds));
}

size_t kd_scene_spots(const struct kd_scene *scene, const struct kd_spot *on[KD_SPOTS])
{
    const struct kd_spot *spots[KD_SPOTS] = { &scene->spot1, &scene->spot2, &scene->spot3 };
    size_t n = 0;
    for (size_t i = 0; i < KD_SPOTS; i++)
        if (spots[i]->brightness > 0)
            on[n++] = spots[i];
    return n;
}

bool kd_scene_moves(const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    /* A smooth disk knows neither azimuth nor time. */
    bool lumps = scene->disk.model == KD_DISK_PARTICLES || kd_scene_spots(scene, on);
    return (scene->motion.azimuth_rate_deg != 0 && (lumps || scene->sky.model != KD_SKY_NONE)) ||
           (scene->motion.time_rate != 0 && lumps);
}
