/* Tests of light about charged holes. The closed form is compared with three references: an integration by steps,
 * Carter's first-order equations, and spherical photon orbits from R = R' = 0. */
#include "physics/null/null_bend.h"
#include "physics/null/null_course.h"
#include "physics/null/null_radial.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

enum { MOST = 20000, ORDERS = 3 };

static double random_unit(uint64_t *seed) /* splitmix64 */
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static bool escapes(const struct kd_null_ray *ray)
{
    const struct kd_null_path path = kd_null_trace(ray);
    assert_true(path.status == KD_NULL_OK || path.status == KD_NULL_CRITICAL);
    return path.fate == KD_NULL_ESCAPED;
}

/* Without spin the critical impact parameter is r^2/sqrt(r^2 - 2r + q^2) at r = (3 + sqrt(9 - 8 q^2))/2 (J. Eiroa,
 * G. Romero & D. Torres 2002, Phys. Rev. D 66, 024010); at q = 1 it is 4. */
static void critical_impact(void **state)
{
    (void)state;
    static const struct {
        double q, b;
    } known[] = { { 0, 5.19615242270663 }, { 0.5, 4.96791433 }, { 0.6, 4.85869419 }, { 1 - 1e-12, 4 } };
    for (size_t i = 0; i < COUNT(known); i++) {
        double low = 3, high = 8, q = known[i].q;
        while (high - low > 1e-14 * high) {
            const double b = 0.5 * (low + high);
            const struct kd_null_ray ray = {
                .hole = kd_hole_charged(0, q), .radius = INFINITY, .cos_theta = 0.5, .beta = b
            };
            *(escapes(&ray) ? &high : &low) = b;
        }
        const double r = (3 + sqrt(9 - 8 * q * q)) / 2, exact = r * r / sqrt(r * r - 2 * r + q * q);
        if (!(fabs(low - known[i].b) < 1e-8) || !(fabs(low / exact - 1) < 4e-14))
            fail_msg("q = %.17g: b = %.17g, wanted %.17g", q, low, exact);
    }
}

/* Labels of the spherical photon orbit at r, from R = R' = 0 with Delta' = 2(r - 1): r^2 + a^2 - a lambda = 4 r
 * Delta/Delta', K = 16 r^2 Delta/Delta'^2. */
static bool spherical(const struct kd_hole *hole, double r, double *lambda, double *eta)
{
    const long double a = hole->a, q = hole->q, delta = (long double)r * r - 2 * (long double)r + a * a + q * q,
                      slope = 2 * ((long double)r - 1), l = (r * (long double)r + a * a - 4 * r * delta / slope) / a;
    *lambda = (double)l;
    *eta = (double)(16 * r * (long double)r * delta / (slope * slope) - (l - a) * (l - a));
    return *eta > 0;
}

/* A ray inside the curve of these labels falls into the hole, and a ray outside it escapes. The rays are 1e-9 of the
 * curve's radius away from it. */
static void edge_of_the_shadow(void **state)
{
    (void)state;
    int seen = 0;
    for (int i = 1; i < 10; i++)
        for (int j = 0; j < 10; j++)
            for (int k = 0; k < 40; k++) {
                const double size = j == 9 ? 1 - 1e-12 : 0.1 * (j + 0.9), turn = i * (M_PI / 20);
                const struct kd_hole hole = kd_hole_charged(sqrt(size) * cos(turn), sqrt(size) * sin(turn));
                const double r = 1 + hole.root + 1e-3 + k * 0.1, u = 0.3, s = sqrt(1 - u * u);
                double lambda, eta;
                if (!spherical(&hole, r, &lambda, &eta))
                    continue;
                const double alpha = -lambda / s, beta2 = eta + (hole.a * hole.a - alpha * alpha) * u * u;
                if (!(beta2 > 1e-2))
                    continue;
                const double middle = 2 * hole.a * s;
                for (int side = -1; side <= 1; side += 2) {
                    const double by = 1 + 1e-9 * side;
                    const struct kd_null_ray ray = { .hole = hole,
                                                     .radius = INFINITY,
                                                     .cos_theta = u,
                                                     .alpha = middle + (alpha - middle) * by,
                                                     .beta = sqrt(beta2) * by };
                    if (escapes(&ray) != (side > 0))
                        fail_msg("a = %.17g, q = %.17g, orbit at %.17g, %s", hole.a, hole.q, r,
                                 side > 0 ? "outside" : "inside");
                }
                seen++;
            }
    assert_true(seen > 400);
}

