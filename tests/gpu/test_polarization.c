/* Tests of the direction of polarisation. It is compared with an oracle that transports vectors along rays in
 * Kerr-Schild coordinates (kerr_schild_transport.h) and shares no equation with the kernels' Walker-Penrose constant.
 * The Stokes layers must be consistent. The light of an atmosphere is compared with the oracle's angle of emission. */
#include "kerr_schild_transport.h"
#include "physics/disk/colour.h"
#include "physics/disk/limb.h"
#include "physics/disk/returning.h"
#include "physics/disk/scattering.h"
#include "physics/spacetime/kerr.h"
#include "render/device/device_internal.h"
#include "render/output/format.h"
#include "render/view/camera.h"

#include "render_support.h"

#include <math.h>

enum { WIDTH = 28, HEIGHT = 20, PIXELS = WIDTH * HEIGHT, STRIDE = 13 };
#define RADIAN (M_PI / 180)
#define DEGREES(x) ((x) / RADIAN)
#define MOST 0.005 /* tolerance in degrees: four times the largest error of single precision */

struct view {
    double spin, inclination, r, roll;
    const char *set[3][2];
    enum ks_field field;
};

static const struct view views[] = {
    { 0, 60, INFINITY, 0, { { "polarization.field", "toroidal" } }, KS_TOROIDAL },
    { 0.9, 68, INFINITY, 0, { { "polarization.field", "toroidal" } }, KS_TOROIDAL },
    { 0.9, 20, INFINITY, 35, { { "polarization.field", "radial" } }, KS_RADIAL },
    { 0.998, 75, INFINITY, 0, { { "polarization.field", "radial" } }, KS_RADIAL },
    { 0.7, 130, INFINITY, 0, { { "polarization.field", "vertical" } }, KS_VERTICAL },
    { -0.6, 90, INFINITY, 0, { { "polarization.field", "toroidal" } }, KS_TOROIDAL },
    { 0.3,
      60,
      INFINITY,
      0,
      { { "disk.model", "particles" }, { "polarization.field", "radial" }, { "camera.field_m", "14" } },
      KS_RADIAL },
    { 0.5, 65, INFINITY, 0, { { "polarization.model", "scattering" } }, KS_VERTICAL },
    { 0, 60, INFINITY, 0, { { "spacetime.charge", "0.95" }, { "polarization.field", "toroidal" } }, KS_TOROIDAL },
    { 0.6, 70, INFINITY, 0, { { "spacetime.charge", "0.75" }, { "polarization.field", "vertical" } }, KS_VERTICAL },
    { 0.6, 40, INFINITY, 35, { { "spacetime.charge", "0.75" }, { "polarization.field", "radial" } }, KS_RADIAL },
    { 0.9, 70, 25, 20, { { "camera.observer", "zamo" } }, KS_TOROIDAL },
    { 0.9,
      60,
      8,
      0,
      { { "camera.observer", "zamo" }, { "camera.projection", "equirectangular" }, { "polarization.field", "radial" } },
      KS_RADIAL },
    { 0.7, 100, 12, 0, { { "camera.observer", "infall" }, { "polarization.field", "vertical" } }, KS_VERTICAL },
};

static struct kd_scene scene_of(const struct view *view, const char *layers)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.critical_factor = 1;
    scene.spacetime.spin = view->spin;
    scene.camera.inclination_deg = view->inclination;
    scene.camera.r = view->r;
    scene.camera.roll_deg = view->roll;
    scene.camera.field_m = 34;
    scene.camera.fov_deg = 60;
    scene.disk.outer = 15;
    scene.disk.taper = 0;
    scene.disk.opacity = 0.5;
    scene.accuracy.orders = 2;
    scene.polarization.model = KD_POLARIZATION_SYNCHROTRON;
    OK(kd_scene_set(&scene, "image.layers", layers, &error));
    for (size_t i = 0; i < 3 && view->set[i][0]; i++)
        OK(kd_scene_set(&scene, view->set[i][0], view->set[i][1], &error));
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

