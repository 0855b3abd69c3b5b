/* Tests of bodies along rays. Their images are compared with the Kerr-Schild oracle, which does not use Mino time. The
 * oracle measures, along a wave front, the distance at which a ray passes a position. Other tests: the bodies' light;
 * bodies, disk and hole that hide one another; extreme numbers. */
#include "render_support.h"

#include "kerr_schild.h"

#include <math.h>

enum { WIDTH = 40, HEIGHT = 30, PIXELS = WIDTH * HEIGHT, MOST = 8 };

static struct kd_scene scene_of(const char *json)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.critical_factor = 1;
    scene.disk.model = KD_DISK_NONE;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "image.layers", "rgb,intensity", &error));
    return scene;
}

/* The photon of a point of the picture. x, y: pixels from the upper left corner. */
static struct ks_photon photon_of(const struct kd_scene *scene, double px, double py)
{
    const double theta = scene->camera.inclination_deg * M_PI / 180;
    const bool far = isinf(scene->camera.r);
    const double step = far ? scene->camera.field_m / WIDTH : 2 * tan(scene->camera.fov_deg * M_PI / 360) / WIDTH;
    double x = step * (px - 0.5 * WIDTH), y = -step * (py - 0.5 * HEIGHT);
    if (far)
        return ks_from_infinity_charged(scene->spacetime.spin, scene->spacetime.charge, cos(theta),
                                        x + scene->camera.centre_alpha, y + scene->camera.centre_beta);
    const double length = sqrt(1 + x * x + y * y), k[3] = { -1 / length, -y / length, x / length };
    return ks_from_camera_charged(scene->spacetime.spin, scene->spacetime.charge, scene->camera.r, theta,
                                  scene->camera.observer == KD_OBSERVER_ZAMO, k);
}

/* The ray's first encounter with the scene's first body. If there is none, b exceeds the body's radius. */
static struct ks_near first_of(const struct kd_scene *scene, double px, double py)
{
    const struct kd_body *b = &scene->bodies.at[0];
    struct ks_near at[MOST];
    const int n = ks_passes(photon_of(scene, px, py), b->r, cos(b->inclination_deg * M_PI / 180),
                            b->phase_deg * M_PI / 180, 4 * b->radius, MOST, at);
    for (int i = 0; i < n; i++)
        if (at[i].b < b->radius)
            return at[i];
    return (struct ks_near) { 2 * b->radius, INFINITY };
}

static const float *intensity(const struct kd_frame *frame)
{
    const struct kd_layer *layer = kd_frame_layer(frame, "intensity");
    assert_non_null(layer);
    return layer->data;
}

/* Images of order 0, 1 and higher, seen from infinity and from nearby. At least the given number of pixels must show an
 * image. */
