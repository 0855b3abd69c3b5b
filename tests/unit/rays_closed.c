/* kd_rays_trace with the closed engine: against geodesics in Kerr-Schild coordinates, and what it does around them. */
#include "physics/disk.h"
#include "physics/kerr.h"
#include "render/rays/rays.h"

#include "kerr_schild.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define ORDERS 3

static struct kd_rays_params params_of(double spin, double inclination_deg)
{
    return (struct kd_rays_params) { .spin = spin,
                                     .r = INFINITY,
                                     .inclination_deg = inclination_deg,
                                     .orders = ORDERS,
                                     .engine = KD_ENGINE_CLOSED,
                                     .precision = KD_PRECISION_F64 };
}

static void trace_one(const struct kd_rays_params *params, double alpha, double beta, struct kd_ray_crossing *crossings,
                      struct kd_ray_end *end)
{
    const double ray[2] = { alpha, beta };
    struct kd_error error = { 0 };
    if (kd_rays_trace(NULL, params, ray, 1, crossings, end, NULL, NULL, &error))
        fail_msg("%s (at %s)", error.message, error.pointer);
}

static bool same_azimuth(double a, double b, double bound) { return fabs(remainder(a - b, 2 * M_PI)) < bound; }

/* The oracle starts at 1e6 M by a series, good to 1e-9 or so; that grows by up to 23 an order. */
static void against_the_oracle(void **state)
{
    (void)state;
    static const double cases[][2] = { { 0, 60 }, { 0.5, 85 }, { -0.8, 30 }, { 0.95, 120 }, { 0.99, 17 } };
    int compared = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct kd_rays_params p = params_of(cases[i][0], cases[i][1]);
        for (double alpha = -9.3; alpha < 10; alpha += 3.1)
            for (double beta = -8.6; beta < 9; beta += 2.83) {
                struct kd_ray_crossing c[ORDERS];
                struct kd_ray_end end;
                trace_one(&p, alpha, beta, c, &end);
                struct ks_path path =
                    ks_trace(ks_from_infinity(p.spin, cos(p.inclination_deg * M_PI / 180), alpha, beta), ORDERS);
                if (path.fate == KS_UNDECIDED)
                    continue;
                assert_int_equal(end.fate, path.fate == KS_CAPTURED ? KD_RAY_CAPTURED : KD_RAY_ESCAPED);
                assert_int_equal(end.n_crossings, path.crossings);
                for (int n = 0; n < path.crossings; n++) {
                    double bound = 3e-8 * pow(23, n);
                    if (!(fabs(c[n].r / path.r[n] - 1) < bound) || !same_azimuth(c[n].phi, path.phi[n], bound))
                        fail_msg("a = %g, i = %g, (%g, %g), order %d: r %.12g not %.12g, phi %.12g not %.12g", p.spin,
                                 p.inclination_deg, alpha, beta, n, c[n].r, path.r[n], c[n].phi, path.phi[n]);
                }
                if (end.fate == KD_RAY_ESCAPED) {
                    assert_true(fabs(end.theta - acos(path.u)) < 1e-6);
                    assert_true(same_azimuth(end.phi, path.sky_phi, 1e-6));
                }
                compared++;
            }
    }
    assert_true(compared > 200);
}

/* From outside the ISCO to inside it g goes on without a step, and every number that should be there is. */
static void redshift(void **state)
{
    (void)state;
    const struct kd_rays_params p = params_of(0.3, 50);
    double isco = kd_kerr_isco(p.spin), last = NAN, last_r = NAN, step = 0;
    bool inside = false, outside = false;
    for (double beta = 2; beta < 7; beta += 0.001) {
        struct kd_ray_crossing c[ORDERS];
        struct kd_ray_end end;
        trace_one(&p, -4, beta, c, &end);
        if (!end.n_crossings)
            continue;
        assert_true(c[0].g > 0 && c[0].g < 3);
        if (c[0].r >= isco)
            assert_true(fabs(c[0].g / kd_disk_redshift(p.spin, c[0].r, 4 * sin(50 * M_PI / 180)) - 1) < 1e-14);
        if ((last_r - isco) * (c[0].r - isco) < 0)
            step = fabs(c[0].g - last);
        inside |= c[0].r < isco;
        outside |= c[0].r > isco;
        last = c[0].g, last_r = c[0].r;
    }
    assert_true(inside && outside && step > 0 && step < 2e-3);
}

/* Radii fall until the turning point and rise after it: so where the next crossing is nearer, the ray is still on
 * its way in (the photon leaves outwards), and where the last one was nearer, it is on its way out. Rays close to
 * the critical curve cross the plane on both, all inside the ISCO at a = 0. */
