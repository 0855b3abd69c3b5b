/* Tests of the light of jets. Near the hole it is compared with integrals along paths of the Kerr-Schild oracle, which
 * does not use Mino time; the energy in the matter's frame is computed from the Boyer-Lindquist metric. Far from the
 * hole it is compared with integrals along straight lines. The ratio of jet and counterjet is compared with special
 * relativity. */
#include "render_support.h"

#include "kerr_schild.h"

#include <math.h>

enum { WIDTH = 9, HEIGHT = 15, PIXELS = WIDTH * HEIGHT };

static struct kd_scene scene_of(const char *json)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.samples = 1;
    scene.image.critical_factor = 1;
    scene.disk.model = KD_DISK_NONE;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "image.layers", "rgb,intensity", &error));
    return scene;
}

static const float *intensity(const struct kd_frame *frame)
{
    const struct kd_layer *layer = kd_frame_layer(frame, "intensity");
    assert_non_null(layer);
    return layer->data;
}

static double ramp(double x)
{
    x = fmin(fmax(x, 0), 1);
    return x * x * (3 - 2 * x);
}

/* Emission per length in the matter's frame, at r and at a polar angle with the cosine u. */
static double emitted(const struct kd_jets *j, double r, double u)
{
    const double x = sqrt((1 - u) * (1 + u)) / fabs(u) / tan(j->opening_deg * M_PI / 180);
    if (!(x < 1) || (u < 0 && !j->counterjet))
        return 0;
    const double across = (1 - x * x) * (1 - x * x) * (1 - j->sheath + j->sheath * 27 / 4 * x * x);
    return j->brightness * across * pow(r / j->inner, -j->falloff) * ramp((r - j->inner) / (0.5 * j->inner)) *
           ramp((j->outer - r) / (0.3 * j->outer));
}

/* Integrates light along a straight line to an observer at the scene's inclination. A position is alpha e_right + beta
 * e_up + l n, and D = 1/(Gamma (1 - beta_v cos)). */
static double straight(const struct kd_scene *scene, double alpha, double beta)
{
    const struct kd_jets *j = &scene->jets;
    const double i = scene->camera.inclination_deg * M_PI / 180, v = sqrt(1 - 1 / (j->lorentz * j->lorentz)),
                 most = j->outer;
    const int n = 400000;
    double sum = 0;
    for (int k = 0; k < n; k++) {
        const double l = most * (2 * (k + 0.5) / n - 1), z = beta * sin(i) + l * cos(i),
                     r = sqrt(alpha * alpha + beta * beta + l * l);
        const double light = r > j->inner && r < j->outer ? emitted(j, r, z / r) : 0;
        if (light > 0)
            sum += light * pow(j->lorentz * (1 - v * l / r), -(2 + j->spectral_index));
    }
    return sum * 2 * most / n;
}

#define FAR_AWAY "\"jets\":{\"brightness\":1e-5,\"inner\":100000,\"outer\":500000,"

static void test_far_away(void **state)
{
    static const char *const scenes[] = {
        "{\"camera\":{\"inclination_deg\":60,\"field_m\":300000}," FAR_AWAY "\"lorentz\":2,\"opening_deg\":12}}",
        "{\"camera\":{\"inclination_deg\":35,\"field_m\":250000}," FAR_AWAY
        "\"lorentz\":5,\"opening_deg\":8,\"sheath\":1,\"falloff\":0}}",
        "{\"camera\":{\"inclination_deg\":110,\"field_m\":300000}," FAR_AWAY
        "\"lorentz\":1.3,\"opening_deg\":15,\"sheath\":0,\"spectral_index\":-0.5}}",
        "{\"camera\":{\"inclination_deg\":80,\"field_m\":300000}," FAR_AWAY
        "\"lorentz\":3,\"opening_deg\":10,\"counterjet\":false}}",
        /* the jet moves towards the observer; g is up to 200, computed from a difference of 1/20000 */
        "{\"camera\":{\"inclination_deg\":0.1,\"field_m\":40000}," FAR_AWAY "\"lorentz\":100,\"opening_deg\":8}}",
        /* g^12 is 2^70 */
        "{\"camera\":{\"inclination_deg\":0.1,\"field_m\":40000}," FAR_AWAY
        "\"lorentz\":30,\"opening_deg\":8,\"spectral_index\":10}}",
    };
    double worst = 0;
    int lit = 0;
    (void)state;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        const struct kd_scene scene = scene_of(scenes[s]);
        struct kd_frame frame = rendered(&scene);
        const double step = scene.camera.field_m / WIDTH;
        double peak = 0;
        for (int k = 0; k < PIXELS; k++)
            peak = fmax(peak, (double)intensity(&frame)[k]);
        for (int k = 0; k < PIXELS; k++) {
            const double want = straight(&scene, step * (k % WIDTH - 0.5 * (WIDTH - 1)),
                                         -step * (k / WIDTH - 0.5 * (HEIGHT - 1))),
                         got = (double)intensity(&frame)[k];
            const double off = fabs(got - want) / (want + 0.02 * peak);
            worst = fmax(worst, off);
            lit += want > 1e-3 * peak;
            if (!(off < 1e-3))
                fail_msg("scene %zu, pixel %d: %g, not %g: off by %.2g, peak %g", s, k, got, want, off, peak);
        }
        kd_frame_finish(&frame);
    }
    assert_true(lit > 60);
    printf("far away, %d rays: worst %.2g\n", lit, worst);
}