/* Rates of azimuth and time by Carter's equations (1968), without the terms in lambda/sin^2 theta and in cos^2
 * theta. */
static void rates(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 1000; i++) {
        const double size = sqrt(random_unit(&seed)), turn = 0.5 * M_PI * random_unit(&seed);
        const struct kd_hole hole = kd_hole_charged(0.999 * size * cos(turn), 0.999 * size * sin(turn));
        const struct kd_null_motion m =
            kd_null_motion_of(&hole, 0.3, 0, 12 * random_unit(&seed) - 6, 12 * random_unit(&seed) - 6);
        const double r = hole.outer * (1.01 + 10 * random_unit(&seed));
        const struct kd_null_radial_sum got = kd_null_radial_rates(&m, r);
        const long double a = hole.a, q = hole.q, R = r, delta = R * R - 2 * R + a * a + q * q, w = R * R + a * a,
                          p = w - a * (long double)m.lambda;
        const long double phi = a * p / delta - a, t = w * p / delta + a * ((long double)m.lambda - a);
        const long double k = (long double)m.eta + ((long double)m.lambda - a) * ((long double)m.lambda - a);
        const double potential = (double)(p * p - delta * k), loss = 1e-14 / (double)(1 - hole.outer / R),
                     scale = pow(r, 4) + fabs(m.quadratic) * r * r + 2 * m.k * r + fabs(m.constant);
        assert_true(fabs(got.phi - (double)phi) <= loss * (double)(fabsl(a * p / delta) + 1));
        assert_true(fabs(got.t - (double)t) <= loss * (double)(fabsl(w * p / delta) + 10));
        assert_true(fabs(kd_null_radial_potential(&m, r) - potential) <= 1e-14 * scale);
    }
}

/* Compares crossings by the closed form with crossings by steps. */
static void crossings(void **state)
{
    (void)state;
    static struct kd_null_place places[MOST];
    uint64_t seed = 7;
    int met = 0;
    for (int i = 0; i < 500; i++) {
        const double size = i % 5 ? sqrt(random_unit(&seed)) : 1 - 1e-3, turn = 2 * M_PI * random_unit(&seed);
        const struct kd_null_ray ray = { .hole = kd_hole_charged(size * cos(turn), size * sin(turn)),
                                         .radius = i % 2 ? INFINITY : 20,
                                         .cos_theta = 1.8 * random_unit(&seed) - 0.9,
                                         .alpha = 16 * random_unit(&seed) - 8,
                                         .beta = 16 * random_unit(&seed) - 8,
                                         .orders = ORDERS };
        const struct kd_null_path closed = kd_null_trace(&ray);
        const struct kd_null_course course = kd_null_course_of(&ray, 50, 0.01 * ray.hole.outer, places, MOST);
        if (closed.status != KD_NULL_OK)
            continue;
        assert_true((closed.fate == KD_NULL_ESCAPED) == (course.end == KD_COURSE_ESCAPED) && course.drift < 1e-9);
        for (size_t k = 0; k < course.n; k++) {
            const struct kd_null_place *p = &places[k];
            if (p->crossing < 0 || p->crossing >= closed.crossings)
                continue;
            const struct kd_null_crossing *x = &closed.crossing[p->crossing];
            const double factor = 2e-10 / DBL_EPSILON;
            met++;
            if (!(fabs(p->r / x->r - 1) <= factor * x->error_r && fabs(p->phi - x->phi) <= factor * x->error_phi &&
                  fabs(p->delay - x->delay) <= factor * x->error_delay))
                fail_msg("a = %.17g, q = %.17g, (%.17g, %.17g) crossing %d: r %.15g, %.15g; phi %.15g, %.15g; delay "
                         "%.15g, %.15g",
                         ray.hole.a, ray.hole.q, ray.alpha, ray.beta, p->crossing, p->r, x->r, p->phi, x->phi, p->delay,
                         x->delay);
        }
    }
    assert_true(met > 400);
}

