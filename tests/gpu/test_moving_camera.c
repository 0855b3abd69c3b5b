/* Tests a camera with an arbitrary velocity, for which every leg of the tetrad has all components. The lens map by both
 * kernels, and the labels of a pixel, are compared with the Kerr-Schild oracle. The oracle applies aberration to the
 * directions of the picture, and follows them from a frame of zero angular momentum. No observer of a scene moves like
 * this, so the test replaces the motion of one. */
#include "kerr_schild.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"
#include "render/render.h"
#include "render/view/camera.h"
#include "scene/hole.h"

#include "render_support.h"

#include <math.h>

enum { GRID = 24, RAYS = GRID * GRID, ORDERS = 2 };
#define RADIAN (M_PI / 180)

static double v[3], gamma_;

static void move(double r, double theta, double phi)
{
    v[0] = r, v[1] = theta, v[2] = phi;
    gamma_ = 1 / sqrt(1 - (r * r + theta * theta + phi * phi));
}

/* A boost: e'_t = gamma (e_t + v.e), e'_i = gamma v_i e_t + e_i + gamma^2/(gamma + 1) v_i v.e. */
struct kd_tetrad __real_kd_observer_tetrad(const struct kd_observer_motion *motion, const struct kd_vantage *at);
struct kd_tetrad __wrap_kd_observer_tetrad(const struct kd_observer_motion *motion, const struct kd_vantage *at);
struct kd_tetrad __wrap_kd_observer_tetrad(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    const struct kd_tetrad rest = __real_kd_observer_tetrad(motion, at);
    double x[4][4] = { { gamma_, gamma_ * v[0], gamma_ * v[1], gamma_ * v[2] } };
    for (int i = 0; i < 3; i++) {
        x[i + 1][0] = gamma_ * v[i];
        for (int j = 0; j < 3; j++)
            x[i + 1][j + 1] = (i == j) + gamma_ * gamma_ / (gamma_ + 1) * v[i] * v[j];
    }
    return (struct kd_tetrad) { *at, kd_tetrad_covector(&rest, x[0]), kd_tetrad_covector(&rest, x[1]),
                                kd_tetrad_covector(&rest, x[2]), kd_tetrad_covector(&rest, x[3]) };
}

/* The photon seen at (x, y) of the picture, -1 to 1, in units of the energy that the moving camera measures. */
static struct ks_photon photon(const struct kd_scene *scene, double x, double y)
{
    const struct kd_camera *c = &scene->camera;
    double t = tan(0.5 * c->fov_deg * RADIAN), n = 1 / sqrt(1 + t * t * (x * x + y * y));
    /* The photon moves along m and is seen along -m, which points inwards for the middle of the picture. */
    const double m[3] = { n, t * y * n, -t * x * n };
    double along = v[0] * m[0] + v[1] * m[1] + v[2] * m[2], energy = gamma_ * (1 + along), k[3];
    for (int i = 0; i < 3; i++)
        k[i] = -(m[i] + v[i] * (gamma_ + gamma_ * gamma_ / (gamma_ + 1) * along)) / energy;
    struct ks_photon p = ks_from_camera(scene->spacetime.spin, c->r, c->inclination_deg * RADIAN, true, k);
    p.energy *= energy, p.momentum *= energy, p.p_r *= energy, p.p_theta *= energy;
    return p;
}

static double place(int i) { return (2 * i + 1.0) / GRID - 1; }

static struct kd_scene scene_at(double spin, double inclination, double r)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = inclination;
    scene.camera.r = r;
    scene.camera.observer = KD_OBSERVER_ZAMO;
    scene.camera.fov_deg = 100;
    scene.image.width = scene.image.height = GRID;
    scene.image.critical_factor = 1;
    scene.accuracy.orders = ORDERS;
    return scene;
}