/* Ratio of a narrow jet to its counterjet at opposite positions: ((1 + v cos i)/(1 - v cos i))^(2 + alpha) (Blandford &
 * Konigl 1979, ApJ 232, 34). */
static void test_ratio(void **state)
{
    static const double lorentz[] = { 1.1, 2, 6 }, inclination[] = { 20, 60, 85 }, index[] = { 0, 0.7, 2 };
    (void)state;
    for (int n = 0; n < 3; n++) {
        char json[300];
        snprintf(json, sizeof json,
                 "{\"camera\":{\"inclination_deg\":%g,\"field_m\":%g}," FAR_AWAY
                 "\"lorentz\":%g,\"opening_deg\":2,\"spectral_index\":%g,\"sheath\":0}}",
                 inclination[n], 280000 * sin(inclination[n] * M_PI / 180), lorentz[n], index[n]);
        const struct kd_scene scene = scene_of(json);
        struct kd_frame frame = rendered(&scene);
        const double v = sqrt(1 - 1 / (lorentz[n] * lorentz[n])), c = cos(inclination[n] * M_PI / 180),
                     want = pow((1 + v * c) / (1 - v * c), 2 + index[n]);
        for (int y = 0; y < 2; y++) { /* two positions at 2.2e5 and 1.9e5 M, far from the ends of the jets */
            const double near = (double)intensity(&frame)[y * WIDTH + WIDTH / 2],
                         away = (double)intensity(&frame)[(HEIGHT - 1 - y) * WIDTH + WIDTH / 2];
            if (!(fabs(near / away / want - 1) < 1e-2))
                fail_msg("Lorentz factor %g at %g deg, row %d: %g, not %g", lorentz[n], inclination[n], y, near / away,
                         want);
        }
        kd_frame_finish(&frame);
    }
}

/* Emission in the matter's frame, by the metric. p_r follows from R(r) and the photon's constants, and -k.U = Gamma (e
 * - v k_r) with the components for the observer of zero angular momentum. way: 1 if the light moves outwards, -1 if it
 * moves inwards. */
static void shine(void *user, const struct ks_photon *p, double r, double u, double way, double out[2])
{
    const struct kd_scene *scene = user;
    const struct kd_jets *j = &scene->jets;
    const double a = p->a, s2 = 1 - u * u, sigma = r * r + a * a * u * u, term = 2 * r - p->q * p->q,
                 delta = r * r - term + a * a, start = 1 - p->u * p->u;
    const double carter =
        p->p_theta * p->p_theta +
        p->u * p->u * ((start > 0 ? p->momentum * p->momentum / start : 0) - a * a * p->energy * p->energy);
    const double big = (r * r + a * a) * p->energy - a * p->momentum,
                 radial = big * big - delta * (carter + pow(p->momentum - a * p->energy, 2));
    const double g_tt = -(1 - term / sigma), g_tp = -a * term * s2 / sigma,
                 g_pp = (r * r + a * a + a * a * term * s2 / sigma) * s2, omega = -g_tp / g_pp;
    const double e = (p->energy - omega * p->momentum) / sqrt(-(g_tt + omega * (2 * g_tp + omega * g_pp)));
    const double k = way * sqrt(fmax(radial, 0) / (sigma * delta)), v = sqrt(1 - 1 / (j->lorentz * j->lorentz));
    out[0] = emitted(j, r, u) * pow(j->lorentz * (e - v * k), -(2 + j->spectral_index));
    out[1] = 0;
}