/* With the smallest charge the results are the same to the bit. With the largest charge and spin no number is
 * undefined. */
static void extremes(void **state)
{
    (void)state;
    uint64_t seed = 9;
    for (int i = 0; i < 2000; i++) {
        const double turn = 0.5 * M_PI * random_unit(&seed), size = sqrt(1 - 1e-12);
        struct kd_null_ray ray = { .hole = kd_hole_charged(size * cos(turn), i % 2 ? size * sin(turn) : 1e-300),
                                   .radius = INFINITY,
                                   .cos_theta = 1.8 * random_unit(&seed) - 0.9,
                                   .alpha = 16 * random_unit(&seed) - 8,
                                   .beta = 16 * random_unit(&seed) - 8,
                                   .orders = ORDERS };
        const struct kd_null_path path = kd_null_trace(&ray);
        for (int n = 0; n < path.crossings; n++)
            assert_true(path.crossing[n].r > ray.hole.outer && isfinite(path.crossing[n].phi) &&
                        isfinite(path.crossing[n].delay));
        if (i % 2)
            continue;
        ray.hole = kd_hole_of(ray.hole.a);
        const struct kd_null_path none = kd_null_trace(&ray);
        assert_true(none.crossings == path.crossings && none.fate == path.fate);
        for (int n = 0; n < path.crossings; n++)
            assert_true(none.crossing[n].r == path.crossing[n].r && none.crossing[n].phi == path.crossing[n].phi &&
                        none.crossing[n].delay == path.crossing[n].delay);
    }
}

/* The direction of escape by kd_null_bend agrees with that of the closed form. The two methods compute the azimuth as
 * sums of different terms. */
static void bends(void **state)
{
    (void)state;
    uint64_t seed = 11;
    int seen = 0;
    for (int i = 0; i < 1000; i++) {
        const double size = sqrt(random_unit(&seed)), turn = 0.5 * M_PI * random_unit(&seed);
        const struct kd_null_ray ray = { .hole = kd_hole_charged(size * cos(turn), size * sin(turn)),
                                         .radius = i % 2 ? INFINITY : 30,
                                         .cos_theta = 1.8 * random_unit(&seed) - 0.9,
                                         .alpha = 24 * random_unit(&seed) - 12,
                                         .beta = 24 * random_unit(&seed) - 12 };
        const struct kd_null_path path = kd_null_trace(&ray);
        struct kd_null_bend bend;
        double n[3];
        if (path.status != KD_NULL_OK || path.fate != KD_NULL_ESCAPED || path.sky_error > 1e-12 ||
            hypot(ray.alpha, ray.beta) < 7 || !kd_null_bend_of(&ray, &bend))
            continue;
        kd_null_bend_sky(&bend, ray.cos_theta, sqrt(1 - ray.cos_theta * ray.cos_theta), n);
        const double off = remainder(atan2(n[1], n[0]) - path.sky_phi, 2 * M_PI) * hypot(n[0], n[1]);
        if (!(fabs(n[2] - path.sky_u) < 1e-8 && fabs(off) < 1e-8))
            fail_msg("a = %.17g, q = %.17g, (%.17g, %.17g): off by %g, %g", ray.hole.a, ray.hole.q, ray.alpha, ray.beta,
                     n[2] - path.sky_u, off);
        seen++;
    }
    assert_true(seen > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(critical_impact), cmocka_unit_test(edge_of_the_shadow),
                                        cmocka_unit_test(rates),           cmocka_unit_test(crossings),
                                        cmocka_unit_test(extremes),        cmocka_unit_test(bends) };
    return cmocka_run_group_tests_name("light about charged holes", tests, NULL, NULL);
}