static const struct view {
    const char *json;
    int lit;
} views[] = {
    { "{\"camera\":{\"inclination_deg\":80,\"field_m\":5,\"centre_alpha\":2.73,\"centre_beta\":9.95},\"spacetime\":{"
      "\"spin\":0.7},\"bodies\":[{\"radius\":0.5,\"r\":15,\"phase_deg\":175}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":80,\"field_m\":4.4,\"centre_alpha\":-0.72,\"centre_beta\":-8.22},\"spacetime\":"
      "{\"spin\":0.7},\"bodies\":[{\"radius\":0.5,\"r\":15,\"phase_deg\":175}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":60,\"field_m\":2.2,\"centre_alpha\":6.15,\"centre_beta\":4.58},\"spacetime\":{"
      "\"spin\":0.95},\"bodies\":[{\"radius\":0.5,\"r\":6,\"phase_deg\":140,\"motion\":\"retrograde\"}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":60,\"field_m\":1.8,\"centre_alpha\":-2.77,\"centre_beta\":-4.16},\"spacetime\":"
      "{\"spin\":0.95},\"bodies\":[{\"radius\":0.5,\"r\":6,\"phase_deg\":140,\"motion\":\"retrograde\"}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":88,\"field_m\":4,\"centre_alpha\":6.4,\"centre_beta\":4.19},\"spacetime\":{"
      "\"spin\":-0.9},\"bodies\":[{\"radius\":0.25,\"r\":12,\"phase_deg\":-178}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":88,\"field_m\":0.2,\"centre_alpha\":2.96,\"centre_beta\":-0.35},\"spacetime\":{"
      "\"spin\":-0.9},\"bodies\":[{\"radius\":0.25,\"r\":12,\"phase_deg\":-178}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":30,\"field_m\":0.9,\"centre_alpha\":-2.31,\"centre_beta\":-3.64},\"spacetime\":"
      "{\"spin\":0.998},\"bodies\":[{\"radius\":0.3,\"r\":3,\"phase_deg\":60,\"inclination_deg\":50,\"motion\":"
      "\"zamo\"}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":30,\"field_m\":1,\"centre_alpha\":2.48,\"centre_beta\":0.34},\"spacetime\":{"
      "\"spin\":0.998},\"bodies\":[{\"radius\":0.3,\"r\":3,\"phase_deg\":60,\"inclination_deg\":50,\"motion\":\"zamo\"}"
      "]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":60,\"field_m\":3,\"centre_alpha\":10.12,\"centre_beta\":-8.75},\"spacetime\":{"
      "\"spin\":0.7},\"bodies\":[{\"radius\":1,\"r\":20,\"phase_deg\":30,\"motion\":\"velocity\",\"velocity_phi\":0.9}]"
      "}",
      12 },
    { "{\"camera\":{\"inclination_deg\":70,\"r\":25,\"fov_deg\":60},\"bodies\":[{\"radius\":2,\"r\":12,\"phase_deg\":"
      "160,\"inclination_deg\":100,\"motion\":\"static\"}]}",
      12 },
    { "{\"camera\":{\"inclination_deg\":70,\"r\":25,\"fov_deg\":60},\"spacetime\":{\"spin\":0.5,\"charge\":0.8},"
      "\"bodies\":[{"
      "\"radius\":1.5,\"r\":8,\"phase_deg\":160,\"inclination_deg\":100,\"motion\":\"zamo\"}]}",
      12 },
};

/* For a pixel on which picture and oracle disagree: distance in pixels of the image's edge from its expected position,
 * computed from the slope of b. */
static double off_by(const struct kd_scene *scene, int x, int y)
{
    const double radius = scene->bodies.at[0].radius;
    const bool inside = first_of(scene, x + 0.5, y + 0.5).b < radius;
    for (double reach = 0.02; reach < 1; reach += 0.02)
        for (int k = 0; k < 16; k++)
            if ((first_of(scene, x + 0.5 + reach * cos(k * M_PI / 8), y + 0.5 + reach * sin(k * M_PI / 8)).b <
                 radius) != inside)
                return reach;
    return 1;
}

static void test_places(void **state)
{
    (void)state;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        const struct kd_scene scene = scene_of(views[v].json);
        struct kd_frame frame = rendered(&scene);
        int lit = 0, differ = 0;
        double worst = 0;
        for (int i = 0; i < PIXELS; i++) {
            const bool seen = intensity(&frame)[i] > 0,
                       there = first_of(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5).b < scene.bodies.at[0].radius;
            lit += there;
            differ += seen != there;
            if (seen != there)
                worst = fmax(worst, off_by(&scene, i % WIDTH, i / WIDTH));
        }
        printf("view %zu: %d pixels lit, %d differ, edge off by %.2g pixels\n", v, lit, differ, worst);
        assert_true(lit >= views[v].lit && worst < 0.5);
        kd_frame_finish(&frame);
    }
}

/* Metric at the scene's first body: -g_tt, g_tphi and g_phiphi. Motion along phi needs no other components. */
struct metric { double tt, tp, pp; };

static struct metric metric_of(const struct kd_scene *scene)
{
    const struct kd_body *b = &scene->bodies.at[0];
    const double a = scene->spacetime.spin, r = b->r, u = cos(b->inclination_deg * M_PI / 180), s2 = 1 - u * u,
                 sigma = r * r + a * a * u * u, mass = 2 * r - scene->spacetime.charge * scene->spacetime.charge;
    return (struct metric) { 1 - mass / sigma, -a * mass * s2 / sigma,
                             (r * r + a * a + a * a * mass * s2 / sigma) * s2 };
}

