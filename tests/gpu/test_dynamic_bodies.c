/* Tests of a playground in pictures. Images of its bodies and their order are compared with the Kerr-Schild oracle. A
 * body looks the same as a body of a scene, in front of and behind the disk and the hole. Other tests: the light of
 * debris, and invalid sets of bodies. */
#include "render_support.h"

#include "kerr_schild.h"
#include "playground/show.h"
#include "render/emit/bodies.h"
#include "render/emit/emitter.h"

#include <math.h>

enum { WIDTH = 24, HEIGHT = 18, PIXELS = WIDTH * HEIGHT, MOST = 8, MANY = 4096, FINE = 64 };
#define RADIUS 0.15
#define LEAST_K 3000.0 /* bodies are recognised by their temperatures, which increase by 2 K from body to body */

static struct kd_scene scene_of(const char *json)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.critical_factor = 1;
    scene.disk.model = KD_DISK_NONE;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    return scene;
}

static const float *layer_of(const struct kd_frame *frame, const char *name)
{
    const struct kd_layer *layer = kd_frame_layer(frame, name);
    assert_non_null(layer);
    return layer->data;
}

static uint32_t seed = 11;
static double chance(void)
{
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) * 0x1p-24;
}

/* Bodies in all directions round the hole, at 7.5 to 20 M. */
static struct kd_playground *many(double spin)
{
    struct kd_playground_params params = kd_playground_defaults();
    struct kd_playground *p;
    params.gravity = KD_GRAVITY_KERR;
    params.spin = spin;
    OK(kd_playground_create(&params, &p, &error));
    for (int i = 0; i < MANY;) {
        const double r = 7.5 + 12.5 * chance(), u = 1.8 * chance() - 0.9, s = sqrt(1 - u * u),
                     phi = 2 * M_PI * chance();
        struct kd_playground_body body = { .mass = 1e-9,
                                           .radius = RADIUS,
                                           .temperature_k = LEAST_K + 2 * i,
                                           .x = { r * s * cos(phi), r * s * sin(phi), r * u },
                                           .v = { -0.3 * sin(phi), 0.3 * cos(phi), 0 } };
        /* for a motion at the edge between two kinds, the function returns an error; another motion is then drawn */
        struct kd_error none;
        i += !kd_playground_add(p, &body, NULL, &none);
    }
    return p;
}

static double pass(const struct kd_scene *scene, const struct kd_seen_body *b, double alpha, double beta, double within,
                   double *delay)
{
    struct ks_near at[MOST];
    const double theta = scene->camera.inclination_deg * M_PI / 180;
    const int n = ks_passes(ks_from_infinity(scene->spacetime.spin, cos(theta), alpha, beta), b->r, b->u, b->phi,
                            within, MOST, at);
    double least = INFINITY;
    for (int i = 0; i < n; i++) /* the first body that the ray meets; if it meets none, the nearest body */
        if (least > RADIUS && at[i].b < least) {
            least = at[i].b;
            *delay = at[i].delay;
        }
    return least;
}

/* Finds the centre of an image near a point. Returns the image's width, or 0 if there is no image. */
static double image_near(const struct kd_scene *scene, const struct kd_seen_body *b, double at[2], double step)
{
    double delay, least = pass(scene, b, at[0], at[1], 8, &delay);
    for (int tries = 0; tries < 60 && least > 0.1 * RADIUS; tries++) {
        double best[2] = { at[0], at[1] };
        for (int k = 0; k < 8; k++) {
            const double x = at[0] + step * cos(k * M_PI / 4), y = at[1] + step * sin(k * M_PI / 4),
                         off = pass(scene, b, x, y, 8, &delay);
            if (off < least) {
                least = off;
                best[0] = x;
                best[1] = y;
            }
        }
        if (best[0] == at[0] && best[1] == at[1])
            step *= 0.5;
        at[0] = best[0];
        at[1] = best[1];
    }
    if (least > 0.5 * RADIUS)
        return 0;
    double far = 1e-3;
    while (far < 2 && pass(scene, b, at[0] + far * 0.8, at[1] + far * 0.6, 8, &delay) < RADIUS)
        far *= 1.3;
    return far;
}

struct judged {
    int shown, hidden, images;
    double worst;
};