static struct kd_frame frame_of(struct kd_scene *scene)
{
    struct kd_frame frame;
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    OK(kd_format_plan(&kd_format_npy, scene, &c, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static const float *layer(const struct kd_frame *frame, const char *name)
{
    const struct kd_layer *found = kd_frame_layer(frame, name);
    if (!found)
        fail_msg("the frame has no layer %s", name);
    return found->data;
}

/* The photon of a pixel's centre. The oracle's observers at infinity have no roll, so this function rotates the screen.
 * */
static struct ks_screen screen_of(const struct kd_scene *scene, int pixel)
{
    const double theta = scene->camera.inclination_deg * RADIAN, roll = scene->camera.roll_deg * RADIAN, c = cos(roll),
                 s = sin(roll);
    const bool far = isinf(scene->camera.r), sphere = scene->camera.projection == KD_PROJECTION_EQUIRECTANGULAR;
    const double across = pixel % WIDTH - 0.5 * (WIDTH - 1), upwards = 0.5 * (HEIGHT - 1) - pixel / WIDTH;
    const double step = (far ? scene->camera.field_m : 2 * tan(scene->camera.fov_deg * RADIAN / 2)) / WIDTH;
    double x = step * across, y = step * upwards;
    if (far) { /* the camera is rotated clockwise */
        const struct ks_screen flat =
            ks_screen_far(scene->spacetime.spin, scene->spacetime.charge, theta, x * c + y * s, y * c - x * s);
        struct ks_screen turned = flat;
        for (int i = 0; i < 4; i++) {
            turned.right[i] = c * flat.right[i] - s * flat.up[i];
            turned.up[i] = s * flat.right[i] + c * flat.up[i];
        }
        return turned;
    }
    const struct ks_place at = { scene->spacetime.spin, scene->camera.r, theta };
    const struct ks_frame frame = scene->camera.observer == KD_OBSERVER_INFALL ? ks_rain(&at) : ks_zamo(&at);
    double ahead = 1, n = 1 / sqrt(1 + x * x + y * y), right = n * (x * c + y * s), up = n * (y * c - x * s), look[3],
           top[3] = { 0, -c, s };
    if (sphere) {
        const double longitude = 2 * M_PI * across / WIDTH, latitude = M_PI * upwards / HEIGHT;
        right = cos(latitude) * sin(longitude), up = sin(latitude), ahead = cos(latitude) * cos(longitude), n = 1;
    }
    look[0] = -ahead * n, look[1] = -up, look[2] = right;
    return ks_screen_near(&at, &frame, look, top);
}

/* Each point is tested at the image order whose light is visible there. Half a turn round the hole amplifies
 * single-precision errors by about 20. The tolerance for order 1 is therefore ten times as large. Its radius is
 * compared as well, to check that the two methods follow the same ray. */
static void judge(const struct view *view)
{
    static const char *const names[] = { "evpa_0", "evpa_1" }, *const parts[] = { "polarization_fraction_0",
                                                                                  "polarization_fraction_1" };
    struct kd_scene scene = scene_of(view, "evpa_0,evpa_1,polarization_fraction_0,polarization_fraction_1,r_0,r_1");
    struct kd_frame frame = frame_of(&scene);
    const double isco = kd_kerr_isco(kd_hole(view->spin));
    double worst = 0;
    int compared = 0, behind = 0, fallen = 0;
    for (int k = 0; k < PIXELS; k += STRIDE)
        for (int n = 0; n < 2; n++) {
            const double got = (double)layer(&frame, names[n])[k], part = (double)layer(&frame, parts[n])[k];
            const struct ks_screen screen = screen_of(&scene, k);
            if (isnan(got))
                continue;
            const struct ks_polarized want =
                ks_polarization(&screen, n, view->field, scene.disk.model == KD_DISK_PARTICLES ? isco : 0);
            assert_true(want.there);
            const double off = fabs(remainder(got - want.angle, M_PI)), r = (double)layer(&frame, n ? "r_1" : "r_0")[k];
            assert_true(fabs(r / want.r - 1) < (n ? 1e-3 : 1e-5));
            if (!(DEGREES(off) < (n ? 10 * MOST : MOST)))
                fail_msg("a %g, i %g: EVPA of order %d at pixel %d, r %.4f: %.5f degrees, by the oracle %.5f",
                         view->spin, view->inclination, n, k, r, DEGREES(got), DEGREES(want.angle));
            if (scene.polarization.model == KD_POLARIZATION_SCATTERING) {
                struct kd_scattered light;
                kd_scattered_light(&want.cosine, 1, &light);
                assert_true(fabs(part - kd_scattered_fraction(&light)) < 1e-5);
            } else {
                assert_true(fabs(part - 0.75) < 1e-6);
            }
            worst = fmax(worst, off);
            compared++, behind += n, fallen += want.falls;
        }
    printf("a %g, i %g, r %g: %d places, %d of order 1, %d where gas falls; off by %.5f degrees at most\n", view->spin,
           view->inclination, view->r, compared, behind, fallen, DEGREES(worst));
    assert_true(compared >= 4 && (fallen > 0) == (scene.disk.model == KD_DISK_PARTICLES));
    kd_frame_finish(&frame);
}

static void test_evpa(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof views / sizeof *views; i++)
        judge(&views[i]);
}

/* A pixel's Q and U are means over its rays. Its angle and degree follow from these means. Orders add up to the total.
 * The same is tested for the march of a volume. */
static void test_stokes(void **state)
{
    (void)state;
    static const char *const settings[][2] = { { "image.samples", "1" },
                                               { "image.samples", "2" },
                                               { "image.critical_factor", "4" },
                                               { "volume.model", "uniform" } };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        const bool marched = i == 3;
        struct kd_scene scene =
            scene_of(&views[1], marched ? "intensity,stokes_q,stokes_u,evpa,polarization_fraction"
                                        : "intensity,stokes_q,stokes_u,evpa,polarization_fraction,stokes_q_0,stokes_q_"
                                          "1,intensity_0,stokes_u_0,stokes_u_1");
        scene.polarization.order = 0.8;
        scene.image.samples = marched ? 2 : 1;
        OK(kd_scene_set(&scene, settings[i][0], settings[i][1], &error));
        struct kd_frame frame = frame_of(&scene);
        const float *light = layer(&frame, "intensity"), *q = layer(&frame, "stokes_q"), *u = layer(&frame, "stokes_u");
        const float *evpa = layer(&frame, "evpa"), *part = layer(&frame, "polarization_fraction");
        int lit = 0, mixed = 0;
        for (int k = 0; k < PIXELS; k++) {
            const double size = hypot((double)q[k], (double)u[k]), full = 0.8 * 0.75;
            assert_true(size <= full * (double)light[k] * (1 + 1e-5));
            assert_true(isnan(evpa[k]) == !(size > 0) && isnan(part[k]) == !(light[k] > 0));
            if (!(size > 0))
                continue;
            assert_true(fabs((double)part[k] * (double)light[k] / size - 1) < 1e-5);
            assert_true(fabs(remainder((double)evpa[k] - 0.5 * atan2((double)u[k], (double)q[k]), M_PI)) < 1e-6);
            if (!marched) {
                assert_true(fabs((double)layer(&frame, "stokes_q_0")[k] + (double)layer(&frame, "stokes_q_1")[k] -
                                 (double)q[k]) < 1e-6 * (double)light[k]);
                assert_true(fabs((double)layer(&frame, "stokes_u_0")[k] + (double)layer(&frame, "stokes_u_1")[k] -
                                 (double)u[k]) < 1e-6 * (double)light[k]);
            }
            lit++, mixed += size < 0.99 * full * (double)light[k];
        }
        assert_true(lit > PIXELS / 8 && mixed > 10);
        kd_frame_finish(&frame);
    }
}

/* Face-on and without spin light stays in a plane through the axis, and its direction relative to that plane is
 * unchanged. From the ray's angle to the radius in the rest frame, sin = b sqrt(1 - 2/r)/r, and the aberration by the
 * orbital motion, whose speed is 1/sqrt(r - 2), the angle of the electric field, from outwards to +phi, is for a
 * toroidal field 0,  a radial one atan2(sin, -v cos),  a vertical one atan2(cos, v sin) (Narayan et al. 2021, ApJ 912,
 * 35; Gelles et al. 2021, PRD 104, 044060), where the closed form of Beloborodov 2002 has cos = 2/r, accurate to
 * relative order 1/r.
 */
static void test_face_on(void **state)
{
    (void)state;
    static const char *const fields[] = { "toroidal", "radial", "vertical" };
    for (int i = 0; i < 3; i++) {
        const struct view view = { 0, 0, INFINITY, 0, { { "polarization.field", fields[i] } }, KS_TOROIDAL };
        struct kd_scene scene = scene_of(&view, "evpa_0,r_0");
        struct kd_frame frame = frame_of(&scene);
        double worst = 0, by_rule = 0;
        int seen = 0;
        for (int k = 0; k < PIXELS; k++) {
            const double got = (double)layer(&frame, "evpa_0")[k], r = (double)layer(&frame, "r_0")[k];
            const double right = k % WIDTH - 0.5 * (WIDTH - 1), up = 0.5 * (HEIGHT - 1) - k / WIDTH,
                         out = atan2(-right, up), b = hypot(right, up) * scene.camera.field_m / WIDTH;
            if (isnan(got))
                continue;
            for (int rule = 0; rule < 2; rule++) {
                const double sine = rule ? sqrt(1 - 4 / (r * r)) : b * sqrt(1 - 2 / r) / r,
                             cosine = rule ? 2 / r : sqrt(1 - sine * sine), v = 1 / sqrt(r - 2);
                const double want = out + (i == 0 ? 0 : i == 1 ? atan2(sine, -v * cosine) : atan2(cosine, v * sine));
                double *most = rule ? &by_rule : &worst;
                *most = fmax(*most, fabs(remainder(got - want, M_PI)));
            }
            seen++;
        }
        printf("face on, %s: %d places, off by %.5f degrees; by cos = 2/r %.2f\n", fields[i], seen, DEGREES(worst),
               DEGREES(by_rule));
        assert_true(seen > 100 && DEGREES(worst) < 5 * MOST && DEGREES(by_rule) < 0.5);
        kd_frame_finish(&frame);
    }
}

/* Pixels of a disk with an atmosphere. Their ratio to an isotropic disk's is f(mu), and their brightness is f(mu) g^4
 * F, with mu, g and r from the ray in Kerr-Schild coordinates in double precision. Gas that falls from the ISCO stays
 * isotropic. Within a disk of half opacity, order 1 is dimmed by the same factor in both disks. */
static void judge_atmosphere(const struct view *view, const char *word, enum kd_limb law)
{
    struct kd_scene even = scene_of(view, "intensity_0,intensity_1"), dark = even;
    OK(kd_scene_set(&dark, "disk.atmosphere", word, &error));
    struct kd_frame frames[2] = { frame_of(&even), frame_of(&dark) };
    const double isco = kd_kerr_isco(kd_hole(view->spin));
    const bool plain = even.disk.model != KD_DISK_PARTICLES && even.disk.emission_opacity == 0;
    double worst[2] = { 0, 0 }, absolute = 0, least = 1;
    int compared = 0, fallen = 0;
    for (int k = 0; k < PIXELS; k += STRIDE)
        for (int n = 0; n < 2; n++) {
            const char *const name = n ? "intensity_1" : "intensity_0";
            const double before = (double)layer(&frames[0], name)[k], after = (double)layer(&frames[1], name)[k];
            const struct ks_screen screen = screen_of(&even, k);
            if (!(before > 0))
                continue;
            const struct ks_polarized want =
                ks_polarization(&screen, n, view->field, even.disk.model == KD_DISK_PARTICLES ? isco : 0);
            assert_true(want.there);
            const double f = want.falls ? 1 : kd_limb_at(law, want.cosine) * kd_limb_scale(law),
                         off = fabs(after / before / f - 1);
            if (!(off < (n ? 1e-3 : 2e-5)))
                fail_msg("a %g, i %g, %s: order %d at pixel %d has %.7f times the isotropic light, by the oracle %.7f",
                         view->spin, view->inclination, word, n, k, after / before, f);
            worst[n] = fmax(worst[n], off);
            if (n == 0 && plain)
                absolute = fmax(absolute, fabs(after / (f * pow(kd_disk_heat(&dark, want.r) / want.g, 4)) - 1));
            least = fmin(least, f);
            compared++, fallen += want.falls;
        }
    printf("a %g, i %g, r %g, %s: %d places, %d where gas falls; ratio off by %.1e, of order 1 by %.1e; brightness by "
           "%.1e; f from %.3f on\n",
           view->spin, view->inclination, view->r, word, compared, fallen, worst[0], worst[1], absolute, least);
    assert_true(absolute < 2e-4 && compared >= 4 && (fallen > 0) == (even.disk.model == KD_DISK_PARTICLES));
    kd_frame_finish(&frames[0]);
    kd_frame_finish(&frames[1]);
}

static void test_atmosphere(void **state)
{
    (void)state;
    static const struct view deep = { 0.7, 75, INFINITY, 0, { { "disk.emission_opacity", "10" } }, KS_VERTICAL };
    for (size_t i = 1; i < sizeof views / sizeof *views; i += 2) {
        judge_atmosphere(&views[i], "laor", KD_LIMB_LAOR);
        judge_atmosphere(&views[i], "scattering", KD_LIMB_SCATTERING);
    }
    judge_atmosphere(&views[6], "scattering", KD_LIMB_SCATTERING);
    judge_atmosphere(&deep, "scattering", KD_LIMB_SCATTERING);
}

/* Pixels of a disk with returning light: their brightness is that of black bodies of its fluxes and temperatures, at
 * the radius and the redshift of rays in Kerr-Schild coordinates. */
static void judge_returning(const struct view *view, const char *word, const char *albedo, const char *band)
{
    struct kd_scene scene = scene_of(view, "intensity_0");
    const struct kd_hole hole = kd_hole_charged(scene.spacetime.spin, scene.spacetime.charge);
    struct kd_returning table;
    struct kd_reflection reflection;
    OK(kd_scene_set(&scene, "disk.returning", word, &error));
    OK(kd_scene_set(&scene, "disk.albedo", albedo, &error));
    OK(kd_scene_set(&scene, "disk.band", band, &error));
    kd_returning_init(&table, &hole, KD_LIMB_ISOTROPIC);
    kd_reflection_init(&reflection, &table, *word == 'r' ? strtod(albedo, NULL) : 0);
    const double peak = scene.disk.peak_temperature_k, unit = pow(table.largest, 0.25);
    const bool visible = *band == 'v';
    struct kd_frame frame = frame_of(&scene);
    double worst = 0;
    int compared = 0;
    for (int k = 0; k < PIXELS; k += 3) {
        const struct ks_screen screen = screen_of(&scene, k);
        const double got = (double)layer(&frame, "intensity_0")[k];
        if (!(got > 0))
            continue;
        const struct ks_polarized at = ks_polarization(&screen, 0, view->field, 0);
        assert_true(at.there);
        const struct kd_reflected light = kd_reflection_at(&reflection, &table, at.r);
        const double g = 1 / at.g, temperatures[2] = { pow(light.absorbed, 0.25), light.warm },
                     fluxes[2] = { light.absorbed, light.flux };
        double want = 0;
        for (int part = 0; part < 2; part++)
            want += scene.disk.opacity * fluxes[part] / table.largest * pow(g, 4) *
                    (visible ? kd_colour_luminous_fraction(peak * g * temperatures[part] / unit) /
                                   kd_colour_luminous_fraction(peak)
                             : 1);
        worst = fmax(worst, fabs(got / want - 1));
        compared++;
    }
    printf("a %g, Q %g, i %g, %s, albedo %s, %s: %d pixels, brightness off by %.1e\n", view->spin,
           scene.spacetime.charge, view->inclination, word, albedo, band, compared, worst);
    assert_true(compared >= 20 && worst < (visible ? 2e-3 : 3e-4));
    kd_frame_finish(&frame);
}

static void test_returning(void **state)
{
    (void)state;
    static const size_t taken[] = { 1, 3, 5, 9 };
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        judge_returning(&views[taken[i]], "thermalised", "0.5", "bolometric");
        judge_returning(&views[taken[i]], "reflected", "0.7", "bolometric");
        judge_returning(&views[taken[i]], "reflected", "1", "visible");
    }
}