/* 1/g of matter that moves along phi, with the angular velocity Omega or with a velocity relative to an observer of
 * zero angular momentum. */
static double shift_of(const struct kd_scene *scene, const struct ks_photon *p)
{
    const struct kd_body *b = &scene->bodies.at[0];
    const struct metric g = metric_of(scene);
    const double a = scene->spacetime.spin, dragging = -g.tp / g.pp, lapse = sqrt(g.tt + g.tp * g.tp / g.pp),
                 v = b->velocity_phi;
    const double root = sqrt(b->r - scene->spacetime.charge * scene->spacetime.charge), r2 = b->r * b->r;
    double omega = 0;
    switch (b->motion) {
    case KD_OBSERVER_ZAMO: omega = dragging; break;
    case KD_OBSERVER_KEPLERIAN: omega = root / (r2 + a * root); break;
    case KD_OBSERVER_RETROGRADE: omega = -root / (r2 - a * root); break;
    case KD_OBSERVER_VELOCITY: omega = dragging + lapse * v / sqrt(g.pp); break;
    default: break;
    }
    return (p->energy - omega * p->momentum) / sqrt(g.tt - 2 * omega * g.tp - omega * omega * g.pp);
}

/* The light is that of a black body, times g^4 and the limb darkening. */
static void test_light(void **state)
{
    (void)state;
    static const char *const motions[] = {
        "{\"motion\":\"keplerian\"}",
        "{\"motion\":\"retrograde\"}",
        "{\"motion\":\"static\"}",
        "{\"motion\":\"zamo\",\"inclination_deg\":60}",
        "{\"motion\":\"velocity\",\"velocity_phi\":-0.7,\"limb_darkening\":0,\"brightness\":3}",
    };
    const size_t n = sizeof motions / sizeof *motions;
    for (size_t view = 0; view < 2 * n; view++) { /* in the second half of the views the hole is charged */
        const size_t k = view % n;
        char json[512];
        snprintf(json, sizeof json,
                 "{\"camera\":{\"inclination_deg\":70,\"field_m\":26},\"spacetime\":{%s},\"bodies\":[{"
                 "\"radius\":1.2,\"r\":8,\"phase_deg\":40,%s]}",
                 view < n ? "\"spin\":0.9" : "\"spin\":0.4,\"charge\":0.9", motions[k] + 1);
        const struct kd_scene scene = scene_of(json);
        const struct kd_body *b = &scene.bodies.at[0];
        struct kd_frame frame = rendered(&scene);
        int lit = 0;
        double worst = 0;
        for (int i = 0; i < PIXELS; i++) {
            if (!(intensity(&frame)[i] > 0))
                continue;
            const struct ks_photon photon = photon_of(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5);
            const double x = first_of(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5).b / b->radius, c = b->limb_darkening;
            if (x > 0.9)
                continue; /* skipped, because the brightness falls steeply at the limb, whose place is tested elsewhere
                           */
            const double t = b->temperature_k / scene.disk.peak_temperature_k / shift_of(&scene, &photon),
                         limb = (1 - c * (1 - sqrt(1 - x * x))) / (1 - c / 3);
            worst = fmax(worst, fabs(intensity(&frame)[i] / (b->brightness * limb * t * t * t * t) - 1));
            lit++;
        }
        printf("%s, charge %g: %d pixels, worst %.2g\n", motions[k], scene.spacetime.charge, lit, worst);
        assert_true(lit >= 6 && worst < 3e-3);
        kd_frame_finish(&frame);
    }
}

/* The camera sees either a body or an opaque disk, whichever is nearer along the ray. The nearer one's light left
 * later. */
