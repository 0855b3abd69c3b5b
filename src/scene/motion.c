#include "scene/scene.h"

#include "physics/math/angle.h"
#include "physics/spacetime/infall.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/scale.h"
#include "physics/spacetime/worldline.h"
#include "physics/waves/qnm.h"
#include "physics/waves/ringdown.h"
#include "scene/hole.h"

#define TIME_END 1e12 /* limit of |time|, as in fields.h */

static void turn(struct kd_scene *scene, double degrees)
{
    scene->camera.azimuth_deg = remainder(scene->camera.azimuth_deg + degrees, 360);
}

void kd_scene_pass(struct kd_scene *scene, double time)
{
    scene->top.time = fmax(-TIME_END, fmin(TIME_END, scene->top.time + time));
}

void kd_scene_go_on(struct kd_scene *scene, double proper_time)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    const struct kd_worldline_place to = kd_worldline_after(&motion, &at, proper_time);
    scene->camera.r = to.r;
    turn(scene, to.azimuth * (180 / M_PI));
    kd_scene_pass(scene, kd_scene_is_slow(scene) && isfinite(to.far_time) ? to.far_time : to.time);
}

void kd_scene_advance(struct kd_scene *scene, double seconds)
{
    turn(scene, scene->motion.azimuth_rate_deg * seconds);
    kd_scene_pass(scene, scene->motion.time_rate * seconds);
    if (scene->motion.proper_time_rate > 0)
        kd_scene_go_on(scene, scene->motion.proper_time_rate * seconds);
}

/* True if the observer moves along its own path. */
static bool goes_on(const struct kd_scene *scene)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    return scene->motion.proper_time_rate > 0 && kd_worldline_goes_on(&motion, &at);
}

bool kd_scene_falls(const struct kd_scene *scene)
{
    return scene->camera.observer == KD_OBSERVER_INFALL && goes_on(scene);
}

bool kd_scene_azimuth_goes_on(const struct kd_scene *scene)
{
    return scene->motion.azimuth_rate_deg != 0 || (scene->camera.observer != KD_OBSERVER_STATIC && goes_on(scene));
}

bool kd_scene_time_goes_on(const struct kd_scene *scene)
{
    double rate = scene->motion.time_rate + (goes_on(scene) ? scene->motion.proper_time_rate : 0);
    return rate != 0 && scene->top.time != copysign(TIME_END, rate);
}

bool kd_scene_clock(const struct kd_scene *scene, struct kd_fall_clock *out)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    const double horizon = at.hole.outer;
    if (motion.observer != KD_OBSERVER_INFALL || !kd_worldline_is_known(&motion, &at))
        return false;
    *out = (struct kd_fall_clock) {
        .to_horizon = at.r > horizon ? kd_infall_proper_time(&motion, &at, horizon) : NAN,
        .to_end = kd_infall_proper_time(&motion, &at, at.hole.inner),
        .second = kd_scale_seconds(scene->spacetime.mass_msun),
    };
    return true;
}

struct kd_vantage kd_scene_vantage(const struct kd_scene *scene)
{
    const double i = scene->camera.inclination_deg;
    return (struct kd_vantage) { *kd_scene_hole(scene), scene->camera.r, kd_cos_deg(i), kd_sin_deg(i) };
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

size_t kd_scene_bodies(const struct kd_scene *scene, const struct kd_body *on[KD_SCENE_BODIES])
{
    size_t n = 0;
    for (size_t i = 0; i < scene->bodies.count; i++)
        if (scene->bodies.at[i].radius > 0)
            on[n++] = &scene->bodies.at[i];
    return n;
}

struct kd_vantage kd_body_vantage(const struct kd_scene *scene, const struct kd_body *body)
{
    const double i = body->inclination_deg;
    return (struct kd_vantage) { *kd_scene_hole(scene), body->r, kd_cos_deg(i), kd_sin_deg(i) };
}

struct kd_observer_motion kd_body_motion(const struct kd_body *body)
{
    struct kd_observer_motion motion = kd_observer_motion_of((enum kd_observer)body->motion);
    const double velocity[] = { body->velocity_r, body->velocity_theta, body->velocity_phi };
    for (int i = 0; i < 3 && body->motion == KD_OBSERVER_VELOCITY; i++)
        motion.velocity[i] = velocity[i];
    return motion;
}

/* The mode's m is counted around the hole's own axis. If the spin a is negative, the disk rotates against the hole,
 * but the hole itself rings as for |a|. */
bool kd_scene_ringdown(const struct kd_scene *scene, double *wave)
{
    double t = scene->top.time - scene->style.ringdown_time;
    struct kd_qnm mode;
    if (!(scene->style.ringdown > 0) || t < 0)
        return false;
    /* cannot fail, because the spin of a valid scene is within the range of the modes */
    kd_qnm_find(2, 2, 0, kd_hole(fabs(scene->spacetime.spin)), &mode);
    *wave = kd_ringdown_wave(mode.omega, t);
    return true;
}