/* Compares a picture of one image: where the oracle finds the body, a pixel shows this body, or another body that the
 * ray met before. */
static void judge(struct kd_scene scene, const struct kd_dynamic_bodies *dynamic, uint32_t which, const double at[2],
                  double size, struct judged *sum)
{
    char set[64];
    const double field = 5 * size, step = field / WIDTH;
    snprintf(set, sizeof set, "%.9g", field);
    OK(kd_scene_set(&scene, "camera.field_m", set, &error));
    scene.camera.centre_alpha = at[0];
    scene.camera.centre_beta = at[1];
    struct kd_frame frame = rendered(&scene);
    const float *kelvin = layer_of(&frame, "temperature");
    int lit = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double x = at[0] + step * (i % WIDTH + 0.5 - 0.5 * WIDTH),
                     y = at[1] - step * (i / WIDTH + 0.5 - 0.5 * HEIGHT);
        double delay, before;
        const bool there = pass(&scene, &dynamic->bodies[which], x, y, 4, &delay) < RADIUS;
        const long seen = isnan(kelvin[i]) ? -1 : lround((kelvin[i] - LEAST_K) / 2);
        bool right = (seen == which) == there;
        if (there && seen >= 0 && seen != which) { /* another body lies in front of this one */
            assert_true(seen < MANY);
            right = pass(&scene, &dynamic->bodies[seen], x, y, 4, &before) < 1.02 * RADIUS && before < delay + 0.1;
            sum->hidden += right;
        }
        lit += there;
        sum->shown += there && seen == which;
        for (double reach = 0.02; !right && reach < 1; reach += 0.02)
            for (int k = 0; k < 12 && !right; k++) {
                right = (pass(&scene, &dynamic->bodies[which], x + reach * step * cos(k * M_PI / 6),
                              y + reach * step * sin(k * M_PI / 6), 4, &delay) < RADIUS) == (seen == which);
                sum->worst = fmax(sum->worst, reach);
            }
        if (!right)
            fail_msg("body %u, pixel %d: the picture has %ld, the oracle %s", which, i, seen,
                     there ? "this one" : "another or none");
    }
    sum->images += lit >= 4;
    kd_frame_finish(&frame);
}

static void test_places(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of("{\"camera\":{\"inclination_deg\":70},\"spacetime\":{\"spin\":0.7},\"disk\":{"
                                     "\"inner\":5,\"outer\":5.001},\"image\":{\"layers\":[\"rgb\",\"temperature\"]}}");
    struct kd_playground *p = many(scene.spacetime.spin);
    struct kd_dynamic_bodies *dynamic;
    struct judged first = { 0 }, second = { 0 };
    OK(kd_playground_may_show(p, &scene, &error));
    OK(kd_playground_show(p, &dynamic, &error));
    kd_playground_destroy(p);
    kd_scene_show(&scene, dynamic);
    for (uint32_t i = 0; i < 40; i++) {
        const uint32_t which = i * 101 + 7;
        const struct kd_seen_body *b = &dynamic->bodies[which];
        const double theta = scene.camera.inclination_deg * M_PI / 180, c = cos(theta), s = sin(theta);
        const double x[3] = { b->r * b->s * cos(b->phi), b->r * b->s * sin(b->phi), b->r * b->u };
        const double ahead = s * x[0] + c * x[2], across[2] = { x[1], s * x[2] - c * x[0] },
                     impact = hypot(across[0], across[1]);
        double at[2] = { across[0], across[1] }, size;
        if (ahead < 0 || impact > 6) { /* skipped, because light that passes close to the hole is bent too much */
            const double more = impact < 8 && ahead < 0 ? sqrt(impact * impact + 4 * -ahead) : impact + 1;
            at[0] *= more / fmax(impact, 0.1);
            at[1] *= more / fmax(impact, 0.1);
        }
        size = image_near(&scene, b, at, 1);
        if (size > 0)
            judge(scene, dynamic, which, at, size, &first);
        /* Images of bodies on the far side of the hole. */
        double other[2] = { -5.6 * across[0] / fmax(impact, 0.1), -5.6 * across[1] / fmax(impact, 0.1) };
        size = i % 2 ? image_near(&scene, b, other, 0.4) : 0;
        if (size > 0 && hypot(other[0] - at[0], other[1] - at[1]) > 1)
            judge(scene, dynamic, which, other, size, &second);
    }
    printf("%d images of order 0: %d pixels, %d behind others, edges off by %.2g pixels; %d of order 1: %d pixels, %d "
           "behind others, %.2g\n",
           first.images, first.shown, first.hidden, first.worst, second.images, second.shown, second.hidden,
           second.worst);
    assert_true(first.images >= 30 && second.images >= 5 && first.worst < 0.5 && second.worst < 0.5);
    kd_dynamic_bodies_release(dynamic);
}