static void test_order(void **state)
{
    (void)state;
    static const char *const json[] = {
        "{\"camera\":{\"inclination_deg\":75,\"field_m\":40},\"disk\":{\"model\":\"novikov-thorne\",\"outer\":22,"
        "\"taper\":0},"
        "\"bodies\":[{\"radius\":3,\"r\":14,\"phase_deg\":150,\"inclination_deg\":65,\"motion\":\"static\"}]}",
        "{\"camera\":{\"inclination_deg\":75,\"field_m\":40},\"disk\":{\"model\":\"novikov-thorne\",\"outer\":22,"
        "\"taper\":0},"
        "\"bodies\":[{\"radius\":3,\"r\":14,\"phase_deg\":-160,\"inclination_deg\":115,\"motion\":\"static\"}]}",
    };
    for (int k = 0; k < 2; k++) {
        const struct kd_scene both = scene_of(json[k]);
        struct kd_scene body = both, disk = both;
        body.disk.model = KD_DISK_NONE;
        disk.bodies.at[0].radius = 0;
        struct kd_frame all = rendered(&both), alone = rendered(&body), bare = rendered(&disk);
        int front = 0, behind = 0;
        for (int i = 0; i < PIXELS; i++) {
            const struct ks_near at = first_of(&both, i % WIDTH + 0.5, i / WIDTH + 0.5);
            if (!(intensity(&alone)[i] > 0) || at.b > 0.9 * both.bodies.at[0].radius)
                continue;
            const struct ks_path path = ks_trace(photon_of(&both, i % WIDTH + 0.5, i / WIDTH + 0.5), 3);
            bool hidden = false, near = false;
            for (int n = 0; n < path.crossings; n++) {
                const bool on = path.r[n] > 3.4 && path.r[n] < 22;
                hidden |= on && path.delay[n] < at.delay;
                near |=
                    fabs(path.delay[n] - at.delay) < 3.5 || fabs(path.r[n] - 3.4) < 0.1 || fabs(path.r[n] - 22) < 0.1;
            }
            if (near)
                continue;
            const double want = hidden ? intensity(&bare)[i] : intensity(&alone)[i];
            if (fabs(intensity(&all)[i] - want) > 1e-5 * want)
                fail_msg("scene %d, pixel %d, %s: %g, not %g", k, i, hidden ? "behind the disk" : "before it",
                         intensity(&all)[i], want);
            front += !hidden;
            behind += hidden;
        }
        printf("scene %d: %d pixels before the disk, %d behind it\n", k, front, behind);
        assert_true(front + behind > 20 && (k || front) && (!k || behind));
        kd_frame_finish(&all);
        kd_frame_finish(&alone);
        kd_frame_finish(&bare);
    }
}

/* Each body of a scene with many bodies has the same image as alone. */
static void test_tree(void **state)
{
    (void)state;
    for (size_t n = 2; n <= KD_SCENE_BODIES; n += 3) {
        struct kd_scene scene = scene_of("{\"camera\":{\"inclination_deg\":60,\"field_m\":40}}");
        float sum[PIXELS] = { 0 }, most[PIXELS] = { 0 };
        uint32_t random = 7;
        scene.bodies.count = n;
        for (size_t i = 0; i < n; i++) {
            struct kd_body *b = &scene.bodies.at[i];
            random = random * 1664525 + 1013904223;
            b->r = 5 + (random >> 8) % 12;
            b->phase_deg = (random >> 14) % 360;
            b->inclination_deg = 30 + (random >> 20) % 120;
            b->motion = KD_OBSERVER_STATIC;
            b->radius = 1.3;
            b->temperature_k = 4000 + 100.0 * (double)i;
        }
        struct kd_frame all = rendered(&scene);
        for (size_t i = 0; i < n; i++) {
            struct kd_scene one = scene;
            one.bodies.count = 1;
            one.bodies.at[0] = scene.bodies.at[i];
            struct kd_frame frame = rendered(&one);
            for (int p = 0; p < PIXELS; p++) {
                most[p] = fmaxf(most[p], intensity(&frame)[p] == intensity(&all)[p] ? intensity(&frame)[p] : 0);
                sum[p] += intensity(&frame)[p];
            }
            kd_frame_finish(&frame);
        }
        int lit = 0;
        for (int p = 0; p < PIXELS; p++) {
            lit += sum[p] > 0;
            if ((sum[p] > 0) != (intensity(&all)[p] > 0) || most[p] != intensity(&all)[p])
                fail_msg("%zu bodies, pixel %d: %g, each %g in all", n, p, intensity(&all)[p], sum[p]);
        }
        assert_true(lit > 3);
        kd_frame_finish(&all);
    }
}

