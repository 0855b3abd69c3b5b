/* Tests of pictures of all directions, and of half of them, from a finite radius. A pixel's direction is computed here
 * by successive rotations about the camera's axes, and the Kerr-Schild oracle gives the origin of its photon. Unlike
 * most pinhole pictures, these pictures also show outward directions. */
#include "kerr_schild.h"
#include "render/render.h"
#include "render/view/camera.h"

#include "render_support.h"

#include <math.h>

enum { WIDTH = 32, HEIGHT = 16, RAYS = WIDTH * HEIGHT, PLANES = 4 };
#define RADIAN (M_PI / 180)

struct direction { double ahead, right, up; };

static void turn(double *x, double *y, double angle)
{
    const double c = cos(angle), s = sin(angle), old = *x;
    *x = c * old - s * *y;
    *y = s * old + c * *y;
}

/* The direction at (x, y) of the picture, in pixels from its upper left corner, before the camera's rotations. */
static struct direction seen(const struct kd_scene *scene, double x, double y)
{
    struct direction d = { 1, 0, 0 };
    const double to_right = x - 0.5 * WIDTH, upwards = 0.5 * HEIGHT - y;
    if (scene->camera.projection == KD_PROJECTION_EQUIRECTANGULAR) {
        turn(&d.ahead, &d.up, upwards / HEIGHT * M_PI);
        turn(&d.ahead, &d.right, to_right / WIDTH * 2 * M_PI);
    } else {
        turn(&d.ahead, &d.right, hypot(to_right, upwards) / (0.5 * HEIGHT) * 0.5 * M_PI);
        turn(&d.right, &d.up, atan2(upwards, to_right));
    }
    return d;
}

/* The photon of a pixel, after roll, pitch and yaw. A clockwise roll moves what was above to the left. A camera that is
 * pitched up looks above the hole. */
static struct ks_photon photon(const struct kd_scene *scene, double x, double y)
{
    const struct kd_camera *c = &scene->camera;
    struct direction d = seen(scene, x, y);
    turn(&d.right, &d.up, -c->roll_deg * RADIAN);
    turn(&d.ahead, &d.up, c->pitch_deg * RADIAN);
    turn(&d.ahead, &d.right, c->yaw_deg * RADIAN);
    const double k[3] = { -d.ahead, -d.up, d.right };
    return ks_from_camera(scene->spacetime.spin, c->r, c->inclination_deg * RADIAN, c->observer == KD_OBSERVER_ZAMO, k);
}

static struct kd_scene scene_of(double spin, double inclination, double r, int projection)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = inclination;
    scene.camera.r = r;
    scene.camera.observer = KD_OBSERVER_ZAMO;
    scene.camera.projection = projection;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.critical_factor = 1;
    scene.accuracy.orders = 1;
    return scene;
}

static void labels(const struct kd_scene *scene)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    const double s = sin(scene->camera.inclination_deg * RADIAN), bound = 1e-12 * scene->camera.r;
    for (uint32_t k = 0; k < RAYS; k++) {
        struct kd_camera_label is;
        const struct ks_photon want = photon(scene, k % WIDTH + 0.5, k / WIDTH + 0.5);
        kd_camera_label(&camera, k % WIDTH, k / WIDTH, &is);
        const double alpha = -want.momentum / (s * want.energy), beta = want.p_theta / fabs(want.energy);
        if (!(fabs(is.alpha - alpha) < bound && fabs(is.beta - beta) < bound && is.outward == (want.p_r < 0)))
            fail_msg("ray %u: alpha %.17g beta %.17g %d, not %.17g %.17g p_r %g", k, is.alpha, is.beta, is.outward,
                     alpha, beta, want.p_r);
    }
}

static double apart(const struct ks_path *a, double u, double phi)
{
    return hypot(u - a->u, sqrt(fmax(0, 1 - a->u * a->u)) * remainder(phi - a->sky_phi, 2 * M_PI));
}

/* Errors of escape directions are divided by 1 + their sensitivity to the ray. Fates equal the oracle's, except where a
 * neighbouring ray has another fate. */