static struct kd_dynamic_bodies *one(const struct kd_seen_body *body, size_t n)
{
    struct kd_dynamic_bodies *dynamic;
    OK(kd_dynamic_bodies_create(n, 0, 0, &dynamic, &error));
    for (size_t i = 0; i < n; i++)
        dynamic->bodies[i] = *body;
    return dynamic;
}

/* A body of a playground has the same pixels, to the bit, as a body of a scene, and hides the same objects.
 * test_bodies.c tests bodies of scenes. */
static void test_as_a_scene_has_it(void **state)
{
    (void)state;
    static const double phases[] = { 20, 150, -170 };
    for (int k = 0; k < 3; k++) {
        char json[256];
        snprintf(json, sizeof json,
                 "{\"camera\":{\"inclination_deg\":75,\"field_m\":40},\"disk\":{\"model\":\"novikov-thorne\"},"
                 "\"image\":{\"layers\":[\"rgb\",\"intensity\"]},"
                 "\"bodies\":[{\"radius\":3,\"r\":14,\"phase_deg\":%g,\"inclination_deg\":65,\"motion\":\"zamo\"}]}",
                 phases[k]);
        struct kd_scene own = scene_of(json), other = own;
        const struct kd_body *b = &own.bodies.at[0];
        struct kd_dynamic_bodies *dynamic = one(&(struct kd_seen_body) { .r = b->r,
                                                                         .u = cos(65 * M_PI / 180),
                                                                         .s = sin(65 * M_PI / 180),
                                                                         .phi = phases[k] * M_PI / 180,
                                                                         .radius = b->radius,
                                                                         .temperature_k = b->temperature_k,
                                                                         .brightness = 1,
                                                                         .limb_darkening = b->limb_darkening },
                                                1);
        other.bodies.at[0].radius = 0;
        kd_scene_show(&other, dynamic);
        struct kd_frame a = rendered(&own), c = rendered(&other);
        int lit = 0;
        assert_true(c.lens_reused);
        for (int i = 0; i < PIXELS; i++) {
            const float x = layer_of(&a, "intensity")[i], y = layer_of(&c, "intensity")[i];
            if (fabsf(x - y) > 1e-5f * x)
                fail_msg("phase %g, pixel %d: %g, not %g", phases[k], i, y, x);
            lit += x > 0;
        }
        assert_true(lit > 20);
        kd_frame_finish(&a);
        kd_frame_finish(&c);
        kd_dynamic_bodies_release(dynamic);
    }
}

/* A body of temperature 0 is as dark as one of brightness 0. It hides the disk and bodies behind it, layers show its
 * temperature, and there is no NaN. A body without a radius is reported. */