/* A volume in front of a body dims the body. A volume behind it has no effect. */
static void shell(void *user, const struct ks_photon *p, double r, double u, double out[2])
{
    (void)p, (void)r, (void)u;
    out[0] = 0;
    out[1] = *(const double *)user;
}

static void test_volumes(void **state)
{
    (void)state;
    double opacity = 0.05;
    for (int behind = 0; behind < 2; behind++) {
        struct kd_scene scene = scene_of("{\"camera\":{\"inclination_deg\":60,\"field_m\":16,\"centre_beta\":-7},"
                                         "\"bodies\":[{\"radius\":2,\"r\":15}]}"),
                        bare;
        bare = scene;
        OK(kd_scene_set(&scene, "volume.model", "uniform", &error));
        scene.volume.redshift = false;
        scene.volume.emissivity = 0;
        scene.volume.opacity = opacity;
        scene.volume.inner = behind ? 4 : 20;
        scene.volume.outer = behind ? 9 : 30;
        struct kd_frame dimmed = rendered(&scene), plain = rendered(&bare);
        int lit = 0;
        for (int i = 0; i < PIXELS; i++) {
            if (!(intensity(&plain)[i] > 0))
                continue;
            const struct ks_light front =
                ks_along(photon_of(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5), 20, 30, true, shell, &opacity);
            const double want = intensity(&plain)[i] * (behind ? 1 : exp(-front.depth));
            if (fabs(intensity(&dimmed)[i] / want - 1) > 1e-4)
                fail_msg("shell %s, pixel %d: %g, not %g", behind ? "behind" : "before", i, intensity(&dimmed)[i],
                         want);
            lit++;
        }
        assert_true(lit > 20);
        kd_frame_finish(&dimmed);
        kd_frame_finish(&plain);
    }
}

static double layer_at(const struct kd_frame *frame, const char *name, int pixel)
{
    const struct kd_layer *layer = kd_frame_layer(frame, name);
    assert_non_null(layer);
    return ((const float *)layer->data)[pixel];
}

/* Layers show a body where it lies in front of the disk. */
static void test_layers(void **state)
{
    (void)state;
    struct kd_scene scene =
        scene_of("{\"camera\":{\"inclination_deg\":60,\"field_m\":16,\"centre_beta\":-7},\"spacetime\":{\"spin\":0.5},"
                 "\"disk\":{\"outer\":10},\"bodies\":[{\"radius\":2,\"r\":15}]}");
    OK(kd_scene_set(&scene, "image.layers", "intensity,g,temperature,r,phi,order,emission_angle", &error));
    struct kd_frame frame = rendered(&scene);
    int lit = 0;
    for (int i = 0; i < PIXELS; i++) {
        if (!(intensity(&frame)[i] > 0) || layer_at(&frame, "r", i) <= 10) /* the pixel is dark, or shows the disk */
            continue;
        const struct ks_photon photon = photon_of(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5);
        const double x = first_of(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5).b / 2;
        assert_true(fabs(layer_at(&frame, "g", i) * shift_of(&scene, &photon) - 1) < 1e-4);
        assert_true(fabs(layer_at(&frame, "temperature", i) / 6000 - 1) < 1e-5 && layer_at(&frame, "order", i) <= 1);
        assert_true(fabs(layer_at(&frame, "r", i) - 15) < 2.1 && fabs(layer_at(&frame, "phi", i)) < 0.15);
        if (x < 0.9)
            assert_true(fabs(sin(layer_at(&frame, "emission_angle", i)) - x) < 0.02);
        lit++;
    }
    assert_true(lit > 20);
    kd_frame_finish(&frame);
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_set(&scene, "image.layers", "intensity_1", &error));
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &(struct kd_error) { 0 }), KD_EINVAL);
    OK(kd_scene_set(&scene, "image.layers", "rgb", &error));
    scene.camera.projection = KD_PROJECTION_RING;
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &(struct kd_error) { 0 }), KD_EINVAL);
}