static void labels(const struct kd_scene *scene)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    double s = sin(scene->camera.inclination_deg * RADIAN);
    for (uint32_t k = 0; k < RAYS; k++) {
        struct kd_camera_label is;
        struct ks_photon want = photon(scene, place((int)(k % GRID)), -place((int)(k / GRID)));
        kd_camera_label(&camera, k % GRID, k / GRID, &is);
        double alpha = -want.momentum / (s * want.energy), beta = want.p_theta / fabs(want.energy);
        double bound = 1e-12 * scene->camera.r / fabs(want.energy);
        if (!(fabs(is.energy - want.energy) < 1e-12 && fabs(is.alpha - alpha) < bound * (1 + fabs(alpha)) &&
              fabs(is.beta - beta) < bound * (1 + fabs(beta))) ||
            is.outward != (want.p_r < 0))
            fail_msg("ray %u: E %.17g alpha %.17g beta %.17g %d, not %.17g %.17g %.17g p_r %g", k, is.energy, is.alpha,
                     is.beta, is.outward, want.energy, alpha, beta, want.p_r);
    }
}

/* Errors are divided by the crossing's amplification, as in test_lens_map.c. A ray is unsure if a small shift changes
 * its number of crossings. */
static void map(const struct kd_scene *scene, enum kd_lens_path path, const char *engine)
{
    static float planes[4 * RAYS];
    static double errors[ORDERS * RAYS];
    struct kd_capacity capacity;
    struct kd_plan plan;
    size_t n = 0, wrong = 0;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make_for(scene, &(struct kd_needs) { .quantities = KD_LENS_W }, &capacity, &plan, &error));
    assert_true(plan.lens.planes <= 4 && plan.lens.path == path);
    OK(kd_render_lens(renderer, scene, &plan, planes, NULL, &error));
    for (int k = 0; k < RAYS; k++) {
        double x = place(k % GRID), y = -place(k / GRID), nudge = 1e-6;
        const struct ks_path want = ks_trace(photon(scene, x, y), 16),
                             beside = ks_trace(photon(scene, x + nudge, y + nudge), 16);
        for (int order = 0; order < ORDERS; order++) {
            double w = planes[order * RAYS + k];
            bool sure = (want.crossings > order) == (beside.crossings > order);
            if (!sure || (want.crossings > order &&
                          (want.r[order] > 1e4 || want.r[order] < 1.001 * kd_scene_hole(scene)->outer)))
                continue;
            wrong += (w > 0) != (want.crossings > order) && !(w > 0 && w < 1e-4);
            if (w > 0 && want.crossings > order)
                errors[n++] =
                    fabs(1 / w / want.r[order] - 1) / (1 + fabs(log(beside.r[order] / want.r[order])) / nudge);
        }
    }
    qsort(errors, n, sizeof *errors, by_value);
    print_message("%s: %zu crossings, error %.1e in the median, %.1e at most\n", engine, n, errors[n / 2],
                  errors[n - 1]);
    assert_true(wrong == 0 && n > 30); /* few crossings are required, because a near camera that looks past the hole
                                          sees little of the plane */
    assert_true(errors[n / 2] < 2e-7 &&
                errors[n - 1] < 1e-5); /* bound: some roundings of a float, which are amplified near turning points */
}

static void moving(void **state)
{
    (void)state;
    static const double velocities[][3] = { { -0.5, 0, 0 }, { 0, 0.4, 0 }, { 0.3, -0.3, -0.5 } };
    for (size_t i = 0; i < sizeof velocities / sizeof *velocities; i++) {
        struct kd_scene far = scene_at(0.9, 70, 15), near = scene_at(-0.6, 120, 3);
        move(velocities[i][0], velocities[i][1], velocities[i][2]);
        labels(&far);
        labels(&near);
        map(&far, KD_LENS_CLOSED, "closed form");
        map(&near, KD_LENS_MAP, "steps");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(moving) };
    int skip = open_renderer();
    return skip ? skip : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
