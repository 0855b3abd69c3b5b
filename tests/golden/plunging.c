/* Tests of the appearance of the gas that falls from the ISCO: its density, redshift and delay. The expected rays are
 * computed by the closed form in double precision, redshifts by contraction with the metric, and densities from the
 * flow of particles. */
#include "studio.h"

#include "contraction.h"
#include "physics/null/null_geodesic.h"
#include "physics/orbit/plunge.h"
#include "physics/spacetime/kerr.h"
#include "render/view/camera.h"
#include "render/emit/particles.h"
#include "render/emit/plunging.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

struct ray {
    struct kd_camera_label label;
    double lambda, eta;
    struct kd_null_path path;
};

static struct ray ray_of(const struct kd_scene *scene, uint32_t x, uint32_t y)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    double i = scene->camera.inclination_deg * (M_PI / 180), a = scene->spacetime.spin;
    struct ray ray;
    kd_camera_label(&camera, x, y, &ray.label);
    double alpha = ray.label.alpha, beta = ray.label.beta, c = cos(i);
    ray.lambda = -alpha * sin(i);
    ray.eta = (alpha - a) * (alpha + a) * c * c + beta * beta;
    const struct kd_null_ray null = {
        .hole = kd_hole_charged(a, scene->spacetime.charge),
        .radius = scene->camera.r,
        .cos_theta = c,
        .sin_theta = sin(i),
        .alpha = alpha,
        .beta = beta,
        .outward = ray.label.outward,
        .orders = 1,
    };
    ray.path = kd_null_trace_fast(&null);
    return ray;
}

static bool meets_the_plunge(const struct kd_scene *scene, const struct ray *ray)
{
    const struct kd_plunging p = kd_plunging_of(scene);
    return ray->path.crossings && ray->path.crossing[0].r > 1.001 * p.end && ray->path.crossing[0].r < 0.999 * p.start;
}

static struct kd_frame shot(struct kd_scene *scene, bool doppler, bool redshift)
{
    scene->disk.doppler = doppler;
    scene->disk.redshift = redshift;
    return studio_render(scene);
}

#define AMONG_IT \
    "\"spacetime\":{\"spin\":0.3}," \
    "\"camera\":{\"r\":3.2,\"observer\":\"zamo\",\"inclination_deg\":75,\"fov_deg\":120,\"yaw_deg\":180}"

/* Compares a pixel with and without the factors of g. Brightness is proportional to g^4, whatever the gas's state. Seen
 * from far away, most light left the gas outwards. An observer inside also sees light that moves inwards. The fourth
 * root of a luminance of 0.01 in 16 bits has an accuracy of 1e-4. */
