/* Self-test of the lens map's kernels with known rays. Each ray is the only ray of a picture of one pixel. */
#include "render/selftest/parts.h"

#include "interface.h"

#include <float.h>
#include <math.h>

#define ORDERS 3
#define STEPS 16
#define PLANES (2 * ORDERS + 3)

/* Bounds are as in rays.c: roundoff, and the error of 16 steps of order 6. The camera adds the operations from pixel to
 * ray. The azimuth comes from a series accurate to 1e-7 a half turn (polar_azimuth.glsl). */
static double unit_of(void) { return KD_SELFTEST_OPERATIONS * (double)(FLT_EPSILON / 2) + 1e-3 * pow(M_PI / STEPS, 6); }

static double turn(double x) { return remainder(x, 2 * M_PI); }

static struct kd_scene scene_of(const struct kd_selftest_ray *ray, const struct kd_selftest_camera *camera)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    KD_HOLE_COPY(&scene.spacetime, ray);
    scene.camera.inclination_deg = ray->inclination_deg;
    scene.camera.r = ray->radius;
    scene.image.width = scene.image.height = 1;
    scene.accuracy.orders = ORDERS;
    if (camera) {
        scene.camera.observer = (int32_t)camera->observer;
        scene.camera.velocity_r = camera->velocity[0];
        scene.camera.velocity_theta = camera->velocity[1];
        scene.camera.velocity_phi = camera->velocity[2];
        scene.camera.yaw_deg = camera->yaw_deg;
        scene.camera.pitch_deg = camera->pitch_deg;
    } else {
        scene.camera.centre_alpha = ray->alpha;
        scene.camera.centre_beta = ray->beta;
    }
    return scene;
}

/* Computes the planes of the single ray. */
static enum kd_status trace(const struct kd_selftest *test, const struct kd_scene *scene, const struct kd_needs *needs,
                            float planes[PLANES])
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_renderer_capacity(test->renderer, &capacity);
    enum kd_status status;
    KD_TRY(kd_scene_validate(scene, test->error));
    KD_TRY(kd_plan_make_for(scene, needs, &capacity, &plan, test->error));
    KD_TRY(kd_render_lens(test->renderer, scene, &plan, planes, NULL, test->error));
done:
    return status;
}

/* Compares radii; a plane holds w = 1/r, or 0 if there is no crossing. */
static void judge_radii(const struct kd_selftest_ray *ray, const float *planes, struct kd_selftest_row *row)
{
    for (int n = 0; n < ORDERS; n++) {
        const struct kd_selftest_crossing *k = &ray->crossing[n];
        bool has = n < ray->n_crossings;
        if (has != (planes[n] > 0))
            kd_selftest_compare(row, INFINITY, unit_of());
        else if (has)
            kd_selftest_compare(row, 1 / (planes[n] * k->r) - 1, unit_of() * (1 + k->r_gain));
    }
}

static void judge_angles(const struct kd_selftest_ray *ray, const float *planes, struct kd_selftest_row *phi,
                         struct kd_selftest_row *sky)
{
    for (int n = 0; n < ray->n_crossings; n++)
        kd_selftest_compare(phi, turn(planes[ORDERS + n] - ray->crossing[n].phi),
                            unit_of() * (M_PI * (n + 1) + ray->crossing[n].phi_gain));
    const float *end = planes + 2 * ORDERS;
    double allowed = unit_of() * (M_PI * (ray->n_crossings + 1) + ray->sky_gain);
    if (ray->captured || end[2] != KD_FATE_ESCAPED)
        kd_selftest_compare(sky, ray->captured && end[2] == KD_FATE_CAPTURED ? 0 : INFINITY, allowed);
    else
        kd_selftest_compare(sky, hypot(acos(end[0]) - ray->theta, sin(ray->theta) * turn(end[1] - ray->phi)), allowed);
}