static void test_dark(void **state)
{
    (void)state;
    struct kd_scene scene =
        scene_of("{\"camera\":{\"inclination_deg\":75,\"field_m\":40},\"disk\":{\"model\":\"novikov-thorne\",\"outer\":"
                 "60},\"image\":{\"layers\":[\"rgb\",\"intensity\",\"temperature\"]}}");
    struct kd_frame bare = rendered(&scene), frames[3];
    for (int k = 0; k < 3; k++) {
        const struct kd_seen_body body = { .r = 14,
                                           .u = cos(65 * M_PI / 180),
                                           .s = sin(65 * M_PI / 180),
                                           .phi = 1.2,
                                           .radius = k == 2 ? 0 : 3,
                                           .temperature_k = k == 1 ? 0 : 6000,
                                           .brightness = k == 1 ? 1 : 0,
                                           .limb_darkening = 0.6 };
        struct kd_dynamic_bodies *dynamic = one(&body, 1);
        struct kd_capacity c;
        struct kd_plan plan;
        kd_scene_show(&scene, dynamic);
        frames[k] = rendered(&scene);
        kd_renderer_capacity(renderer, &c);
        OK(kd_plan_make(&scene, &c, &plan, &error));
        bool told = false;
        for (size_t i = 0; i < plan.report.n_approximations; i++)
            told |= strstr(plan.report.approximations[i].text, "they have no radius") != NULL;
        assert_true(told == (k == 2));
        kd_dynamic_bodies_release(dynamic);
    }
    int hidden = 0;
    for (int i = 0; i < PIXELS; i++) {
        const float before = layer_of(&bare, "intensity")[i], by_brightness = layer_of(&frames[0], "intensity")[i],
                    by_kelvin = layer_of(&frames[1], "intensity")[i];
        const bool is_body = layer_of(&frames[1], "temperature")[i] == 0;
        assert_true(by_kelvin == by_brightness && layer_of(&frames[2], "intensity")[i] == before);
        assert_true(!is_body || by_kelvin == 0);
        hidden += is_body && before > 0;
    }
    printf("a dark body hides the disk in %d pixels\n", hidden);
    assert_true(hidden >= 8);
    for (int k = 0; k < 3; k++)
        kd_frame_finish(&frames[k]);
    kd_frame_finish(&bare);
}

/* 1/g of matter in the equatorial plane that moves with (v_r, v_phi) relative to the observer of zero angular momentum.
 * Computed from the photon's components. */
static double shift_of(double a, double q, double r, const struct ks_photon *p, double p_z, bool falls,
                       const double v[2])
{
    const double mass = 2 * r - q * q, delta = r * r - mass + a * a,
                 area = (r * r + a * a) * (r * r + a * a) - a * a * delta, k = p->momentum - a * p->energy;
    const double w = (r * r + a * a) * p->energy - a * p->momentum,
                 radial = sqrt(fmax(w * w - delta * (k * k + r * r * p_z * p_z), 0)) / delta;
    const double p_r = falls ? -radial : radial, omega = a * mass / area, lapse = r * sqrt(delta / area),
                 gamma = 1 / sqrt(1 - v[0] * v[0] - v[1] * v[1]);
    return gamma * ((p->energy - omega * p->momentum) / lapse - v[0] * p_r * sqrt(delta) / r -
                    v[1] * p->momentum * r / sqrt(area));
}

static void test_debris(void **state)
{
    (void)state;
    static const double velocities[][2] = { { 0, 0 }, { -0.4, 0.3 }, { 0.5, -0.2 } };
    for (int k = 0; k < 6; k++) {
        const double charge = k < 3 ? 0 : 0.58;
        struct kd_scene scene =
            scene_of("{\"camera\":{\"inclination_deg\":60,\"field_m\":44},\"spacetime\":{\"spin\":0.8},\"accuracy\":{"
                     "\"orders\":1},\"image\":{\"layers\":[\"rgb\",\"intensity\"]}}");
        scene.spacetime.charge = charge;
        const double cell = 2 * M_PI / 512, worth = 3e-5, kelvin = 5000, *v = velocities[k % 3];
        const int32_t from = (int32_t)floor(log(4) / cell);
        struct kd_dynamic_bodies *dynamic;
        const uint32_t rows = (uint32_t)ceil(log(18) / cell) - (uint32_t)from;
        OK(kd_dynamic_bodies_create(0, rows, 512, &dynamic, &error));
        dynamic->debris.turn = 512;
        dynamic->debris.first_row = from;
        dynamic->debris.depth = 1;
        dynamic->debris.temperature_k = kelvin;
        for (uint32_t i = 0; i < rows * 512; i++) {
            float *node = dynamic->debris.nodes + 3 * i;
            node[0] = (float)(worth * (1 + 0.5 * sin(2 * M_PI * (i % 512) / 512.0)));
            node[1] = node[0] * (float)v[0];
            node[2] = node[0] * (float)v[1];
        }
        kd_scene_show(&scene, dynamic);
        struct kd_frame frame = rendered(&scene);
        int lit = 0;
        double worst = 0;
        for (int i = 0; i < PIXELS; i++) {
            const double step = 44.0 / WIDTH, x = step * (i % WIDTH + 0.5 - 0.5 * WIDTH),
                         y = -step * (i / WIDTH + 0.5 - 0.5 * HEIGHT);
            const struct ks_photon photon = ks_from_infinity_charged(0.8, charge, 0.5, x, y);
            const struct ks_path path = ks_trace(photon, 1);
            const double inner = exp(from * cell), outer = exp((from + rows - 1.0) * cell),
                         r = path.crossings ? path.r[0] : 0;
            const float seen = layer_of(&frame, "intensity")[i];
            if (fabs(r - inner) < 0.01 * inner || fabs(r - outer) < 0.01 * outer)
                continue;
            if (r < inner || r > outer) {
                assert_true(seen == 0);
                continue;
            }
            const double depth = 1000 * worth * (1 + 0.5 * sin(path.phi[0])) / (cell * cell * r * r);
            const double t = kelvin / scene.disk.peak_temperature_k /
                             shift_of(0.8, charge, r, &photon, path.p_z[0], path.falls[0], v),
                         want = (1 - exp(-depth)) * t * t * t * t;
            worst = fmax(worst, fabs(seen / want - 1));
            lit++;
        }
        printf("charge %g, debris of velocity %g, %g: %d pixels, worst %.2g\n", charge, v[0], v[1], lit, worst);
        assert_true(lit > 60 && worst < 1e-3);
        kd_frame_finish(&frame);
        kd_dynamic_bodies_release(dynamic);
    }
}

