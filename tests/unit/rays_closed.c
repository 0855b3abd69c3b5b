/* Tests of kd_rays_trace with the closed-form engine, compared with geodesics in Kerr-Schild coordinates; and tests of
 * its threads, cancellation and errors. */
#include "physics/disk/thin_disk.h"
#include "physics/spacetime/kerr.h"
#include "render/rays/rays.h"

#include "kerr_schild.h"
#include "kerr_schild_frame.h"

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

/* The reference starts at 1e6 M with a series, which has an error of about 1e-9. This error grows by a factor of up to
 * 23 with each order. */
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

/* g is continuous across the ISCO, and no number is missing. */
static void redshift(void **state)
{
    (void)state;
    const struct kd_rays_params p = params_of(0.3, 50);
    double isco = kd_kerr_isco(kd_hole(p.spin)), last = NAN, last_r = NAN, step = 0;
    bool inside = false, outside = false;
    for (double beta = 2; beta < 7; beta += 0.001) {
        struct kd_ray_crossing c[ORDERS];
        struct kd_ray_end end;
        trace_one(&p, -4, beta, c, &end);
        if (!end.n_crossings)
            continue;
        assert_true(c[0].g > 0 && c[0].g < 3);
        if (c[0].r >= isco)
            assert_true(fabs(c[0].g / kd_disk_redshift(kd_hole(p.spin), c[0].r, 4 * sin(50 * M_PI / 180)) - 1) < 1e-14);
        if ((last_r - isco) * (c[0].r - isco) < 0)
            step = fabs(c[0].g - last);
        inside |= c[0].r < isco;
        outside |= c[0].r > isco;
        last = c[0].g, last_r = c[0].r;
    }
    assert_true(inside && outside && step > 0 && step < 2e-3);
}

/* Radii fall until the turning point and rise after it. If the next crossing is nearer the hole, the ray is still on
 * its way in, that is, the photon leaves outwards. If the crossing before was nearer, the ray is on its way out. Rays
 * close to the critical curve cross the plane on both parts of the path; at a = 0 they do so always inside the ISCO. */
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
            double want = kd_disk_redshift_plunging(kd_hole(0), c[n].r, 0, b * b, in);
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

/* Threads that share a list of rays give the same results as each ray alone. They stop when the list is cancelled. */
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

/* Boyer-Lindquist azimuth minus ingoing Kerr-Schild azimuth: the integral of a/Delta from r to infinity. */
static double twist(double a, double r)
{
    double root = sqrt(1 - a * a);
    return a / (2 * root) * log1p(2 * root / (r - 1 - root));
}

/* The path that a moving observer sees in the direction [yaw, pitch], by frames in Kerr-Schild coordinates: the
 * frame of zero angular momentum, or that of rain for an infalling observer, boosted to its velocity. Only the
 * observer's constants of motion are taken from the code under test. */
static struct ks_path seen_by(const struct kd_rays_params *p, const double *look, double constants[4])
{
    const double theta = p->inclination_deg * M_PI / 180, yaw = look[0] * M_PI / 180, pitch = look[1] * M_PI / 180;
    const struct ks_place at = { p->spin, p->r, theta };
    const struct kd_vantage here = { kd_hole_of(p->spin), p->r, cos(theta), sin(theta) };
    const struct kd_observer_motion motion = { (enum kd_observer)(p->observer - 1),
                                               { p->velocity[0], p->velocity[1], p->velocity[2] },
                                               p->fall_from,
                                               p->fall_energy,
                                               p->fall_momentum };
    const struct kd_covector u = kd_observer_tetrad(&motion, &here).t;
    const struct ks_frame from = motion.observer == KD_OBSERVER_INFALL ? ks_rain(&at) : ks_zamo(&at);
    double velocity[4], photon[4];
    ks_inwards(&at, 1, u.energy, u.momentum * here.s, u.polar, velocity);
    const struct ks_frame frame = ks_boost(&at, &from, velocity);
    ks_seen(&frame, (const double[3]) { -cos(pitch) * cos(yaw), -sin(pitch), cos(pitch) * sin(yaw) }, photon);
    ks_constants(&at, photon, constants);
    return ks_follow(&at, photon, ORDERS);
}

/* Every kind of observer, in all directions. The reference starts from a velocity that contains the square root of the
 * radial potential. For an observer at constant radius the potential is 0, and its root has an error of 1e-8, which
 * grows by a factor of up to 23 with each order. */
