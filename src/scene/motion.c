#include "scene/scene.h"

#include "physics/qnm.h"
#include "physics/ringdown.h"

/* sRGB turns a relative change d of luminance into 112 d steps of 8 bits at most: what is left is a tenth of a step. */
#define SEEN (1. / 1024)
#define TIME_END 1e12 /* of `time` in fields.h, either way */

void kd_scene_advance(struct kd_scene *scene, double seconds)
{
    scene->camera.azimuth_deg = remainder(scene->camera.azimuth_deg + scene->motion.azimuth_rate_deg * seconds, 360);
    scene->top.time = fmax(-TIME_END, fmin(TIME_END, scene->top.time + scene->motion.time_rate * seconds));
}

static bool time_goes_on(const struct kd_scene *scene)
{
    double rate = scene->motion.time_rate;
    return rate != 0 && scene->top.time != copysign(TIME_END, rate);
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

/* Whether the rings still change with time. The fit decays up to a fifth too fast beyond a = 0.99: a third of a step, then. */
static bool rings(const struct kd_scene *scene)
{
    double since = scene->top.time - scene->style.ringdown_time;
    if (!(scene->style.ringdown > 0) || since < 0 || scene->disk.model == KD_DISK_NONE || scene->accuracy.orders < 2)
        return false;
    const struct kd_ringdown_fit mode = kd_ringdown_fit(0, fabs(scene->spacetime.spin));
    return scene->style.ringdown * exp(-mode.omega_re / (2 * mode.quality) * since) > SEEN;
}

/* A smooth disk knows neither azimuth nor time. */
static bool has_lumps(const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    return scene->disk.model == KD_DISK_PARTICLES || kd_scene_spots(scene, on);
}

static bool goes_round(const struct kd_scene *scene)
{
    return scene->motion.azimuth_rate_deg != 0 && (has_lumps(scene) || scene->sky.model != KD_SKY_NONE);
}

bool kd_scene_only_rings(const struct kd_scene *scene)
{
    return time_goes_on(scene) && rings(scene) && !has_lumps(scene) && !goes_round(scene);
}

bool kd_scene_moves(const struct kd_scene *scene)
{
    return goes_round(scene) || (time_goes_on(scene) && (has_lumps(scene) || rings(scene)));
}