/* A dark body far from the hole reflects light that falls on its visible side. The expected light is the full integral
 * over the disk, with ten times as many places. It uses the cosine of the straight line, because light is not bent
 * there. */
static double falls_on(const struct kd_scene *scene, const double at[3], const double normal[3])
{
    const double inner = kd_disk_inner(scene), outer = scene->disk.outer,
                 radius = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    static double heat[FINE]; /* flux at each radius of this scene's disk, computed once for all bodies */
    double sum = 0;
    for (int i = 0; i < FINE; i++)
        for (int k = 0; k < FINE; k++) {
            const double r = inner + (outer - inner) * (i + 0.5) / FINE, phi = 2 * M_PI * (k + 0.5) / FINE;
            heat[i] = heat[i] > 0 ? heat[i] : kd_disk_heat(scene, r);
            const double t = heat[i];
            const double d[3] = { r * cos(phi) - at[0], r * sin(phi) - at[1], -at[2] },
                         d2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], length = sqrt(d2);
            const double cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / length,
                         /* speed of a circular orbit in the Schwarzschild metric, relative to an observer at rest */
                v = 1 / sqrt(r - 2);
            const double towards = v * (sin(phi) * d[0] - cos(phi) * d[1]) / length,
                         g = sqrt((1 - 2 / r) / (1 - 2 / radius)) * sqrt(1 - v * v) / (1 - towards);
            sum += cosine > 0 ? t * t * t * t * g * g * g * g * cosine * fabs(at[2]) / length / d2 * r *
                                    (outer - inner) / FINE * 2 * M_PI / FINE
                              : 0;
        }
    return sum;
}

/* Light that falls on a moving body is transformed into the body's frame by the matrix of the boost, applied to the
 * four components of each photon. */