/* On the rays that are compared for a far observer, light moves outwards above the plane and inwards below it. */
static void jet(void *user, const struct ks_photon *p, double r, double u, double out[2])
{
    shine(user, p, r, u, u > 0 ? 1 : -1, out);
}

static void test_near_the_hole(void **state)
{
    static const struct {
        double spin, charge, inclination;
        const char *jets;
    } views[] = {
        { 0, 0, 60, "\"lorentz\":2,\"opening_deg\":6" },
        { 0.95, 0, 52, "\"lorentz\":3,\"opening_deg\":5,\"sheath\":0.8,\"falloff\":1" },
        { 0.7, 0.7, 52, "\"lorentz\":2,\"opening_deg\":5,\"spectral_index\":1" },
        { -0.8, 0, 50, "\"lorentz\":1.5,\"opening_deg\":5,\"spectral_index\":1.5" },
    };
    double worst = 0;
    int lit = 0;
    (void)state;
    for (size_t n = 0; n < sizeof views / sizeof *views; n++) {
        char json[300];
        snprintf(
            json, sizeof json,
            "{\"spacetime\":{\"spin\":%g,\"charge\":%g},\"camera\":{\"inclination_deg\":%g,\"field_m\":18},\"jets\":{"
            "\"brightness\":0.1,\"inner\":4,\"outer\":40,%s}}",
            views[n].spin, views[n].charge, views[n].inclination, views[n].jets);
        struct kd_scene scene = scene_of(json);
        struct kd_frame frame = rendered(&scene);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = WIDTH / 2 - 1; x <= WIDTH / 2 + 1; x++) {
                const double alpha = 2.0 * (x - 0.5 * (WIDTH - 1)), beta = -2.0 * (y - 0.5 * (HEIGHT - 1)),
                             got = (double)intensity(&frame)[y * WIDTH + x];
                if (fabs(beta) < 7.5) /* at this position a jet is visible on both sides of the rays' turning points */
                    continue;
                const struct ks_light want =
                    ks_along(ks_from_infinity_charged(views[n].spin, views[n].charge,
                                                      cos(views[n].inclination * M_PI / 180), alpha, beta),
                             4, 40, false, jet, &scene);
                if (want.light < 1e-5)
                    continue;
                const double off = fabs(got / want.light - 1);
                lit++;
                worst = fmax(worst, off);
                if (!(off < 3e-3))
                    fail_msg("view %zu, alpha %g, beta %g: %g, not %g: off by %.2g", n, alpha, beta, got, want.light,
                             off);
            }
        kd_frame_finish(&frame);
    }
    assert_true(lit > 15);
    printf("near the hole, %d rays: worst %.2g\n", lit, worst);
}

/* Like `jet`, but for a ray that falls in: its light moves outwards everywhere. */
static void jet_below(void *user, const struct ks_photon *p, double r, double u, double out[2])
{
    shine(user, p, r, u, 1, out);
}

/* Jets that begin next to the horizon, on rays that fall in. These rays have no turning point at any latitude. Next to
 * the horizon, the charge's term in -k.U across the jet, a^2 L^2 (Sigma + 2r - q^2)/A, is large enough to be tested.
 * Light proportional to g^10 changes by large factors within a step of the march, most of all where a ray crosses the
 * axis. There the march's error is 7.5e-3 with the profile "balanced" and 3e-4 with "high". */
