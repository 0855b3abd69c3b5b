/* Tests of the echo of a flash. Its light is compared with sums over rays of the Kerr-Schild oracle, both from the lamp
 * to the disk and from the disk to the observer. It is also compared with the impulse response of physics/disk/echo.h,
 * which uses other rays, a table and other sums than a picture. Far from the hole the ring is where a parabolic mirror
 * would focus it. */
#include "render_support.h"

#include "kerr_schild.h"
#include "physics/disk/echo.h"
#include "physics/disk/lamppost.h"
#include "physics/disk/line_profile.h"
#include "physics/spacetime/kerr.h"
#include "scene/hole.h"

#include <math.h>

#define RADIAN (M_PI / 180)

static struct kd_scene flash_scene(double spin, double charge, double inclination, double height)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 160;
    scene.image.height = 120;
    scene.image.critical_factor = 1; /* one ray a pixel */
    scene.spacetime.spin = spin;
    scene.spacetime.charge = charge;
    scene.camera.inclination_deg = inclination;
    scene.disk.model = KD_DISK_NONE;
    scene.disk.taper = 0;
    scene.disk.slow_light = true;
    scene.flash.brightness = 1;
    scene.flash.height = height;
    scene.style.exposure = 0;
    return scene;
}

/* The linear light of a picture, without showing it. */
static struct kd_light light(const struct kd_scene *scene)
{
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_needs needs = kd_needs_of(scene);
    needs.no_image = needs.light = true;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &needs, &c, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    assert_true(frame.light.measured);
    const struct kd_light all = frame.light.all;
    kd_frame_finish(&frame);
    return all;
}

static double off(double got, double want, double scale, double bound, const char *what)
{
    double by = fabs(got - want) / scale;
    if (!(by <= bound))
        fail_msg("%s: %.9g, expected %.9g: off by %.2g, allowed %.2g", what, got, want, by, bound);
    return by;
}

/* -1/(u^t)^2 of a circular motion in the plane, from the metric g_tt = -(1 - f), g_tphi = -a f, g_phiphi = r^2 + a^2 +
 * a^2 f with f = (2r - q^2)/r^2; and the angular velocity for which the radial force is 0, found by differences. */
static double line(const struct kd_spacetime *hole, double r, double omega)
{
    const double a = hole->spin, f = (2 * r - hole->charge * hole->charge) / (r * r);
    return f - 1 - 2 * a * f * omega + (r * r + a * a + a * a * f) * omega * omega;
}
static double orbit_omega(const struct kd_spacetime *hole, double r)
{
    const double h = 1e-3 * r;
    double low = 0, high = 1 / r;
    for (int i = 0; i < 60; i++) {
        const double o = 0.5 * (low + high), force = 8 * (line(hole, r + h, o) - line(hole, r - h, o)) -
                                                     line(hole, r + 2 * h, o) + line(hole, r - 2 * h, o);
        *(force < 0 ? &low : &high) = o;
    }
    return 0.5 * (low + high);
}

/* Light of the lamp on the disk by rays of the oracle, in steps of x = ln tan(delta/2), where delta is the angle from
 * the direction to the hole. A ray that arrives at the lamp, traced backwards, has the same radii and times as a ray
 * that leaves the lamp.
 */
enum { RAYS = 801 };
struct lit {
    int n;
    double r[RAYS], time[RAYS], light[RAYS], largest;
};
static const double AXIS = 1e-5; /* polar angle of the lamp; above 0, so that the lamp has an azimuth */

static double between(const struct lit *lit, const double *values, double r)
{
    int k = 0;
    while (k < lit->n - 2 && lit->r[k + 1] < r)
        k++;
    const double x = log(r / lit->r[k]) / log(lit->r[k + 1] / lit->r[k]);
    return values[k] + x * (values[k + 1] - values[k]);
}