static void test_lit_moving(void **state)
{
    (void)state;
    static const double velocities[][3] = { { 0.4, 0, 0 }, { -0.3, 0.2, 0.5 }, { 0, -0.6, 0.1 } };
    struct kd_scene scene =
        scene_of("{\"spacetime\":{\"spin\":0},\"disk\":{\"model\":\"novikov-thorne\",\"outer\":25,\"taper\":0}}");
    const double r = 60, u = 0.6, s = 0.8, inner = kd_disk_inner(&scene), dr = (25 - inner) / FINE;
    struct kd_illumination lit;
    assert_true(kd_illumination_of(&scene, &lit));
    for (int k = 0; k < 3; k++) {
        const double *v = velocities[k], v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2], gamma = 1 / sqrt(1 - v2);
        const struct kd_seen_body body = {
            .r = r, .u = u, .s = s, .phi = 1, .velocity = { v[0], v[1], v[2] }, .radius = 1, .albedo = 1
        };
        double sums[10] = { 0 };
        float got[12];
        kd_illumination_body(&lit, &body, sqrt(1 - 2 / r), got);
        for (int i = 0; i < FINE * FINE; i++) {
            const double at = inner + dr * (i / FINE + 0.5), phi = 2 * M_PI * (i % FINE + 0.5) / FINE,
                         t = kd_disk_heat(&scene, at);
            const double d[3] = { at * cos(phi) - r * s, at * sin(phi), -r * u },
                         length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), gas = 1 / sqrt(at - 2);
            /* The photon moves along -d. Its energy in the gas's frame is gamma (1 + v.d). Its components in the body's
             * frame are the boosted ones. */
            const double k4[4] = { 1, -(s * d[0] + u * d[2]) / length, -(u * d[0] - s * d[2]) / length,
                                   -d[1] / length };
            const double emitted = (1 + gas * (-sin(phi) * d[0] + cos(phi) * d[1]) / length) / sqrt(1 - gas * gas);
            double seen[4] = { gamma * k4[0], 0, 0, 0 };
            for (int m = 0; m < 3; m++) {
                seen[0] -= gamma * v[m] * k4[m + 1];
                seen[m + 1] = k4[m + 1] - gamma * v[m] * k4[0];
                for (int n = 0; n < 3; n++)
                    seen[m + 1] += (gamma - 1) * v[m] * v[n] / v2 * k4[n + 1];
            }
            const double g = seen[0] / emitted * sqrt((1 - 2 / at) / (1 - 2 / r)),
                         from[3] = { -seen[1] / seen[0], -seen[2] / seen[0], -seen[3] / seen[0] };
            const double solid = at * dr * (2 * M_PI / FINE) * r * u / (length * length * length),
                         f = pow(t * g, 4) * solid / (seen[0] * seen[0]) / M_PI;
            const double all[10] = { f,
                                     f * from[0],
                                     f * from[1],
                                     f * from[2],
                                     f * from[0] * from[0],
                                     f * from[1] * from[1],
                                     f * from[2] * from[2],
                                     f * from[0] * from[1],
                                     f * from[0] * from[2],
                                     f * from[1] * from[2] };
            for (int m = 0; m < 10; m++)
                sums[m] += all[m];
        }
        const float order[10] = { got[0], got[1], got[2], got[3], got[4], got[5], got[6], got[8], got[9], got[10] };
        printf("moving %d: %.4g and %.4g\n", k, got[0], sums[0]);
        for (int m = 0; m < 10; m++)
            if (fabs(order[m] - sums[m]) > 0.02 * sums[0])
                fail_msg("moment %d: %g, not %g, of %g", m, order[m], sums[m], sums[0]);
    }
}

static void test_lit(void **state)
{
    (void)state;
    static const double polar[] = { 20, 60, 140 };
    for (int k = 0; k < 3; k++) {
        struct kd_scene scene = scene_of("{\"camera\":{\"inclination_deg\":70,\"field_m\":30},\"spacetime\":{\"spin\":"
                                         "0},\"disk\":{\"model\":\"novikov-thorne\",\"outer\":25,\"taper\":0},"
                                         "\"image\":{\"layers\":[\"rgb\",\"intensity\"]}}");
        const double theta = polar[k] * M_PI / 180, phi = 2.6, r = 150, i = 70 * M_PI / 180, step = 30.0 / WIDTH;
        const double at[3] = { r * sin(theta) * cos(phi), r * sin(theta) * sin(phi), r * cos(theta) };
        struct kd_dynamic_bodies *dynamic = one(&(struct kd_seen_body) { .r = r,
                                                                         .u = cos(theta),
                                                                         .s = sin(theta),
                                                                         .phi = phi,
                                                                         .radius = 6,
                                                                         .temperature_k = 5000,
                                                                         .albedo = 0.5 },
                                                1);
        /* In this wide picture light is bent only weakly. A first estimate of the image's position is therefore
         * accurate enough. */
        double image[2] = { at[1], sin(i) * at[2] - cos(i) * at[0] };
        const double ahead = sin(i) * at[0] + cos(i) * at[2], impact = hypot(image[0], image[1]),
                     more = ahead < 0 ? 4 * -ahead / impact / impact : 0;
        scene.camera.centre_alpha = image[0] * (1 + more);
        scene.camera.centre_beta = image[1] * (1 + more);
        kd_scene_show(&scene, dynamic);
        struct kd_frame frame = rendered(&scene);
        double sum = 0, want = 0, most = 0;
        for (int p = 0; p < PIXELS; p++) {
            const double x = step * (p % WIDTH + 0.5 - 0.5 * WIDTH) / 6,
                         y = -step * (p / WIDTH + 0.5 - 0.5 * HEIGHT) / 6, z = sqrt(fmax(1 - x * x - y * y, 0));
            const double normal[3] = { z * sin(i) - y * cos(i), x, z * cos(i) + y * sin(i) };
            most = fmax(most, layer_of(&frame, "intensity")[p]);
            sum += layer_of(&frame, "intensity")[p];
            if (x * x + y * y < 1)
                want += 0.5 / M_PI * falls_on(&scene, at, normal) *
                        pow(1 - 2 / r, 2); /* the body's own redshift: the fourth power of sqrt(1 - 2/r) */
        }
        printf("polar angle %g: %.4g of light, %.4g by the whole integral, brightest %.2g\n", polar[k], sum, want,
               most);
        assert_true(want > 0 && fabs(sum / want - 1) < 0.1);
        kd_frame_finish(&frame);
        kd_dynamic_bodies_release(dynamic);
    }
}