/* Compares rays from infinity: in closed form, then by steps. */
static enum kd_status far(const struct kd_selftest *test)
{
    static const char taylor[] = "equations of motion by Taylor series, 38 digits";
    const struct kd_needs needs = { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY };
    struct kd_selftest_row closed, closed_phi, closed_sky, r, phi, sky;
    enum kd_status status;
    kd_selftest_begin(&closed, taylor, "lens_closed f32", "lens map: r (relative)");
    kd_selftest_begin(&closed_phi, taylor, "lens_closed f32", "lens map: phi (rad)");
    kd_selftest_begin(&closed_sky, taylor, "lens_closed f32", "lens map: fate, direction (rad)");
    kd_selftest_begin(&r, taylor, "lens_map f32", "lens map: r (relative)");
    kd_selftest_begin(&phi, taylor, "lens_map f32", "lens map: phi (rad)");
    kd_selftest_begin(&sky, taylor, "lens_map f32", "lens map: fate, direction (rad)");
    for (size_t i = 0; i < test->reference->n_rays; i++) {
        const struct kd_selftest_ray *ray = &test->reference->rays[i];
        struct kd_scene scene = scene_of(ray, NULL);
        float planes[PLANES];
        if (!isinf(ray->radius))
            continue;
        KD_TRY(trace(test, &scene, &needs, planes));
        judge_radii(ray, planes, &closed);
        judge_angles(ray, planes, &closed_phi, &closed_sky);
        scene.accuracy.steps = STEPS;
        KD_TRY(trace(test, &scene, &needs, planes));
        judge_radii(ray, planes, &r);
        judge_angles(ray, planes, &phi, &sky);
    }
    KD_TRY(kd_selftest_end(test, &closed));
    KD_TRY(kd_selftest_end(test, &closed_phi));
    KD_TRY(kd_selftest_end(test, &closed_sky));
    KD_TRY(kd_selftest_end(test, &r));
    KD_TRY(kd_selftest_end(test, &phi));
    KD_TRY(kd_selftest_end(test, &sky));
done:
    return status;
}

/* Converts the reference's Boyer-Lindquist azimuths to the azimuths of the map, which are relative to a falling
 * observer's ingoing azimuth. The azimuths of the map are larger by the integral of a/Delta from r to infinity. */
static struct kd_selftest_ray by_own_azimuth(const struct kd_selftest_camera *camera)
{
    struct kd_selftest_ray ray = camera->ray;
    const double root = kd_hole_in(&ray).root, gap = ray.radius - 1 - root;
    double more = camera->observer == KD_OBSERVER_INFALL ? ray.spin / (2 * root) * log1p(2 * root / gap) : 0;
    for (int n = 0; n < ray.n_crossings; n++)
        ray.crossing[n].phi += more;
    ray.phi += more;
    return ray;
}

static enum kd_status near(const struct kd_selftest *test)
{
    static const char tetrad[] = "tetrad by Gram-Schmidt, ray by Taylor series";
    struct kd_selftest_row r, phi, sky;
    enum kd_status status;
    kd_selftest_begin(&r, tetrad, "lens_map f32", "lens map of a camera nearby: r (relative)");
    kd_selftest_begin(&phi, tetrad, "lens_map f32", "lens map of a camera nearby: phi (rad)");
    kd_selftest_begin(&sky, tetrad, "lens_map f32", "lens map of a camera nearby: direction (rad)");
    for (size_t i = 0; i < test->reference->n_cameras; i++) {
        const struct kd_selftest_camera *camera = &test->reference->cameras[i];
        struct kd_scene scene = scene_of(&camera->ray, camera);
        const struct kd_needs needs = { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY };
        scene.accuracy.steps = STEPS;
        float planes[PLANES];
        const struct kd_selftest_ray known = by_own_azimuth(camera);
        KD_TRY(trace(test, &scene, &needs, planes));
        judge_radii(&known, planes, &r);
        judge_angles(&known, planes, &phi, &sky);
    }
    KD_TRY(kd_selftest_end(test, &r));
    KD_TRY(kd_selftest_end(test, &phi));
    KD_TRY(kd_selftest_end(test, &sky));
done:
    return status;
}

enum kd_status kd_selftest_maps(const struct kd_selftest *test)
{
    enum kd_status status = far(test);
    return status ? status : near(test);
}