static void observers_that_move(void **state)
{
    static const double looks[][2] = { { 3, 2 },  { -21, 13 }, { 40, -33 },  { -75, 5 },
                                       { 90, 4 }, { 178, -3 }, { -130, 60 }, { 11, -80 } };
    static const struct {
        double spin, r, inclination_deg;
        struct kd_observer_motion motion;
    } cases[] = {
        { 0.9, 7, 60, { .observer = KD_OBSERVER_STATIC } },
        { -0.7, 30, 100, { .observer = KD_OBSERVER_STATIC } },
        { 0.998, 1.5, 80, { .observer = KD_OBSERVER_ZAMO } }, /* in the ergosphere some rays have energies below 0 */
        { 0.5, 12, 30, { .observer = KD_OBSERVER_ZAMO } },
        { 0.9, 8, 85, { .observer = KD_OBSERVER_KEPLERIAN } },
        { 0.9, 9, 70, { .observer = KD_OBSERVER_RETROGRADE } },
        { 0.9, 4, 60, { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = INFINITY } },
        { 0.6,
          6,
          75,
          { .observer = KD_OBSERVER_INFALL, .fall_from = 20, .fall_energy = INFINITY, .fall_momentum = 1 } },
        { 0.9, 5, 60, { .observer = KD_OBSERVER_VELOCITY, .velocity = { -0.3, -0.2, 0.5 } } },
        { 0.3, 20, 130, { .observer = KD_OBSERVER_VELOCITY, .velocity = { -0.01, 0, 0.95 } } },
    };
    int crossings = 0, reversed = 0;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases * sizeof looks / sizeof *looks; i++) {
        const double *look = looks[i % (sizeof looks / sizeof *looks)];
        const size_t k = i / (sizeof looks / sizeof *looks);
        const struct kd_observer_motion *m = &cases[k].motion;
        struct kd_rays_params p = params_of(cases[k].spin, cases[k].inclination_deg);
        struct kd_ray_crossing c[ORDERS];
        struct kd_ray_end end;
        double constants[4];
        p.r = cases[k].r, p.observer = 1 + (int)m->observer, p.fall_from = m->fall_from;
        p.fall_energy = m->fall_energy, p.fall_momentum = m->fall_momentum;
        memcpy(p.velocity, m->velocity, sizeof p.velocity);
        trace_one(&p, look[0], look[1], c, &end);
        const struct ks_path path = seen_by(&p, look, constants);
        reversed += end.energy < 0;
        assert_true(fabs(end.energy - constants[0]) < 1e-6);
        if (path.fate == KS_UNDECIDED)
            continue;
        assert_int_equal(end.fate, path.fate == KS_CAPTURED ? KD_RAY_CAPTURED : KD_RAY_ESCAPED);
        assert_int_equal(end.n_crossings, path.crossings);
        for (int n = 0; n < path.crossings; n++) {
            const double bound = 1e-6 * pow(23, n);
            if (!(fabs(c[n].r / path.r[n] - 1) < bound) ||
                !same_azimuth(c[n].phi, path.phi[n] - twist(p.spin, p.r), bound))
                fail_msg("case %zu, look %g, %g, order %d: %.12g %.12g, not %.12g %.12g", k, look[0], look[1], n,
                         c[n].r, c[n].phi, path.r[n], path.phi[n] - twist(p.spin, p.r));
            if (c[n].r > kd_kerr_isco(kd_hole(p.spin)) * 1.001)
                assert_true(fabs(c[n].g * constants[0] /
                                     kd_disk_redshift(kd_hole(p.spin), c[n].r, constants[1] / constants[0]) -
                                 1) < 10 * bound);
            crossings++;
        }
        if (path.fate == KS_ESCAPED)
            assert_true(fabs(cos(end.theta) - path.u) < 1e-4 && /* the allowed error grows with the number of turns */
                        same_azimuth(end.phi, path.sky_phi - twist(p.spin, p.r), 1e-4));
    }
    assert_true(crossings > 40 && reversed > 0);
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
    table[15].p.engine = KD_ENGINE_MINO_RKN6; /* this engine needs a renderer, and there is none */
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
        cmocka_unit_test(observers_that_move),
        cmocka_unit_test(many),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