/* Extreme numbers do not cause NaN. */
static void test_adversarial(void **state)
{
    (void)state;
    static const char *const hard[] = {
        "{\"camera\":{\"r\":20},\"bodies\":[{\"radius\":3,\"r\":20,\"motion\":\"static\"}]}", /* the body surrounds the
                                                                                                 observer */
        "{\"camera\":{\"r\":20},\"bodies\":[{\"radius\":1e6,\"r\":1e7}]}",
        "{\"bodies\":[{\"radius\":1e6,\"r\":3,\"motion\":\"static\"}]}", /* the body surrounds hole and observer */
        "{\"bodies\":[{\"radius\":1e6,\"r\":15},{\"radius\":1e-30,\"r\":15},{\"radius\":2,\"r\":15,\"brightness\":0}]}",
        /* the body overlaps the horizon */
        "{\"bodies\":[{\"radius\":1,\"r\":1.81,\"motion\":\"zamo\",\"brightness\":1e9,\"temperature_k\":1e9}]}",
        "{\"spacetime\":{\"spin\":0.999999999999},\"bodies\":[{\"radius\":0.5,\"r\":1.06,\"motion\":\"zamo\"},{"
        "\"radius\":0.5,\"r\":1.5,\"motion\":\"infall\"}]}",
        "{\"spacetime\":{\"spin\":-0.999},\"camera\":{\"inclination_deg\":0},\"bodies\":[{\"radius\":1,\"r\":6,"
        "\"inclination_deg\":0,\"motion\":\"static\"},"
        "{\"radius\":1,\"r\":6,\"inclination_deg\":180,\"motion\":\"velocity\",\"velocity_phi\":0.999}]}",
        "{\"bodies\":[{\"radius\":1,\"r\":6,\"motion\":\"velocity\",\"velocity_r\":0.999},{\"radius\":1,\"r\":6,"
        "\"motion\":\"velocity\",\"velocity_r\":-0.999},"
        "{\"radius\":1,\"r\":6,\"motion\":\"velocity\",\"velocity_theta\":0.999}]}",
        "{\"camera\":{\"r\":1.5,\"inclination_deg\":90,\"observer\":\"zamo\"},\"spacetime\":{\"spin\":0.9},\"bodies\":["
        "{\"radius\":3,\"r\":8},{\"radius\":0.3,\"r\":1.6,\"motion\":\"zamo\"}]}",
        /* the observer is within the horizon */
        "{\"camera\":{\"r\":1.2,\"inclination_deg\":75,\"observer\":\"infall\"},\"spacetime\":{\"spin\":0.5},"
        "\"bodies\":[{\"radius\":3,\"r\":8}]}",
        "{\"camera\":{\"r\":3,\"inclination_deg\":75,\"observer\":\"infall\"},\"spacetime\":{\"spin\":0.5},\"bodies\":["
        "{\"radius\":1,\"r\":8,\"phase_deg\":180}]}",
        "{\"bodies\":[{\"radius\":1},{\"radius\":1},{\"radius\":1},{\"radius\":1},{\"radius\":1},{\"radius\":1},{"
        "\"radius\":1},{\"radius\":1}]}",
    };
    for (size_t k = 0; k < sizeof hard / sizeof *hard; k++) {
        const struct kd_scene scene = scene_of(hard[k]);
        struct kd_frame frame = rendered(&scene);
        int lit = 0;
        for (int i = 0; i < PIXELS; i++) {
            if (!(intensity(&frame)[i] >= 0 && isfinite(intensity(&frame)[i])))
                fail_msg("scene %zu, pixel %d: %g", k, i, intensity(&frame)[i]);
            lit += intensity(&frame)[i] > 0;
        }
        printf("scene %zu: %d of %d pixels lit\n", k, lit, PIXELS);
        if (k == 0)
            assert_int_equal(lit, PIXELS);
        kd_frame_finish(&frame);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places),      cmocka_unit_test(test_light),   cmocka_unit_test(test_order),
        cmocka_unit_test(test_tree),        cmocka_unit_test(test_volumes), cmocka_unit_test(test_layers),
        cmocka_unit_test(test_adversarial),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