static void light_up(struct lit *lit, const struct kd_scene *scene, double isco)
{
    const struct kd_spacetime *hole = &scene->spacetime;
    const double h = scene->flash.height, a = hole->spin, q = hole->charge, step = 12. / RAYS,
                 source = sqrt(1 - (2 * h - q * q) / (h * h + a * a));
    double log_r[RAYS], x[RAYS];
    *lit = (struct lit) { 0 };
    for (int i = 0; i < RAYS; i++) {
        const double at = -6 + step * i, k[3] = { tanh(at), 1 / cosh(at), 0 };
        const struct ks_path path = ks_trace(ks_from_camera_charged(a, q, h, AXIS, false, k), 1);
        if (!path.crossings || path.r[0] < 0.7 * isco || path.r[0] > 2 * scene->disk.outer)
            continue;
        x[lit->n] = at, log_r[lit->n] = log(path.r[0]);
        lit->r[lit->n] = path.r[0], lit->time[lit->n++] = path.delay[0];
    }
    assert_true(lit->n > 50 && lit->r[0] < isco && lit->r[lit->n - 1] > scene->disk.outer);
    for (int k = 1; k + 1 < lit->n; k++) {
        const double r = lit->r[k], ut = 1 / sqrt(-line(hole, r, orbit_omega(hole, r))), g = ut * source,
                     sine = 1 / cosh(x[k]), slope = (log_r[k + 1] - log_r[k - 1]) / (2 * step);
        lit->light[k] = source * pow(g, scene->flash.photon_index - 1) * sine * sine / (slope * r * r);
    }
    lit->light[0] = lit->light[1], lit->light[lit->n - 1] = lit->light[lit->n - 2]; /* beyond the edges */
    lit->largest = between(lit, lit->light, isco);
    for (int k = 0; k < lit->n; k++)
        if (lit->r[k] > isco && lit->r[k] < scene->disk.outer)
            lit->largest = fmax(lit->largest, lit->light[k]);
}

/* Light of the crossing of the ray with the plane. */
static double crossing_light(const struct kd_scene *scene, const struct lit *lit, const struct ks_photon *p,
                             const struct ks_path *path, int k)
{
    const struct kd_spacetime *hole = &scene->spacetime;
    const double r = path->r[k], omega = orbit_omega(hole, r),
                 g = sqrt(-line(hole, r, omega)) / (p->energy - omega * p->momentum),
                 late = scene->top.time - (scene->disk.slow_light ? path->delay[k] : 0) - scene->flash.start -
                        between(lit, lit->time, r);
    return between(lit, lit->light, r) / lit->largest * pow(g, 3 + scene->flash.index) *
           exp(-0.5 * pow(late / scene->flash.duration, 2));
}

enum { ORDERS = 2 };

static void test_oracle(void **state)
{
    (void)state;
    static const struct {
        double spin, charge, inclination, r, height;
    } views[] = {
        { 0, 0, 60, INFINITY, 6 },     { 0.998, 0, 30, INFINITY, 3 }, { -0.6, 0, 120, INFINITY, 10 },
        { 0.5, 0.8, 75, INFINITY, 5 }, { 0.9, 0, 40, 40, 12 },
    };
    double worst = 0;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = flash_scene(views[v].spin, views[v].charge, views[v].inclination, views[v].height);
        static struct lit lit;
        const double isco = kd_kerr_isco(kd_scene_hole(&scene));
        scene.camera.r = views[v].r;
        scene.camera.field_m = 30;
        scene.camera.fov_deg = 40;
        scene.image.width = 67;
        scene.image.height = 49;
        scene.accuracy.orders = ORDERS;
        scene.accuracy.profile = KD_PROFILE_HIGH;
        scene.disk.outer = 14;
        scene.flash.photon_index = 1.7;
        scene.flash.index = 0.6;
        scene.flash.start = 11;
        scene.flash.duration = 3;
        light_up(&lit, &scene, isco);
        const int width = scene.image.width, n = width * scene.image.height;
        const bool far = isinf(scene.camera.r);
        const double theta = scene.camera.inclination_deg * RADIAN,
                     step = far ? scene.camera.field_m / width : 2 * tan(scene.camera.fov_deg * RADIAN / 2) / width;
        struct ks_photon *photons = malloc((size_t)n * sizeof *photons);
        struct ks_path *paths = malloc((size_t)n * sizeof *paths);
        double *solid = malloc((size_t)n * sizeof *solid);
        for (int i = 0; i < n; i++) {
            const double x = step * (i % width - 0.5 * (width - 1)),
                         y = -step * (i / width - 0.5 * (scene.image.height - 1)), length = sqrt(1 + x * x + y * y),
                         k[3] = { -1 / length, -y / length, x / length };
            const struct kd_spacetime *hole = &scene.spacetime;
            photons[i] = far ? ks_from_infinity_charged(hole->spin, hole->charge, cos(theta), x, y)
                             : ks_from_camera_charged(hole->spin, hole->charge, scene.camera.r, theta, false, k);
            paths[i] = ks_trace(photons[i], ORDERS);
            solid[i] = step * step * (far ? 1 : pow(length, -3));
        }
        for (int k = 0; k < 6; k++) {
            double want = 0;
            scene.disk.slow_light = k < 4;
            scene.top.time = scene.flash.start + (far || k >= 4 ? 0 : scene.camera.r) + 10 + 4 * (k % 4);
            for (int i = 0; i < n; i++)
                for (int c = 0; c < paths[i].crossings; c++)
                    if (paths[i].r[c] > isco && paths[i].r[c] < scene.disk.outer)
                        want += solid[i] * crossing_light(&scene, &lit, &photons[i], &paths[i], c);
            worst = fmax(worst, off(light(&scene).flux, want, want, 1e-3, "flux"));
        }
        free(photons);
        free(paths);
        free(solid);
    }
    printf("against the oracle: flux within %.2g\n", worst);
}

