#include "scene/scene.h"

#include "physics/angle.h"
#include "physics/qnm.h"
#include "physics/ringdown.h"

#define TIME_END 1e12 /* of `time` in fields.h, either way */

void kd_scene_advance(struct kd_scene *scene, double seconds)
{
    scene->camera.azimuth_deg = remainder(scene->camera.azimuth_deg + scene->motion.azimuth_rate_deg * seconds, 360);
    scene->top.time = fmax(-TIME_END, fmin(TIME_END, scene->top.time + scene->motion.time_rate * seconds));
}

bool kd_scene_time_goes_on(const struct kd_scene *scene)
{
    double rate = scene->motion.time_rate;
    return rate != 0 && scene->top.time != copysign(TIME_END, rate);
}

struct kd_vantage kd_scene_vantage(const struct kd_scene *scene)
{
    const double i = scene->camera.inclination_deg;
    return (struct kd_vantage) { scene->spacetime.spin, scene->camera.r, kd_cos_deg(i), kd_sin_deg(i) };
}

bool kd_scene_is_flat(const struct kd_scene *scene)
{
    const enum kd_projection projection = scene->camera.projection;
    return projection == KD_PROJECTION_AUTO || projection == KD_PROJECTION_PLANE || projection == KD_PROJECTION_PINHOLE;
}

struct kd_observer_motion kd_scene_observer(const struct kd_scene *scene)
{
    const struct kd_camera *c = &scene->camera;
    return (struct kd_observer_motion) {
        .observer = (enum kd_observer)c->observer,
        .velocity = { c->velocity_r, c->velocity_theta, c->velocity_phi },
        .fall_from = c->infall_from,
        .fall_energy = c->infall_energy,
        .fall_momentum = c->infall_momentum,
    };
}

size_t kd_scene_spots(const struct kd_scene *scene, const struct kd_spot *on[KD_SPOTS])
{
    size_t n = 0;
    for (size_t i = 0; i < scene->spots.count; i++)
        if (scene->spots.at[i].brightness > 0)
            on[n++] = &scene->spots.at[i];
    return n;
}

/* It is the hole that rings, and m counts about its own axis: spin a < 0 turns the disk against the hole, and rings as |a| does. */
bool kd_scene_ringdown(const struct kd_scene *scene, double *wave)
{
    double t = scene->top.time - scene->style.ringdown_time;
    struct kd_qnm mode;
    if (!(scene->style.ringdown > 0) || t < 0)
        return false;
    kd_qnm_find(2, 2, 0, fabs(scene->spacetime.spin), &mode); /* a valid scene's spin is in the domain */
    *wave = kd_ringdown_wave(mode.omega, t);
    return true;
}