static void map(const struct kd_scene *scene, enum kd_lens_path path)
{
    static float planes[PLANES * RAYS];
    const float *u = planes + RAYS, *phi = u + RAYS, *fate = phi + RAYS;
    struct kd_capacity capacity;
    struct kd_plan plan;
    double worst = 0, nudge = 1e-5;
    int escaped = 0;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_SKY }, &capacity, &plan, &error));
    assert_true(plan.lens.planes == PLANES && plan.lens.path == path);
    OK(kd_render_lens(renderer, scene, &plan, planes, NULL, &error));
    for (int k = 0; k < RAYS; k++) {
        const double x = k % WIDTH + 0.5, y = k / WIDTH + 0.5;
        const struct ks_path want = ks_trace(photon(scene, x, y), 16),
                             beside = ks_trace(photon(scene, x + nudge, y + nudge), 16);
        if (fate[k] == KD_FATE_UNDECIDED)
            fail_msg("ray %d, %d was given up", k % WIDTH, k / WIDTH);
        if (want.fate != beside.fate || want.fate == KS_UNDECIDED)
            continue;
        assert_true((fate[k] == KD_FATE_ESCAPED) == (want.fate == KS_ESCAPED));
        if (want.fate == KS_ESCAPED) {
            worst = fmax(worst, apart(&want, u[k], phi[k]) /
                                    (1 + apart(&want, beside.u, beside.sky_phi) / (nudge * M_PI / HEIGHT)));
            escaped++;
        }
    }
    print_message("a = %g, r = %g: %d directions, off by at most %.1e\n", scene->spacetime.spin, scene->camera.r,
                  escaped, worst);
    assert_true(escaped > RAYS / 4 && worst < 2e-6);
}

static void wide(void **state)
{
    (void)state;
    for (int projection = KD_PROJECTION_EQUIRECTANGULAR; projection <= KD_PROJECTION_FULLDOME; projection++) {
        struct kd_scene ahead = scene_of(0.9, 75, 8, projection), turned = scene_of(-0.6, 120, 25, projection),
                        within = scene_of(0.7, 60, 2.4, projection);
        turned.camera.yaw_deg = 130;
        turned.camera.pitch_deg = 40;
        turned.camera.roll_deg = 25;
        within.camera.yaw_deg = 180;
        within.accuracy.steps = 16;
        labels(&ahead);
        labels(&turned);
        labels(&within);
        map(&ahead, KD_LENS_CLOSED);
        map(&turned, KD_LENS_CLOSED);
        map(&within, KD_LENS_MAP);
    }
}

/* Rays that move outwards, along the hole's axis more than round it, meet the plane late or never. Their Q is about 0.
 * In an earlier version, the closed form of the polar motion gave a time for a crossing that does not exist. At these
 * sizes a row of pixels shows such rays. */
static void outwards(void **state)
{
    (void)state;
    static const struct { int width, height; } sizes[] = { { 800, 400 }, { 3200, 1600 } };
    for (int i = 0; i < 2; i++) {
        struct kd_scene scene = scene_of(0.7, 75, 8, KD_PROJECTION_EQUIRECTANGULAR);
        scene.image.width = sizes[i].width;
        scene.image.height = sizes[i].height;
        scene.sky.model = KD_SKY_GRID;
        scene.disk.model = KD_DISK_NONE;
        struct kd_frame frame = rendered(&scene);
        assert_in_range(frame.accuracy.undecided, 0, 3); /* only rays next to the critical curve are undecided */
        kd_frame_finish(&frame);
    }
}

/* The same test for rays that start inwards, which fill an ellipse of the picture. All their crossings must exist in
 * the independent closed form in double precision. In an earlier version one did not. */
static void inwards(void **state)
{
    (void)state;
    enum { ACROSS = 160, DOWN = 90 };
    static float found[ACROSS * DOWN], known[ACROSS * DOWN];
    struct kd_scene scene = scene_of(0.998, 82, 6.5, KD_PROJECTION_PINHOLE);
    scene.camera.fov_deg = 12;
    scene.camera.observer = KD_OBSERVER_STATIC;
    scene.image.width = ACROSS;
    scene.image.height = DOWN;
    for (int pass = 0; pass < 2; pass++) {
        struct kd_capacity capacity;
        struct kd_plan plan;
        scene.accuracy.engine = pass ? KD_ENGINE_CLOSED + 1 : 0;
        scene.accuracy.precision = pass ? KD_PRECISION_F64 + 1 : 0;
        kd_renderer_capacity(renderer, &capacity);
        OK(kd_scene_validate(&scene, &error));
        OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_W }, &capacity, &plan, &error));
        assert_true(plan.lens.planes == 1 && plan.lens.path == (pass ? KD_LENS_LISTED : KD_LENS_CLOSED));
        OK(kd_render_lens(renderer, &scene, &plan, pass ? known : found, NULL, &error));
    }
    for (int k = 0; k < ACROSS * DOWN; k++)
        if ((found[k] > 0) != (known[k] > 0))
            fail_msg("ray %d, %d: a crossing at w = %g, not at %g", k % ACROSS, k / ACROSS, (double)found[k],
                     (double)known[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(wide), cmocka_unit_test(outwards), cmocka_unit_test(inwards) };
    int skip = open_renderer();
    return skip ? skip : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