/* The number of the echo's photons over time equals the impulse response convolved with the flash. */
#ifndef SIDE
#define SIDE 600
#endif
enum { TIMES = 4000, FRAMES = 40 };
static void test_impulse_response(void **state)
{
    (void)state;
    static const struct {
        double spin, charge, inclination, height;
        enum kd_limb limb;
    } cases[] = {
        { 0, 0, 60, 10, KD_LIMB_ISOTROPIC },
        { 0.998, 0, 30, 5, KD_LIMB_LAOR },
        { 0.5, 0.6, 75, 8, KD_LIMB_SCATTERING },
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct kd_scene scene = flash_scene(cases[c].spin, cases[c].charge, cases[c].inclination, cases[c].height);
        scene.accuracy.orders = 1;
        scene.image.width = scene.image.height = SIDE;
        scene.camera.field_m = 68;
        scene.disk.outer = 30;
        scene.disk.atmosphere = (int32_t)(cases[c].limb == KD_LIMB_LAOR         ? KD_ATMOSPHERE_LAOR
                                          : cases[c].limb == KD_LIMB_SCATTERING ? KD_ATMOSPHERE_SCATTERING
                                                                                : KD_ATMOSPHERE_ISOTROPIC);
        scene.flash.duration = 1.5;
        scene.flash.start = -200;
        const struct kd_hole *hole = kd_scene_hole(&scene);
        static struct kd_disk_image image;
        static double share[TIMES];
        assert_true(kd_disk_image_init(&image, hole, cases[c].inclination * RADIAN));
        struct kd_echo_params params = { image.isco, scene.disk.outer, scene.flash.photon_index, cases[c].limb };
        assert_true(kd_corona_source_of(hole, 0, cases[c].height, KD_CORONA_STATIC, &params.source));
        struct kd_echo echo;
        const double edges[] = { 1e-3, 4 }, first = -20, step = 0.05, sharp = 1 / scene.flash.duration;
        OK(kd_echo_impulse(&image, &params, edges, 1, first, step, TIMES, share, &echo, &error));
        /* Number of all photons divided by the largest illumination, from the sum for the line, which is in units of
         * epsilon. */
        const struct kd_line_params line_params = { .inner = image.isco,
                                                    .outer = scene.disk.outer,
                                                    .emissivity = KD_LINE_LAMPPOST,
                                                    .height = cases[c].height,
                                                    .photon_index = scene.flash.photon_index,
                                                    .limb = cases[c].limb };
        struct kd_line_profile profile;
        double one, largest = 0, worst = 0, brightest = 0, sum = 0, want[FRAMES] = { 0 };
        OK(kd_line_profile(&image, &line_params, edges, 1, &one, &profile, &error));
        struct kd_lamppost lamp;
        assert_true(
            kd_lamppost_init(&lamp, hole, cases[c].height, scene.flash.photon_index, image.isco, scene.disk.outer));
        for (double r = image.isco; r < scene.disk.outer; r *= 1.01)
            largest = fmax(largest, kd_lamppost_at(&lamp, r));
        const double all = profile.total / largest * kd_limb_scale(cases[c].limb), between_frames = 2.5;
        for (int k = 0; k < FRAMES; k++) {
            const double time = echo.direct.time + first + 15 + between_frames * k;
            for (int i = 0; i < TIMES; i++)
                want[k] +=
                    all * share[i] * exp(-0.5 * pow(sharp * (time - echo.direct.time - first - step * (i + 0.5)), 2));
            brightest = fmax(brightest, want[k]);
        }
        for (int k = 0; k < FRAMES; k++) {
            scene.top.time = scene.flash.start + echo.direct.time + first + 15 + between_frames * k;
            const double got = light(&scene).flux;
            sum += got * between_frames;
            worst = fmax(worst, off(got, want[k], brightest, 3e-3, "light curve"));
        }
        off(sum, all * scene.flash.duration * sqrt(2 * M_PI), sum, 3e-3, "all light");
        printf("a = %g, %g degrees: light curve within %.2g of its peak of the impulse response\n", cases[c].spin,
               cases[c].inclination, worst);
    }
}

