/* Tests of Stokes Q and U of light curves. They are compared with three references: the light of each ray by the
 * Kerr-Schild oracles, which share no equation with the kernels; the loops of a face-on spot in closed form; and the
 * layers of the same picture. */
#include "kerr_schild.h"
#include "kerr_schild_transport.h"
#include "render/output/curve.h"
#include "render/output/format.h"

#include "render_support.h"

#include <math.h>

#define RADIAN (M_PI / 180)

static struct kd_scene spot_scene(double spin, double inclination, const char *field)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 29;
    scene.image.height = 21;
    scene.image.critical_factor = 1;
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = inclination;
    scene.camera.field_m = 28;
    scene.disk.model = KD_DISK_NONE;
    scene.spots.count = 1;
    scene.spots.at[0].brightness = 1;
    scene.spots.at[0].r = 8;
    scene.accuracy.orders = 2;
    scene.accuracy.profile = KD_PROFILE_HIGH;
    scene.polarization.model = KD_POLARIZATION_SYNCHROTRON;
    OK(kd_scene_set(&scene, "polarization.field", field, &error));
    return scene;
}

static struct kd_frame frame_by(struct kd_scene *scene, const struct kd_format *format)
{
    struct kd_frame frame;
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(scene, &error));
    OK(kd_format_plan(format, scene, &c, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static struct kd_light_report light(struct kd_scene *scene)
{
    struct kd_frame frame = frame_by(scene, kd_light_curve.frame);
    const struct kd_light_report report = frame.light;
    assert_true(report.measured);
    kd_frame_finish(&frame);
    return report;
}

static double worst;
static void near(double got, double want, double scale, double bound, const char *what)
{
    worst = fmax(worst, fabs(got - want) / scale);
    if (!(fabs(got - want) <= bound * scale))
        fail_msg("%s: %.9g, expected %.9g: off by %.2g, allowed %.2g", what, got, want, fabs(got - want) / scale,
                 bound);
}

/* Omega of the circular orbit in the plane, for which the radial force is 0: from the radial derivatives of g_tt = -(1
 * - 2/r), g_tphi = -2a/r, g_phiphi = r^2 + a^2 + 2a^2/r. */
static double orbit_omega(double a, double r)
{
    const double tt = -2 / (r * r), tphi = 2 * a / (r * r), phiphi = 2 * r - 2 * a * a / (r * r);
    return (-tphi + sqrt(tphi * tphi - tt * phiphi)) / phiphi;
}

enum { ORDERS = 2 };
struct oracle_ray {
    struct ks_path path;
    struct ks_polarized at[ORDERS];
    bool known[ORDERS];
};

static struct ks_screen screen_of(const struct kd_scene *scene, double x, double y)
{
    const struct ks_place at = { scene->spacetime.spin, scene->camera.r, scene->camera.inclination_deg * RADIAN };
    const double n = 1 / sqrt(1 + x * x + y * y), look[3] = { -n, -n * y, n * x }, top[3] = { 0, -1, 0 };
    if (isinf(scene->camera.r))
        return ks_screen_far(scene->spacetime.spin, scene->spacetime.charge, at.theta, x, y);
    const struct ks_frame frame = ks_zamo(&at);
    return ks_screen_near(&at, &frame, look, top);
}

/* I, Q and U of the spot. At each point the gas moves on the circular orbit through that point. The emitted light I_nu
 * ~ nu^-index is multiplied by g^(3 + index), where g is the inverse of the member `g`. The degree of polarisation is
 * 3/4. */
static void oracle_light(const struct kd_scene *scene, struct oracle_ray *rays, enum ks_field field, double isco,
                         double out[3])
{
    const struct kd_spot *spot = &scene->spots.at[0];
    const int width = scene->image.width, height = scene->image.height;
    const bool far = isinf(scene->camera.r);
    const double step = far ? scene->camera.field_m / width : 2 * tan(scene->camera.fov_deg * RADIAN / 2) / width;
    const double centre = spot->phase_deg * RADIAN + orbit_omega(scene->spacetime.spin, spot->r) * scene->top.time;
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < width * height; i++) {
        const double x = step * (i % width - 0.5 * (width - 1)), y = -step * (i / width - 0.5 * (height - 1)),
                     solid = far ? 1 : pow(1 + x * x + y * y, -1.5);
        for (int k = 0; k < rays[i].path.crossings; k++) {
            const double r = rays[i].path.r[k], phi = rays[i].path.phi[k] + scene->camera.azimuth_deg * RADIAN;
            const double dx = r * cos(phi) - spot->r * cos(centre), dy = r * sin(phi) - spot->r * sin(centre),
                         off = (dx * dx + dy * dy) / (2 * spot->size * spot->size);
            if (off > 12 || r < isco)
                continue;
            if (!rays[i].known[k]) {
                const struct ks_screen screen = screen_of(scene, x, y);
                rays[i].at[k] = ks_polarization(&screen, k, field, 0);
                rays[i].known[k] = true;
            }
            assert_true(rays[i].at[k].there && fabs(rays[i].at[k].r / r - 1) < 1e-3);
            const double light_ = step * step * solid * exp(-off) * pow(rays[i].at[k].g, -3 - spot->index);
            out[0] += light_;
            out[1] += 0.75 * light_ * cos(2 * rays[i].at[k].angle);
            out[2] += 0.75 * light_ * sin(2 * rays[i].at[k].angle);
        }
    }
}

/* The spot is at several points of the orbit, in both image orders, from infinity and from nearby. A wrong sign of the
 * field, of Q or of U would be an error of 100 %. */
static void test_oracle(void **state)
{
    (void)state;
    static const struct {
        double spin, isco, inclination, r;
        const char *name;
        enum ks_field field;
    } views[] = {
        { 0.7, 3.3931, 55, INFINITY, "vertical", KS_VERTICAL },
        { -0.5, 7.5546, 105, INFINITY, "toroidal", KS_TOROIDAL },
        { 0.9, 2.3209, 35, 30, "radial", KS_RADIAL },
    };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = spot_scene(views[v].spin, views[v].inclination, views[v].name);
        const int n = scene.image.width * scene.image.height;
        scene.camera.r = views[v].r;
        scene.camera.fov_deg = 45;
        scene.camera.azimuth_deg = 77;
        scene.spots.at[0] = (struct kd_spot) {
            .brightness = 1, .r = 9, .size = 1.1, .index = 0.6, .phase_deg = -50, .temperature_k = 6500
        };
        if (isfinite(scene.camera.r))
            OK(kd_scene_set(&scene, "camera.observer", "zamo", &error));
        struct oracle_ray *rays = calloc((size_t)n, sizeof *rays);
        for (int i = 0; i < n; i++) {
            const double step = isinf(scene.camera.r) ? scene.camera.field_m / scene.image.width
                                                      : 2 * tan(scene.camera.fov_deg * RADIAN / 2) / scene.image.width;
            const double x = step * (i % scene.image.width - 0.5 * (scene.image.width - 1)),
                         y = -step * (i / scene.image.width - 0.5 * (scene.image.height - 1));
            const double length = sqrt(1 + x * x + y * y), k[3] = { -1 / length, -y / length, x / length };
            rays[i].path =
                ks_trace(isinf(scene.camera.r)
                             ? ks_from_infinity(scene.spacetime.spin, cos(scene.camera.inclination_deg * RADIAN), x, y)
                             : ks_from_camera(scene.spacetime.spin, scene.camera.r,
                                              scene.camera.inclination_deg * RADIAN, true, k),
                         ORDERS);
        }
        for (int k = 0; k < 6; k++) {
            double want[3];
            scene.top.time = 500 + 29.3 * k;
            oracle_light(&scene, rays, views[v].field, views[v].isco, want);
            const struct kd_light_report got = light(&scene);
            assert_true(got.polarized && !got.circular);
            near(got.spots.flux, want[0], want[0], 5e-4, "I");
            near(got.spots.q, want[1], want[0], 5e-4, "Q");
            near(got.spots.u, want[2], want[0], 5e-4, "U");
            near(got.all.q, got.spots.q, want[0], 1e-6, "without a disk Q is the spot's");
            near(got.all.u, got.spots.u, want[0], 1e-6, "without a disk U is the spot's");
        }
        free(rays);
    }
    printf("against the oracle: I, Q and U within %.2g of I\n", worst);
}

