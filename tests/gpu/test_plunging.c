/* Tests of particles that fall from the ISCO, as computed by the device. Their positions are compared with geodesics
 * integrated from the metric, and at any time they must form a steady stream. When they are switched off, they cause no
 * cost. */
#include "render/plan/sample.h"
#include "render/emit/particles.h"

#include "physics/spacetime/kerr.h"
#include "render/emit/plunging.h"
#include "render_support.h"
#include "render/device/prepare.h"
#include "render/emit/deposit.h"

#include <math.h>

#define COUNT 20000
#define FALLING 4000

static struct kd_scene plunging_scene(double spin, double charge)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 160;
    scene.image.height = 90;
    scene.spacetime.spin = spin;
    scene.spacetime.charge = charge;
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = COUNT;
    scene.disk.plunging = (double)FALLING / COUNT;
    return scene;
}

static void places_at(struct kd_scene *scene, double time, struct kd_particle_place *out)
{
    struct kd_emitter_buffers_work work;
    scene->top.time = time;
    OK(kd_prepare_asked(renderer, KD_EMITTER_particles, &work, &error));
    OK(kd_particles_places(&work, scene, 0, 1, FALLING, out, &error));
}

/* dr/dt and dphi/dt of a falling body with the ISCO's E and L: the inverse metric raises the indices, and u^r follows
 * from u.u = -1. */
static void slopes(const struct kd_hole *hole, double r, double *dr, double *dphi)
{
    double a = hole->a, q = hole->q, isco = kd_kerr_isco(hole), e = kd_kerr_energy(hole, isco),
           l = kd_kerr_momentum(hole, isco), f = 2 / r - q * q / (r * r), delta = r * r * (1 - f) + a * a;
    double pp = r * r + a * a + a * a * f;
    double ut = (pp * e - a * f * l) / delta, up = (a * f * e + (1 - f) * l) / delta;
    *dr = -sqrt(fmax(e * ut - l * up - 1, 0) * delta) / r / ut;
    *dphi = up / ut;
}

/* Runge-Kutta of fourth order. */
static void integrate(const struct kd_hole *hole, double time, double *r, double *phi)
{
    enum { STEPS = 400 };
    double h = time / STEPS, k[4], w[4];
    for (int i = 0; i < STEPS; i++) {
        slopes(hole, *r, &k[0], &w[0]);
        slopes(hole, *r + h / 2 * k[0], &k[1], &w[1]);
        slopes(hole, *r + h / 2 * k[1], &k[2], &w[2]);
        slopes(hole, *r + h * k[2], &k[3], &w[3]);
        *r += h / 6 * (k[0] + 2 * k[1] + 2 * k[2] + k[3]);
        *phi += h / 6 * (w[0] + 2 * w[1] + 2 * w[2] + w[3]);
    }
}

static double angle(uint32_t turns) { return turns * (2 * M_PI / 4294967296.0); }

/* A particle at (r, phi) either continues along its geodesic, or has started again. Tested at early, late and negative
 * times. Each reported r has an error of 6e-8 (single precision). */