/* In flat space, light from the lamp at z = h that is scattered at x reaches an observer in the direction n after the
 * time |x - h| - n x. The ring is therefore a section of a paraboloid. To first order, the hole delays light on the way
 * to x by 2 ln((r_1 + r_2 + d)/(r_1 + r_2 - d)) (I. I. Shapiro 1964), with isotropic radii r - 1. On the way to the
 * observer the delay is 2 ln(2/(r + n x)), after r_o + 2 ln r_o is subtracted. The ring appears at the impact parameter
 * b of A. M. Beloborodov 2002, ApJ 566, L85. */
static void test_far_out(void **state)
{
    (void)state;
    static const double inclinations[] = { 0, 30, 60 };
    double worst = 0;
    for (int k = 0; k < 6; k++) {
        const double i = inclinations[k / 2] * RADIAN, near = k % 2 ? 1 : -1, h = 60, r = 600, rho = r - 1,
                     d = hypot(rho, h - 1), along = near * rho * sin(i), /* below the hole on the near side */
            from = 1 - (1 - near * sin(i)) * (1 - 2 / r), b = r * sqrt((1 - from * from) / (1 - 2 / r));
        struct kd_scene scene = flash_scene(0, 0, i / RADIAN, h);
        scene.disk.outer = 2000;
        scene.accuracy.orders = 1;
        scene.top.time = d + 2 * log((rho + h - 1 + d) / (rho + h - 1 - d)) - along + 2 * log(2 / (rho + along)) - 1;
        scene.flash.duration = 2;
        scene.image.width = 1;
        scene.image.height = 400;
        scene.camera.field_m = 0.25;
        scene.camera.centre_beta = -near * b;
        const struct kd_light got = light(&scene);
        assert_true(got.flux > 0);
        worst = fmax(worst, off(-near * got.y, b, r, 2e-3, "ring far out"));
    }
    printf("far out the ring is within %.2g of its radius\n", worst);
}

/* A repeating flash gives the same picture at each period, and between the periods the picture of a single flash.
 * Without slow light the ring is round. Nothing is visible before the first flash. */
static void test_course(void **state)
{
    (void)state;
    struct kd_scene scene = flash_scene(0.7, 0, 50, 8);
    scene.disk.outer = 20;
    scene.flash.start = 3;
    scene.top.time = 20;
    const double single = light(&scene).flux;
    scene.top.time = -30;
    assert_true(single > 0 && light(&scene).flux < 1e-9 * single);
    scene.flash.period = 150;
    for (int k = -3; k < 5; k++) {
        scene.top.time = 20 + scene.flash.period * k * (k == 4 ? 1e6 : 1);
        off(light(&scene).flux, single, single, 1e-6, "repeated");
    }
    scene.flash.brightness = 3;
    off(light(&scene).flux, 3 * single, single, 1e-5, "brightness");
}

/* Lens maps do not change with time. Without a flash a lens map has no delays. An opaque disk hides the echo below it.
 * */
static void test_plans(void **state)
{
    (void)state;
    struct kd_scene scene = flash_scene(0.9, 0, 60, 8);
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(kd_plan_holds(&plan.lens, KD_LENS_DELAY) && !kd_plan_holds(&plan.lens, KD_LENS_PHI));
    scene.flash.brightness = 0;
    scene.disk.model = KD_DISK_NOVIKOV_THORNE;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_false(kd_plan_holds(&plan.lens, KD_LENS_DELAY));
    const double disk = light(&scene).flux;
    double opaque = 0, all = 0, first = 0;
    for (scene.top.time = 12; scene.top.time < 40; scene.top.time += 4) {
        scene.disk.model = KD_DISK_NOVIKOV_THORNE;
        scene.flash.brightness = 1e-30;
        off(light(&scene).flux, disk, disk, 1e-6, "without a flash");
        scene.flash.brightness = 100;
        opaque += light(&scene).flux - disk;
        scene.disk.model = KD_DISK_NONE;
        all += light(&scene).flux;
        scene.accuracy.orders = 1;
        first += light(&scene).flux;
        scene.accuracy.orders = 3;
    }
    printf("behind the disk: %.3g of the echo\n", all / first - 1);
    assert_true(opaque > first && opaque < 0.999 * all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_oracle),  cmocka_unit_test(test_impulse_response),
        cmocka_unit_test(test_far_out), cmocka_unit_test(test_course),
        cmocka_unit_test(test_plans),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