/* Extreme bodies give finite pixels. */
static void test_adversarial(void **state)
{
    (void)state;
    const struct kd_seen_body plain = { .r = 12, .s = 1, .radius = 1, .temperature_k = 6000, .brightness = 1 };
    for (int k = 0; k < 8; k++) {
        struct kd_scene scene = scene_of("{\"camera\":{\"inclination_deg\":75,\"field_m\":40},\"disk\":{\"model\":"
                                         "\"novikov-thorne\"},\"image\":{\"layers\":[\"rgb\",\"intensity\"]}}");
        struct kd_seen_body body = plain;
        body.r = k == 1 ? 1.2 : k == 2 ? NAN : k == 3 ? 0 : body.r;
        body.velocity[0] = k == 4 ? 1 : k == 5 ? -0.9999999 : 0;
        body.radius = k == 6 ? INFINITY : body.radius;
        body.temperature_k = k == 7 ? 1e300 : body.temperature_k;
        struct kd_dynamic_bodies *dynamic =
            one(&body, k == 5 ? 64 : MANY); /* this body is so fast that its image is stretched and no ray misses it */
        for (size_t i = 0; k == 7 && i < MANY; i++) { /* puts bodies everywhere */
            dynamic->bodies[i].r = 1 + 1e4 * chance() * chance() * chance();
            dynamic->bodies[i].phi = 1e3 * chance();
            dynamic->bodies[i].radius = 1e3 * pow(chance(), 9);
        }
        kd_scene_show(&scene, dynamic);
        struct kd_frame frame = rendered(&scene);
        for (int i = 0; i < PIXELS; i++)
            if (!(layer_of(&frame, "intensity")[i] >= 0 && isfinite(layer_of(&frame, "intensity")[i])))
                fail_msg("crowd %d, pixel %d: %g", k, i, layer_of(&frame, "intensity")[i]);
        printf("crowd %d: march %.3g ms, %llu given up\n", k, timing_of(&frame, "march"),
               (unsigned long long)frame.accuracy.undecided);
        kd_frame_finish(&frame);
        kd_dynamic_bodies_release(dynamic);
    }
}

/* A scene without bodies of a playground has no emitter for them in its plan, and therefore no cost. */
static void test_off(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of("{\"disk\":{\"model\":\"novikov-thorne\"}}"), shown = scene;
    struct kd_dynamic_bodies *dynamic =
        one(&(struct kd_seen_body) { .r = 12, .s = 1, .radius = 1, .temperature_k = 6000 }, 0);
    struct kd_capacity c;
    struct kd_plan without, with;
    kd_scene_show(&shown, dynamic);
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &without, &error));
    OK(kd_plan_make(&shown, &c, &with, &error));
    assert_memory_equal(without.light.traits, with.light.traits, sizeof with.light.traits);
    assert_string_equal(without.lens.key, with.lens.key);
    assert_true(!with.light.march.steps);
    kd_dynamic_bodies_release(dynamic);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places),      cmocka_unit_test(test_as_a_scene_has_it),
        cmocka_unit_test(test_dark),        cmocka_unit_test(test_debris),
        cmocka_unit_test(test_lit),         cmocka_unit_test(test_lit_moving),
        cmocka_unit_test(test_adversarial), cmocka_unit_test(test_off),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