static void test_geodesics(void **state)
{
    (void)state;
    static const double holes[][2] = { { -0.9, 0 },  { 0, 0 },    { 0.5, 0 },   { 0.9, 0 },
                                       { 0.998, 0 }, { 0, 0.99 }, { 0.5, 0.8 }, { -0.8, 0.5 } },
                        times[] = { 0, 1e4, -1e4, 1e9 };
    static struct kd_particle_place start[FALLING], then[FALLING];
    const double step = 12.5;
    double worst[2] = { 0 };
    for (size_t s = 0; s < sizeof holes / sizeof *holes; s++) {
        const struct kd_hole hole = kd_hole_charged(holes[s][0], holes[s][1]);
        struct kd_scene scene = plunging_scene(hole.a, hole.q);
        const struct kd_plunging p = kd_plunging_of(&scene);
        for (size_t k = 0; k < sizeof times / sizeof *times; k++) {
            int fell = 0, anew = 0;
            places_at(&scene, times[k], start);
            places_at(&scene, times[k] + step, then);
            for (int i = 0; i < FALLING; i++) {
                assert_true(start[i].plunging && start[i].latitude == 0);
                assert_true(start[i].r <= (float)p.start && start[i].r >= (float)p.end);
                if (then[i].r > start[i].r) {
                    anew++;
                    continue;
                }
                fell++;
                if (i % 40)
                    continue;
                double r = start[i].r, phi = 0;
                integrate(&hole, step, &r, &phi);
                double off_r = fabs(then[i].r / r - 1);
                double off_phi = fabs(remainder(angle(then[i].phi - start[i].phi) - phi, 2 * M_PI));
                if (!(off_r < 1e-6 && off_phi < 2e-6))
                    fail_msg("a = %g, q = %g, t = %g, from r = %g: r %g, not %g; phi off by %.2g", hole.a, hole.q,
                             times[k], start[i].r, then[i].r, r, off_phi);
                worst[0] = fmax(worst[0], off_r);
                worst[1] = fmax(worst[1], off_phi);
            }
            double share = step / p.time, sigma = sqrt(FALLING * share * (1 - share));
            if (!(fabs(anew - FALLING * share) < 4 * sigma && fell + anew == FALLING))
                fail_msg("a = %g, q = %g, t = %g: %d begin anew, not %g", hole.a, hole.q, times[k], anew,
                         FALLING * share);
        }
    }
    printf("plunges over %g M: r within %.2g, phi within %.2g rad\n", step, worst[0], worst[1]);
}

/* The particles are a steady stream at any time: uniform in coordinate time along the curve, and in azimuth. Each fall
 * of a particle has an azimuth of its own, which is the same in every run. */
static void test_stream(void **state)
{
    (void)state;
    enum { BINS = 8 };
    static struct kd_particle_place at[FALLING], later[FALLING], again[FALLING];
    struct kd_scene scene = plunging_scene(0.7, 0);
    const struct kd_plunging p = kd_plunging_of(&scene);
    static const double times[] = { 0, -777, 123456.789 };
    for (size_t k = 0; k < sizeof times / sizeof *times; k++) {
        int phases[BINS] = { 0 }, turns[BINS] = { 0 }, same = 0;
        places_at(&scene, times[k], at);
        places_at(&scene, times[k] + p.time, later);
        places_at(&scene, times[k], again);
        assert_memory_equal(at, again, sizeof at);
        for (int i = 0; i < FALLING; i++) {
            phases[(int)fmin(BINS - 1, BINS * kd_plunging_at(&p, at[i].r).phase)]++;
            turns[at[i].phi >> 29]++;
            assert_true(fabs(later[i].r / at[i].r - 1) < 1e-6);
            double lag = remainder(angle(later[i].phi - at[i].phi) - p.omega * p.time, 2 * M_PI);
            same += fabs(lag) < 0.01;
        }
        double mean = FALLING / BINS, sigma = sqrt(mean * (1 - 1.0 / BINS));
        for (int b = 0; b < BINS; b++)
            assert_true(fabs(phases[b] - mean) < 4 * sigma && fabs(turns[b] - mean) < 4 * sigma);
        assert_true(same < 40); /* by chance, 13 equal values are expected */
    }
}