static void redshift_of_light(void **state)
{
    (void)state;
    static const struct {
        const char *what, *json, *accuracy;
    } views[] = {
        { "from afar", "\"spacetime\":{\"spin\":0.3},\"camera\":{\"inclination_deg\":60,\"field_m\":14}", "" },
        { "from afar, fast", "\"spacetime\":{\"spin\":0.95},\"camera\":{\"inclination_deg\":40,\"field_m\":8}", "" },
        { "retrograde", "\"spacetime\":{\"spin\":-0.7},\"camera\":{\"inclination_deg\":75,\"field_m\":20}", "" },
        { "charged", "\"spacetime\":{\"spin\":0.2,\"charge\":0.95},\"camera\":{\"inclination_deg\":60,\"field_m\":10}",
          "" },
        { "closed", "\"spacetime\":{\"spin\":-0.7},\"camera\":{\"inclination_deg\":75,\"field_m\":20}",
          ",\"engine\":\"closed\",\"precision\":\"f64\"" },
        { "near",
          "\"spacetime\":{\"spin\":0.3},\"camera\":{\"r\":12,\"observer\":\"zamo\",\"inclination_deg\":70,\"fov_deg\":"
          "60}",
          "" },
        { "from among it", AMONG_IT, "" },
        { "from among it, listed", AMONG_IT, ",\"precision\":\"f64\"" },
    };
    /* first index: light that moves inwards; light that moves outwards. second index: 1/u^t; g; g u^t */
    int judged[2][3] = { { 0 } };
    double worst[3] = { 0 };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        char json[1024];
        bool wide = strstr(views[v].accuracy, "f64") && !strstr(views[v].accuracy, "closed");
        if (wide && !studio_has_float64(views[v].what))
            continue;
        snprintf(
            json, sizeof json,
            "{%s,"
            "\"disk\":{\"model\":\"particles\",\"plunging\":0.5,\"plunging_temperature\":1,\"density_index\":0},"
            "\"image\":{\"width\":160,\"height\":120,\"samples\":1,\"bit_depth\":16},\"accuracy\":{\"orders\":1%s},"
            "\"style\":{\"exposure\":-2,\"tone_map\":\"srgb\",\"dither\":false}}",
            views[v].json, views[v].accuracy);
        struct kd_scene scene = studio_scene(NULL, json);
        const struct kd_hole hole = kd_hole_charged(scene.spacetime.spin, scene.spacetime.charge);
        struct kd_frame plain = shot(&scene, false, false), slowed = shot(&scene, false, true),
                        full = shot(&scene, true, true), moved = shot(&scene, true, false);
        const struct kd_plunge plunge = kd_plunge_of(&hole);
        const struct plunge_by_metric gas = plunge_by_metric(hole.a, hole.q);
        for (uint32_t y = 0; y < 120; y++)
            for (uint32_t x = 0; x < 160; x++) {
                struct ray ray = ray_of(&scene, x, y);
                double base = studio_luminance(&plain, x, y);
                const double light[] = { studio_luminance(&slowed, x, y), studio_luminance(&full, x, y),
                                         studio_luminance(&moved, x, y) };
                if (!meets_the_plunge(&scene, &ray) || base < 0.01)
                    continue;
                double r = ray.path.crossing[0].r; /* the redshift of the near observer is included in every picture */
                int sense = ray.path.crossing[0].sense;
                double ut = kd_plunge_velocity(&plunge, r).ut,
                       g = redshift_of_plunge(&gas, r, ray.lambda, ray.eta, sense);
                const double want[] = { 1 / ut, g, g * ut };
                for (int k = 0; k < 3; k++) {
                    if (light[k] < 0.01)
                        continue;
                    double off = fabs(pow(light[k] / base, 0.25) / want[k] - 1);
                    if (!(off < 2e-3))
                        fail_msg("%s, pixel %u %u, r = %g: g %g, not %g", views[v].what, x, y, r,
                                 pow(light[k] / base, 0.25), want[k]);
                    worst[k] = fmax(worst[k], off);
                    judged[sense > 0][k]++;
                }
            }
        printf("%s: so far light outwards, inwards: 1/u^t of %d and %d pixels within %.2g, g of %d and %d within %.2g, "
               "g u^t "
               "of %d and %d within %.2g\n",
               views[v].what, judged[1][0], judged[0][0], worst[0], judged[1][1], judged[0][1], worst[1], judged[1][2],
               judged[0][2], worst[2]);
        kd_frame_finish(&plain);
        kd_frame_finish(&slowed);
        kd_frame_finish(&full);
        kd_frame_finish(&moved);
    }
    for (int sense = 0; sense < 2; sense++)
        for (int k = 0; k < 3; k++)
            assert_true(judged[sense][k] > 500);
}

/* Face-on and without redshift, the optical depth of thin gas in each ring equals that of the flow. The flow's depth is
 * the rate of particles through a circle, divided by 2 pi r u^r, and by the number of particles per area at the disk's
 * edge. The error is the Poisson error of 10 000 parcels for each seed. Depths are below 0.05, because clumpy gas emits
 * less than even gas, by half the depth. */