/* The optical depth of gas is derived from its flux. Reflection does not change the flux, so the disk's brightness does
 * not depend on the albedo. */
static void test_depth_of_reflecting_gas(void **state)
{
    (void)state;
    static const char *const words[2] = { "thermalised", "reflected" };
    struct kd_frame frames[2];
    for (int i = 0; i < 2; i++) {
        struct kd_scene scene = scene_of(&views[3], "intensity_0");
        OK(kd_scene_set(&scene, "disk.emission_opacity", "3", &error));
        OK(kd_scene_set(&scene, "disk.returning", words[i], &error));
        OK(kd_scene_set(&scene, "disk.albedo", "1", &error));
        frames[i] = frame_of(&scene);
    }
    int compared = 0;
    double worst = 0;
    for (int k = 0; k < PIXELS; k++) {
        const double want = (double)layer(&frames[0], "intensity_0")[k],
                     got = (double)layer(&frames[1], "intensity_0")[k];
        if (want > 0)
            worst = fmax(worst, fabs(got / want - 1)), compared++;
    }
    printf("depth of reflecting gas: %d pixels, brightness off by %.1e\n", compared, worst);
    assert_true(compared >= 60 && worst < 5e-4);
    kd_frame_finish(&frames[0]);
    kd_frame_finish(&frames[1]);
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_evpa),      cmocka_unit_test(test_stokes),
        cmocka_unit_test(test_face_on),   cmocka_unit_test(test_atmosphere),
        cmocka_unit_test(test_returning), cmocka_unit_test(test_depth_of_reflecting_gas)
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