/* w' of the lens map in single precision equals w' of listed rays in double precision, including its sign. */
static void test_slopes(void **state)
{
    (void)state;
    if (!has_float64("slopes in f64"))
        skip();
    static const double cameras[] = { INFINITY, 20, 3 };
    for (size_t v = 0; v < 3; v++) {
        struct kd_scene scene = plunging_scene(0.3, 0);
        scene.camera.inclination_deg = 70;
        scene.camera.r = cameras[v];
        scene.camera.observer = KD_OBSERVER_ZAMO;
        scene.camera.field_m = 20;
        scene.camera.fov_deg = v == 1 ? 50 : 120;
        scene.camera.yaw_deg = v == 2 ? 180 : 0;
        float *planes[2];
        struct kd_plan plan[2];
        struct kd_capacity c;
        kd_renderer_capacity(renderer, &c);
        for (int k = 0; k < 2; k++) {
            scene.accuracy.precision = 1 + (k ? KD_PRECISION_F64 : KD_PRECISION_F32);
            OK(kd_scene_validate(&scene, &error));
            OK(kd_plan_make(&scene, &c, &plan[k], &error));
            assert_true(kd_plan_holds(&plan[k].lens, KD_LENS_SLOPE) && plan[k].lens.planes == 3 * plan[k].lens.orders);
            bool closed = scene.camera.r > 1.05 * kd_kerr_photon_orbit(kd_hole(-0.3));
            assert_true(plan[k].lens.path == (k ? KD_LENS_LISTED : closed ? KD_LENS_CLOSED : KD_LENS_MAP));
            planes[k] = test_malloc(4 * plan[k].lens.planes * plan[k].lens.rays);
            OK(kd_render_lens(renderer, &scene, &plan[k], planes[k], NULL, &error));
        }
        uint64_t n = plan[0].lens.rays, orders = plan[0].lens.orders;
        double isco = kd_kerr_isco(kd_hole(0.3)), worst = 0;
        int signs[2] = { 0 }, far = 0;
        for (uint64_t at = 0; at < orders * n; at++) {
            uint64_t slope = at + 2 * orders * n;
            double w[] = { planes[0][at], planes[1][at] }, dw[] = { planes[0][slope], planes[1][slope] };
            if (!(w[0] > 1.01 / isco && w[1] > 0 && fabs(w[0] / w[1] - 1) < 1e-4 &&
                  1 / w[0] > 1.02 * kd_hole(0.3)->outer))
                continue; /* skipped, because only one of them has the crossing, or because the crossing is next to
                           * the critical curve */
            double off = fabs(dw[0] - dw[1]) / (fabs(dw[1]) + 0.05);
            far += off > 1e-3;
            worst = fmax(worst, off);
            signs[dw[1] > 0]++;
        }
        printf("slopes, camera at %g: %d inwards, %d outwards, within %.2g\n", cameras[v], signs[1], signs[0], worst);
        assert_true(signs[1] + signs[0] > 300 && signs[0] > 30 && far == 0);
        test_free(planes[0]);
        test_free(planes[1]);
    }
}

/* Without plunging particles there are neither planes nor a second grid for them. */
static void test_off(void **state)
{
    (void)state;
    struct kd_scene scenes[4];
    struct kd_plan plans[4];
    struct kd_capacity c;
    kd_renderer_capacity(renderer, &c);
    for (int k = 0; k < 4; k++)
        scenes[k] = plunging_scene(0.5, 0);
    scenes[1].disk.plunging = 0;
    scenes[2].disk.inner = 6;
    scenes[3].disk.plunging_temperature = 0;
    for (int k = 0; k < 4; k++)
        OK(kd_plan_make(&scenes[k], &c, &plans[k], &error));
    struct kd_particle_grid grids[4];
    for (int k = 0; k < 4; k++)
        grids[k] = kd_particle_grid(&scenes[k]);
    assert_true(kd_plan_holds(&plans[0].lens, KD_LENS_SLOPE) && grids[0].plunging == FALLING &&
                plans[0].lens.planes == 3 * plans[0].lens.orders);
    for (int k = 1; k < 4; k++)
        assert_true(!kd_plan_holds(&plans[k].lens, KD_LENS_SLOPE) && plans[k].lens.planes == 2 * plans[k].lens.orders &&
                    strcmp(plans[k].lens.key, plans[0].lens.key));
    assert_true(!grids[1].plunging && !grids[2].plunging && grids[3].plunging == FALLING);
    assert_true(grids[1].bytes < grids[0].bytes && !grids[1].plunge_rows);
    assert_int_equal(plans[0].cost.device_bytes - plans[1].cost.device_bytes,
                     grids[0].bytes - grids[1].bytes + plans[0].cost.lens_bytes - plans[1].cost.lens_bytes +
                         kd_sample_bytes(&plans[0]) - kd_sample_bytes(&plans[1]));
    assert_true(plans[0].report.n_approximations == plans[1].report.n_approximations + 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_geodesics), cmocka_unit_test(test_stream),
                                        cmocka_unit_test(test_slopes), cmocka_unit_test(test_off) };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