static void test_beside_the_horizon(void **state)
{
    /* each row: spin, charge, inclination */
    static const double views[][3] = { { 0.9, 0, 70 }, { 0.7, 0.7, 70 }, { -0.8, 0.59, 60 } };
    double worst = 0;
    int lit = 0;
    (void)state;
    for (size_t n = 0; n < sizeof views / sizeof *views; n++) {
        const double *v = views[n], outer = kd_hole_charged(v[0], v[1]).outer;
        char json[400];
        snprintf(json, sizeof json,
                 "{\"spacetime\":{\"spin\":%g,\"charge\":%g},\"camera\":{\"inclination_deg\":%g,\"field_m\":8},"
                 "\"jets\":{\"brightness\":0.1,\"inner\":%g,\"outer\":4,\"opening_deg\":60,\"lorentz\":5,"
                 "\"spectral_index\":8,\"sheath\":0,\"falloff\":4}}",
                 v[0], v[1], v[2], 1.1 * outer);
        struct kd_scene scene = scene_of(json);
        OK(kd_scene_set(&scene, "accuracy.profile", "high", &error));
        struct kd_frame frame = rendered(&scene);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                const double step = 8.0 / WIDTH, alpha = step * (x - 0.5 * (WIDTH - 1)),
                             beta = -step * (y - 0.5 * (HEIGHT - 1)), got = (double)intensity(&frame)[y * WIDTH + x];
                const struct ks_photon photon =
                    ks_from_infinity_charged(v[0], v[1], cos(v[2] * M_PI / 180), alpha, beta);
                if (ks_trace(photon, 1).fate != KS_CAPTURED)
                    continue;
                const struct ks_light want = ks_along(photon, scene.jets.inner, 4, false, jet_below, &scene);
                if (!(want.light > 1e-5))
                    continue;
                const double off = fabs(got / want.light - 1);
                lit++;
                worst = fmax(worst, off);
                if (!(off < 1e-3))
                    fail_msg("view %zu, alpha %g, beta %g: %g, not %g: off by %.2g", n, alpha, beta, got, want.light,
                             off);
            }
        kd_frame_finish(&frame);
    }
    printf("beside the horizon, %d rays: worst %.2g\n", lit, worst);
    assert_true(lit > 20);
}

/* Twice the brightness parameter gives twice the light. A scene without jets needs no ray marching. */
static void test_scaling(void **state)
{
    struct kd_scene scene = scene_of("{\"camera\":{\"field_m\":60},\"jets\":{\"brightness\":0.1}}"), twice = scene;
    struct kd_capacity c;
    struct kd_plan plan;
    (void)state;
    twice.jets.brightness = 0.2;
    struct kd_frame one = rendered(&scene), two = rendered(&twice);
    int lit = 0;
    for (int k = 0; k < PIXELS; k++) {
        assert_true(fabs((double)intensity(&two)[k] - 2 * (double)intensity(&one)[k]) <=
                    1e-5 * (double)intensity(&two)[k]);
        lit += intensity(&one)[k] > 0;
    }
    assert_true(lit > 5);
    kd_frame_finish(&one);
    kd_frame_finish(&two);
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.light.march.steps > 0);
    scene.jets.brightness = 0;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_false(plan.light.march.steps);
}

static void test_adversarial(void **state)
{
    static const char *const hard[] = {
        "{\"spacetime\":{\"spin\":0.999999},\"camera\":{\"inclination_deg\":0},\"jets\":{\"brightness\":1e9,"
        "\"lorentz\":100,\"inner\":1,\"opening_deg\":60,\"falloff\":10}}",
        "{\"camera\":{\"inclination_deg\":180},\"jets\":{\"brightness\":1,\"lorentz\":100,\"opening_deg\":1,\"outer\":"
        "1000000,\"falloff\":-3}}",
        "{\"camera\":{\"inclination_deg\":1,\"r\":10,\"fov_deg\":80},\"jets\":{\"brightness\":1,\"lorentz\":50,"
        "\"spectral_index\":10}}", /* the camera is within the jet */
        "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"inclination_deg\":30,\"r\":1.2,\"fov_deg\":100,\"observer\":"
        "\"infall\"},\"jets\":{\"brightness\":1,\"inner\":1}}",
    };
    (void)state;
    for (size_t s = 0; s < sizeof hard / sizeof *hard; s++) {
        const struct kd_scene scene = scene_of(hard[s]);
        struct kd_frame frame = rendered(&scene);
        for (int k = 0; k < PIXELS; k++)
            if (!(intensity(&frame)[k] >= 0 && isfinite(intensity(&frame)[k])))
                fail_msg("scene %zu, pixel %d: %g", s, k, (double)intensity(&frame)[k]);
        kd_frame_finish(&frame);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_far_away),           cmocka_unit_test(test_ratio),   cmocka_unit_test(test_near_the_hole),
        cmocka_unit_test(test_beside_the_horizon), cmocka_unit_test(test_scaling), cmocka_unit_test(test_adversarial),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests_name("jets", tests, NULL, NULL));
}