static void redshift_knows_the_turning_point(void **state)
{
    (void)state;
    const struct kd_rays_params p = params_of(0, 80);
    int before = 0, after = 0;
    for (double excess = 1e-5; excess < 0.1; excess *= 1.5) {
        double b = 3 * sqrt(3) * (1 + excess);
        struct kd_ray_crossing c[ORDERS];
        struct kd_ray_end end;
        trace_one(&p, 0, b, c, &end);
        assert_int_equal(end.fate, KD_RAY_ESCAPED);
        for (uint32_t n = 0; n < end.n_crossings; n++) {
            bool in = n + 1 < end.n_crossings && c[n + 1].r < c[n].r, out = n && c[n - 1].r < c[n].r;
            if (c[n].r >= 6 || in == out)
                continue;
            double want = kd_disk_redshift_plunging(0, c[n].r, 0, b * b, in);
            assert_true(fabs(c[n].g / want - 1) < 1e-12);
            before += in;
            after += out;
        }
    }
    assert_true(before > 3 && after > 3);
}

struct watch {
    int calls;
    double last;
};

static bool count(void *user, double fraction)
{
    struct watch *watch = user;
    assert_true(fraction >= watch->last && fraction <= 1);
    watch->last = fraction;
    return ++watch->calls < 3;
}

/* Shared out among threads, a list gives what each of its rays gives alone; and it stops when told to. */
static void many(void **state)
{
    (void)state;
    enum { N = 40000 };
    const struct kd_rays_params p = params_of(0.7, 82);
    double *rays = malloc(2 * N * sizeof *rays);
    struct kd_ray_crossing *c = malloc(N * ORDERS * sizeof *c), one[ORDERS];
    struct kd_ray_end *ends = malloc(N * sizeof *ends), end;
    assert_true(rays && c && ends);
    for (int i = 0; i < N; i++) {
        rays[2 * i] = i * 37 % 1001 / 50.0 - 10;
        rays[2 * i + 1] = i * 61 % 997 / 50.0 - 10;
    }
    assert_int_equal(kd_rays_trace(NULL, &p, rays, N, c, ends, NULL, NULL, NULL), KD_OK);
    for (int i = 0; i < N; i += 97) {
        memset(one, 0, sizeof one);
        trace_one(&p, rays[2 * i], rays[2 * i + 1], one, &end);
        assert_int_equal(end.n_crossings, ends[i].n_crossings);
        for (uint32_t n = 0; n < ORDERS; n++)
            assert_memory_equal(&c[i * ORDERS + (int)n].r, &one[n].r, sizeof one[n].r);
    }
    struct watch watch = { 0 };
    struct kd_error error;
    assert_int_equal(kd_rays_trace(NULL, &p, rays, N, c, ends, count, &watch, &error), KD_ECANCELLED);
    assert_int_equal(watch.calls, 3);
    free(rays);
    free(c);
    free(ends);
}

static void refused(void **state)
{
    (void)state;
    const struct kd_rays_params good = params_of(0.5, 60);
    const double fine[4] = { 1, 2, 3, 4 }, nan[4] = { 1, 2, 3, NAN }, far[4] = { 1, 2, 3e7, 4 },
                 out[4] = { 1, 2, 90, 0 };
    struct {
        struct kd_rays_params p;
        const double *rays;
        size_t n;
        const char *pointer;
    } table[] = {
        { good, fine, 0, "/rays" },
        { good, fine, KD_RAYS_MAX + 1, "/rays" },
        { good, nan, 2, "/rays/1/1" },
        { good, far, 2, "/rays/1/0" },
        { good, out, 2, "/rays/1" },
        { good, fine, 2, "/spin" },
        { good, fine, 2, "/spin" },
        { good, fine, 2, "/observer/r" },
        { good, fine, 2, "/observer/r" },
        { good, fine, 2, "/observer/r" },
        { good, fine, 2, "/observer/inclination_deg" },
        { good, fine, 2, "/orders" },
        { good, fine, 2, "/orders" },
        { good, fine, 2, "/accuracy/precision" },
        { good, fine, 2, "/accuracy/steps" },
        { good, fine, 2, "/accuracy/engine" },
        { good, fine, 2, "/accuracy" },
    };
    table[4].p.r = 10;
    table[5].p.spin = NAN, table[6].p.spin = -1;
    table[7].p.r = 1.8, table[8].p.r = -INFINITY, table[9].p.r = NAN;
    table[10].p.inclination_deg = NAN;
    table[11].p.orders = 0, table[12].p.orders = 17;
    table[13].p.precision = KD_PRECISION_F32, table[14].p.steps = 4;
    table[15].p.engine = KD_ENGINE_MINO_RKN6; /* without a renderer */
    table[16].p.engine = KD_ENGINE_COUNT;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        struct kd_ray_crossing c[2 * ORDERS];
        struct kd_ray_end ends[2];
        struct kd_error error = { 0 };
        assert_int_equal(kd_rays_trace(NULL, &table[i].p, table[i].rays, table[i].n, c, ends, NULL, NULL, &error),
                         KD_EINVAL);
        assert_string_equal(error.pointer, table[i].pointer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_the_oracle),
        cmocka_unit_test(redshift),
        cmocka_unit_test(redshift_knows_the_turning_point),
        cmocka_unit_test(many),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
