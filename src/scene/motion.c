#include "scene/scene.h"

void kd_scene_advance(struct kd_scene *scene, double seconds)
{
    scene->camera.azimuth_deg = remainder(scene->camera.azimuth_deg + scene->motion.azimuth_rate_deg * seconds, 360);
    scene->top.time = fmax(-1e12, fmin(1e12, scene->top.time + scene->motion.time_rate * seconds));
}

bool kd_scene_moves(const struct kd_scene *scene)
{
    bool particles = scene->disk.model == KD_DISK_PARTICLES; /* a smooth disk knows neither azimuth nor time */
    return (scene->motion.azimuth_rate_deg != 0 && (particles || scene->sky.model != KD_SKY_NONE)) ||
           (scene->motion.time_rate != 0 && particles);
}