/* Face-on and without spin the polarisation of a small spot's light, from outwards to +phi, is 0 for a toroidal field
 * and atan2(cos, v sin) for a vertical one, by the light's angle to the radius and the speed v of the orbit (R. Narayan
 * et al. 2021; Z. Gelles et al. 2021). Therefore Q and U make two loops in an orbit, in the spot's sense of rotation
 * (GRAVITY 2018; M. Wielgus et al. 2022). */
static void test_loops(void **state)
{
    (void)state;
    enum { STEPS = 24 };
    for (int vertical = 0; vertical < 2; vertical++) {
        struct kd_scene scene = spot_scene(0, 0, vertical ? "vertical" : "toroidal");
        double turned = 0, went = 0, angle = 0, place = 0, off = 0;
        scene.image.width = 320;
        scene.image.height = 320;
        scene.accuracy.orders = 1;
        scene.spots.at[0].size = 0.2;
        for (int k = 0; k <= STEPS; k++) {
            scene.top.time = 2 * M_PI * pow(8, 1.5) * k / STEPS;
            const struct kd_light s = light(&scene).spots;
            const double out = atan2(-s.x, s.y), r = 8, b = hypot(s.x, s.y), sine = b * sqrt(1 - 2 / r) / r,
                         v = 1 / sqrt(r - 2);
            const double want = out + (vertical ? atan2(sqrt(1 - sine * sine), v * sine) : 0), evpa = kd_light_evpa(&s);
            off = fmax(off, fabs(remainder(evpa - want, M_PI)));
            assert_true(kd_light_fraction(&s) < 0.75 &&
                        /* the degree is smaller than at a single point, because it is a mean over the spot */
                        kd_light_fraction(&s) > 0.74);
            turned += k ? remainder(atan2(s.u, s.q) - angle, 2 * M_PI) : 0;
            went += k ? remainder(out - place, 2 * M_PI) : 0;
            angle = atan2(s.u, s.q);
            place = out;
        }
        printf("face on, %s: (Q, U) goes round %.3f times while the spot does %.3f times; EVPA within %.3f degrees of "
               "the closed form\n",
               vertical ? "vertical" : "toroidal", turned / (2 * M_PI), went / (2 * M_PI), off / RADIAN);
        assert_true(fabs(turned / went - 2) < 1e-3 && fabs(fabs(went) - 2 * M_PI) < 1e-3);
        assert_true(off < 0.3 * RADIAN); /* tolerance: the closed form has an error of order size^2/r^2 */
    }
}