static void surface_density(void **state)
{
    (void)state;
    enum { SEEDS = 4, PIXELS = 320, RINGS = 4 };
    double got[RINGS] = { 0 }, want[RINGS] = { 0 };
    for (int seed = 0; seed < SEEDS; seed++) {
        char json[1024];
        snprintf(
            json, sizeof json,
            "{\"time\":%d,\"spacetime\":{\"spin\":0.5},\"camera\":{\"inclination_deg\":0,\"field_m\":12},"
            "\"disk\":{\"model\":\"particles\",\"particles\":10000000,\"plunging\":0.001,\"plunging_temperature\":1,"
            "\"seed\":%d,\"doppler\":false,\"redshift\":false,\"density_index\":1},"
            "\"image\":{\"width\":%d,\"height\":%d,\"samples\":1,\"bit_depth\":16},\"accuracy\":{\"orders\":1},"
            "\"style\":{\"exposure\":1,\"tone_map\":\"srgb\",\"dither\":false}}",
            1000 * seed - 1500, seed, PIXELS, PIXELS);
        struct kd_scene scene = studio_scene(NULL, json);
        struct kd_frame frame = studio_render(&scene);
        const struct kd_plunging p = kd_plunging_of(&scene);
        double isco = p.curve.isco, n = 1e7, step = 1e-4;
        /* (1 - plunging) n particles are on circular orbits; this is their number per radius at the ISCO, from the
         * distribution of radii */
        double circling =
            (1 - 0.001) * n * step / (kd_particle_radius(&scene, 0.02 + step) - kd_particle_radius(&scene, 0.02));
        double r_there = kd_particle_radius(&scene, 0.02 + step / 2);
        circling *= pow(isco / r_there, 1 - scene.disk.density_index); /* dN/dr is proportional to r^(1 - p) */
        double edge = circling / (2 * M_PI * isco * kd_kerr_ut(kd_hole(0.5), isco));
        for (uint32_t y = 0; y < PIXELS; y++)
            for (uint32_t x = 0; x < PIXELS; x++) {
                struct ray ray = ray_of(&scene, x, y);
                if (!meets_the_plunge(&scene, &ray))
                    continue;
                double r = ray.path.crossing[0].r, ur = -kd_plunge_velocity(&p.curve, r).ur;
                double depth = 0.001 * n / p.time / (2 * M_PI * r * ur) / edge, phase = kd_plunging_at(&p, r).phase;
                int ring = (int)(RINGS * phase);
                if (depth > 0.05)
                    continue;
                got[ring] += studio_luminance(&frame, x, y) / 2;
                want[ring] += 1 - exp(-depth);
            }
        kd_frame_finish(&frame);
    }
    for (int k = 1; k < RINGS; k++) { /* the first ring is too dense */
        double poisson = 1 / sqrt(SEEDS * 1e4 / RINGS), off = got[k] / want[k] - 1;
        printf("phase %g to %g: %+.3f, Poisson error %.3f\n", k / 4.0, (k + 1) / 4.0, off, poisson);
        assert_true(fabs(off) < 3 * poisson + 0.015);
    }
}

/* Slow light: a pixel of the stream equals that of a picture without slow light at the emission time. This is tested
 * for far and near observers. The last steps of brightness differ, because parcels at other positions between the
 * grid's nodes are blurred differently. */
static void delay_of_light(void **state)
{
    (void)state;
    for (int near = 0; near < 2; near++) {
        struct kd_scene scene = studio_scene(NULL, "{\"time\":700,\"spacetime\":{\"spin\":0.3},"
                                                   "\"camera\":{\"inclination_deg\":65,\"field_m\":16,\"fov_deg\":30},"
                                                   "\"image\":{\"width\":160,\"height\":90,\"samples\":1},"
                                                   "\"disk\":{\"model\":\"particles\",\"particles\":20000,\"plunging\":"
                                                   "0.5,\"plunging_temperature\":1,\"doppler\":false,"
                                                   "\"redshift\":false,\"slow_light\":true},\"style\":{\"exposure\":-1,"
                                                   "\"tone_map\":\"srgb\",\"dither\":false}}");
        if (near)
            scene.camera.r = 30;
        struct kd_frame slow = studio_render(&scene);
        scene.disk.slow_light = false;
        struct kd_frame fast = studio_render(&scene);
        double then_off = 0, now_off = 0, worst = 0;
        int n = 0;
        for (uint32_t at = 1000; at < 160 * 90 && n < 40; at += 53) {
            uint32_t x = at % 160, y = at / 160;
            struct ray ray = ray_of(&scene, x, y);
            if (!meets_the_plunge(&scene, &ray))
                continue;
            scene.top.time = 700 - ray.path.crossing[0].delay;
            struct kd_frame then = studio_render(&scene);
            double off = fabs(studio_value(&slow, x, y, 1) - studio_value(&then, x, y, 1));
            then_off += off;
            worst = fmax(worst, off);
            now_off += fabs(studio_value(&slow, x, y, 1) - studio_value(&fast, x, y, 1));
            kd_frame_finish(&then);
            n++;
        }
        printf("%s: %g of 255 from the time of emission (worst %g), %g from now, %d pixels\n", near ? "near" : "far",
               255 * then_off / n, 255 * worst, 255 * now_off / n, n);
        assert_true(n > 15 && now_off > 3 * then_off);
        kd_frame_finish(&slow);
        kd_frame_finish(&fast);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(redshift_of_light), cmocka_unit_test(surface_density),
                                        cmocka_unit_test(delay_of_light) };
    int code = studio_open();
    if (code)
        return code;
    code = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return code;
}