static double sum_of(const struct kd_frame *frame, const struct kd_scene *scene, const char *name)
{
    const struct kd_layer *layer = kd_frame_layer(frame, name);
    const double step = scene->camera.field_m / scene->image.width;
    double sum = 0;
    assert_non_null(layer);
    for (uint32_t i = 0; i < frame->width * frame->height; i++)
        sum += (double)((const float *)layer->data)[i];
    return sum * step * step;
}

/* The values of a light curve equal sums of the layers. Tested on a grid of rays, with more rays at the critical curve,
 * through a volume, and through a volume that polarises light itself. Pictures do not change. */
static void test_layers(void **state)
{
    (void)state;
    static const char *const settings[][2] = { { "image.critical_factor", "3" },
                                               { "volume.model", "uniform" },
                                               { "volume.model", "riaf" } };
    for (int i = 0; i < 3; i++) {
        struct kd_scene scene = spot_scene(0.6, 65, "vertical");
        if (i == 2) {
            OK(kd_scene_preset(&scene, "riaf", &error));
            scene.image.width = 24, scene.image.height = 20;
            scene.polarization.model = KD_POLARIZATION_TRANSFER;
        } else {
            scene.disk.model = KD_DISK_NOVIKOV_THORNE;
            scene.disk.opacity = 0.5;
            scene.image.samples = 2;
        }
        OK(kd_scene_set(&scene, settings[i][0], settings[i][1], &error));
        OK(kd_scene_set(&scene, "image.layers",
                        i == 2 ? "rgb,intensity,stokes_q,stokes_u,stokes_v" : "rgb,intensity,stokes_q,stokes_u",
                        &error));
        struct kd_frame frame = frame_by(&scene, &kd_format_npz);
        const struct kd_light *all = &frame.light.all;
        near(all->flux, sum_of(&frame, &scene, "intensity"), all->flux, 3e-6, "the sum of intensity");
        near(all->q, sum_of(&frame, &scene, "stokes_q"), all->flux, 3e-6, "the sum of stokes_q");
        near(all->u, sum_of(&frame, &scene, "stokes_u"), all->flux, 3e-6, "the sum of stokes_u");
        if (i == 2)
            near(all->v, sum_of(&frame, &scene, "stokes_v"), all->flux, 3e-6, "the sum of stokes_v");
        assert_true(frame.light.circular == (i == 2) && fabs(all->q) > 1e-3 * all->flux &&
                    fabs(all->u) > 1e-3 * all->flux);
        const struct kd_light_report curve = light(&scene);
        assert_memory_equal(&curve.all, all, sizeof *all);
        if (i == 2) { /* I of polarised transfer differs from that of unpolarised transfer */
            kd_frame_finish(&frame);
            continue;
        }
        scene.polarization.model = KD_POLARIZATION_NONE;
        OK(kd_scene_set(&scene, "image.layers", "rgb", &error));
        struct kd_frame plain = frame_by(&scene, &kd_format_npz);
        assert_true(!plain.light.polarized && plain.light.all.q == 0);
        assert_memory_equal(kd_frame_layer(&plain, "radiance")->data, kd_frame_layer(&frame, "radiance")->data,
                            12u * frame.width * frame.height);
        kd_frame_finish(&plain);
        kd_frame_finish(&frame);
    }
}

/* A missing crossing is stored as 1/r = 0. There a spot at azimuth 0 would give NaN. */
static void test_no_crossing(void **state)
{
    (void)state;
    struct kd_scene scene = spot_scene(0.5, 155, "vertical");
    scene.accuracy.orders = 3;
    const struct kd_light_report polarized = light(&scene);
    scene.polarization.model = KD_POLARIZATION_NONE;
    const struct kd_light_report plain = light(&scene);
    assert_true(plain.all.flux > 0);
    near(polarized.all.flux, plain.all.flux, plain.all.flux, 1e-6, "the flux of a spot at azimuth 0");
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_oracle), cmocka_unit_test(test_loops),
                                        cmocka_unit_test(test_layers), cmocka_unit_test(test_no_crossing) };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
