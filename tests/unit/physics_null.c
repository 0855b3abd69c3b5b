/* Tests of null geodesics in closed form, compared with Taylor series of 20 digits (tests/oracle/null_reference.py):
 * every case of roots, start and degeneracy, and rays 1e-10 from the critical curve. */
#include "physics/null/null_geodesic.h"

#include "null_reference.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static struct kd_null_ray ray_of(const struct null_reference *e)
{
    return (struct kd_null_ray) { .hole = kd_hole_of(e->spin),
                                  .radius = e->radius,
                                  .cos_theta = e->cos_theta,
                                  .alpha = e->alpha,
                                  .beta = e->beta,
                                  .outward = e->outward,
                                  .orders = 4 };
}

/* Rays that meet the axis may pass it on either side, so that their number of turns is undefined. For other rays the
 * number is compared. */
static double azimuth_off(const struct kd_null_ray *ray, double got, double want)
{
    return ray->alpha == 0 ? fabs(remainder(got - want, 2 * M_PI)) : fabs(got - want);
}

static void within(size_t row, int n, const char *what, double off, double bound)
{
    if (!(off <= bound))
        fail_msg("row %zu, crossing %d: %s off by %.3g, estimated %.3g", row, n, what, off, bound);
}

static void crossings(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(null_reference); i++) {
        const struct null_reference *e = &null_reference[i];
        struct kd_null_ray ray = ray_of(e);
        struct kd_null_path p = kd_null_trace(&ray);
        if (p.crossings != e->crossings || p.fate != (e->captured ? KD_NULL_CAPTURED : KD_NULL_ESCAPED))
            fail_msg("row %zu: %d crossings, not %d; fate %d", i, p.crossings, e->crossings, p.fate);
        for (int n = 0; n < p.crossings; n++) {
            const struct kd_null_crossing *x = &p.crossing[n];
            const struct null_reference_crossing *y = &e->crossing[n];
            within(i, n, "r", fabs(x->r / y->r - 1), x->error_r);
            within(i, n, "phi", azimuth_off(&ray, x->phi, y->phi), x->error_phi);
            within(i, n, "delay", fabs(x->delay - y->delay), x->error_delay);
            assert_int_equal(x->sense, y->sense);
        }
        assert_int_equal(isnan(p.sky_u), e->captured);
        if (!e->captured) {
            within(i, -1, "sky u", fabs(p.sky_u - e->sky_u), p.sky_error);
            within(i, -1, "sky phi", azimuth_off(&ray, p.sky_phi, e->sky_phi), p.sky_error);
        }
    }
}

/* The error estimates must not be so large that they allow any error. Errors of direct images are a few roundings.
 * Those of the next order are up to a hundred times larger, because half a turn near the photon sphere multiplies them
 * by up to e^pi. The estimates grow in proportion. */
static void accuracy(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(null_reference); i++) {
        const struct null_reference *e = &null_reference[i];
        struct kd_null_ray ray = ray_of(e);
        struct kd_null_path p = kd_null_trace(&ray);
        for (int n = 0; n < p.crossings && n < 2; n++) {
            const struct kd_null_crossing *x = &p.crossing[n];
            double wide = n == 0 ? 1 : 100;
            within(i, n, "r, wanted", fabs(x->r / e->crossing[n].r - 1), 1e-14 * wide);
            within(i, n, "phi, wanted", azimuth_off(&ray, x->phi, e->crossing[n].phi), 3e-14 * wide);
            within(i, n, "delay, wanted", fabs(x->delay - e->crossing[n].delay),
                   3e-14 * wide * (10 + fabs(e->crossing[n].delay) + x->r));
            within(i, n, "estimate of r", x->error_r, 2e-13 * wide);
        }
    }
}

static void fast_is_the_same(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(null_reference); i++) {
        struct kd_null_ray ray = ray_of(&null_reference[i]);
        struct kd_null_path p = kd_null_trace(&ray), q = kd_null_trace_fast(&ray), s = kd_null_trace_radii(&ray);
        assert_int_equal(p.crossings, q.crossings);
        assert_true(s.crossings == q.crossings && s.status == q.status && s.fate == q.fate && s.turned == q.turned &&
                    isnan(s.sky_u) && isnan(s.sky_phi));
        for (int n = 0; n < p.crossings; n++) {
            const struct kd_null_crossing *whole = &p.crossing[n], *fast = &q.crossing[n], *radius = &s.crossing[n];
            assert_true(whole->r == fast->r && whole->phi == fast->phi && fast->error_r == 0);
            assert_true(radius->r == fast->r && radius->sense == fast->sense && isnan(radius->phi) &&
                        isnan(radius->delay) && radius->error_r == 0);
        }
    }
}

/* Symmetries that must hold exactly: mirroring at the equator, and turning the hole upside down. */
static void mirrors(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(null_reference); i++) {
        struct kd_null_ray ray = ray_of(&null_reference[i]), flipped = ray, turned = ray;
        flipped.cos_theta = -ray.cos_theta, flipped.beta = -ray.beta;
        turned.hole = kd_hole_of(-ray.hole.a), turned.alpha = -ray.alpha;
        struct kd_null_path p = kd_null_trace(&ray), f = kd_null_trace(&flipped), t = kd_null_trace(&turned);
        assert_true(p.crossings == f.crossings && p.crossings == t.crossings && p.fate == f.fate && p.fate == t.fate);
        for (int n = 0; n < p.crossings; n++) {
            const struct kd_null_crossing *x = &p.crossing[n];
            assert_true(x->r == f.crossing[n].r && x->phi == f.crossing[n].phi && x->delay == f.crossing[n].delay);
            assert_true(x->r == t.crossing[n].r && x->delay == t.crossing[n].delay);
            within(i, n, "phi turned over", azimuth_off(&ray, -x->phi, t.crossing[n].phi), 0);
        }
        if (p.fate == KD_NULL_ESCAPED)
            assert_true(p.sky_u == -f.sky_u || (ray.cos_theta == 0 && ray.beta == 0));
    }
}

/* The answers do not jump at a = 0, on the axis, at beta = 0 or in the equatorial plane: they differ by the slope times
 * the change of the input. A change of 1e-13 is far below any tolerance and equals some 500 roundings; slopes here are
 * below 100. */
static void continuity(void **state)
{
    (void)state;
    static const double inclined[] = { 1, 0.9563, 0.342, 0, -0.7071, -1 };
    for (size_t i = 0; i < COUNT(inclined); i++)
        for (int k = 0; k < 24; k++) {
            double angle = k * M_PI / 12 + 0.1, alpha = 7 * cos(angle), beta = 7 * sin(angle), tiny = 1e-13;
            struct kd_null_ray still = { .hole = kd_hole_of(0),
                                         .radius = INFINITY,
                                         .cos_theta = inclined[i],
                                         .alpha = alpha,
                                         .beta = beta,
                                         .orders = 2 };
            struct kd_null_ray near[] = { still, still, still };
            near[0].hole = kd_hole_of(tiny), near[1].hole = kd_hole_of(-tiny);
            near[2].cos_theta = i == 0 ? 1 - 1e-15 : i == 5 ? -1 + 1e-15 : inclined[i];
            struct kd_null_path p = kd_null_trace(&still);
            for (size_t j = 0; j < COUNT(near); j++) {
                struct kd_null_path q = kd_null_trace(&near[j]);
                assert_int_equal(p.crossings, q.crossings);
                for (int n = 0; n < p.crossings; n++) {
                    double allowed = j < 2 ? 1e-11 : 1e-6; /* next to the axis the inclination changes by sqrt(2e-15) */
                    within(k, n, "r nearby", fabs(q.crossing[n].r / p.crossing[n].r - 1), allowed);
                    within(k, n, "phi nearby", fabs(q.crossing[n].phi - p.crossing[n].phi), allowed);
                    within(k, n, "delay nearby", fabs(q.crossing[n].delay - p.crossing[n].delay), allowed * 100);
                }
            }
        }
    /* Through beta = 0, where the start is a turning point. */
    struct kd_null_ray turn = { .hole = kd_hole_of(0.9),
                                .radius = INFINITY,
                                .cos_theta = 0.5,
                                .alpha = 8,
                                .orders = 1 },
                       up = turn, down = turn;
    up.beta = 1e-13, down.beta = -1e-13;
    double r = kd_null_trace(&turn).crossing[0].r;
    within(0, 0, "r above beta = 0", fabs(kd_null_trace(&up).crossing[0].r / r - 1), 1e-12);
    within(0, 0, "r below beta = 0", fabs(kd_null_trace(&down).crossing[0].r / r - 1), 1e-12);
}

/* Across the axis: alpha -> 0 from the two sides gives two azimuths that differ by 2 pi. At alpha = 0 the azimuth is
 * exactly one of these two. */
static void the_axis(void **state)
{
    (void)state;
    struct kd_null_ray ray = {
        .hole = kd_hole_of(0.9), .radius = INFINITY, .cos_theta = 0.5, .beta = 6.5, .orders = 1
    };
    double on = kd_null_trace(&ray).crossing[0].phi;
    ray.alpha = 1e-9;
    double right = kd_null_trace(&ray).crossing[0].phi;
    ray.alpha = -1e-9;
    double left = kd_null_trace(&ray).crossing[0].phi;
    within(0, 0, "turn about the axis", fabs(right - left - 2 * M_PI), 1e-8);
    within(0, 0, "phi on the axis", fmin(fabs(on - left), fabs(on - right)), 1e-8);
}

/* A ray that leaves and comes back to the observer's radius is split in two: delays and azimuths of the outward start
 * continue those of the inward one. A crossing seen from far away has the azimuth and delay seen from nearby, plus
 * those of the path between the two observers. */
static void observers_along_a_ray(void **state)
{
    (void)state;
    struct kd_null_ray far = {
        .hole = kd_hole_of(0.9), .radius = INFINITY, .cos_theta = 0, .alpha = -7, .beta = 3, .orders = 2
    };
    struct kd_null_path p = kd_null_trace(&far);
    far.radius = 1e7;
    struct kd_null_path q = kd_null_trace(&far);
    assert_true(p.crossings == q.crossings && p.crossings > 0);
    /* the part of the path beyond 1e7, which is left out, has the length b^2/2r */
    for (int n = 0; n < p.crossings; n++) {
        within(0, n, "r from 1e7", fabs(p.crossing[n].r / q.crossing[n].r - 1), 2e-5);
        within(0, n, "delay from 1e7", fabs(q.crossing[n].delay - 1e7 - 2 * log(1e7) - p.crossing[n].delay), 1e-4);
    }
}

static void degenerate_input(void **state)
{
    (void)state;
    const struct kd_null_ray good = {
        .hole = kd_hole_of(0.9), .radius = 10, .cos_theta = 0.5, .alpha = 3, .beta = 3, .orders = 2
    };
    assert_int_equal(kd_null_trace(&good).status, KD_NULL_OK);
    struct kd_null_ray bad[9];
    for (size_t i = 0; i < COUNT(bad); i++)
        bad[i] = good;
    bad[0].hole = kd_hole_of(1), bad[1].hole = kd_hole_of(NAN), bad[2].radius = 1.4, bad[3].radius = NAN,
    bad[4].cos_theta = 1.0000001;
    bad[5].alpha = INFINITY, bad[6].beta = NAN, bad[7].orders = KD_NULL_ORDERS + 1, bad[8].orders = -1;
    for (size_t i = 0; i < COUNT(bad); i++) {
        struct kd_null_path p = kd_null_trace(&bad[i]);
        assert_int_equal(p.status, KD_NULL_BAD_INPUT);
        assert_true(p.crossings == 0 && isnan(p.sky_u));
    }
    struct kd_null_ray beyond = good; /* light with b = 50 does not come within 10 M */
    beyond.alpha = 50;
    assert_int_equal(kd_null_trace(&beyond).status, KD_NULL_NO_RAY);
    struct kd_null_ray plane = { .hole = kd_hole_of(0.9), .radius = INFINITY, .cos_theta = 0, .alpha = 7, .orders = 3 };
    assert_int_equal(kd_null_trace(&plane).status, KD_NULL_IN_PLANE);
    assert_int_equal(kd_null_trace(&plane).crossings, 0);
}

/* The principal null congruence and rays with impact parameter 0: no division by zero. */
static void principal_rays(void **state)
{
    (void)state;
    struct kd_null_ray centre = { .hole = kd_hole_of(0), .radius = 10, .cos_theta = 0.5, .orders = 3, .outward = true };
    struct kd_null_path p = kd_null_trace(&centre);
    assert_true(p.fate == KD_NULL_ESCAPED && p.crossings == 0 && p.sky_u == 0.5 && fabs(p.sky_phi) == 0);
    centre.outward = false;
    assert_int_equal(kd_null_trace(&centre).fate, KD_NULL_CAPTURED);
    /* lambda = a sin^2, eta = -(a cos^2)^2: theta is constant and dphi/dr = a/Delta outwards; the azimuth is subtracted
     * because the ray is followed backwards */
    double a = 0.9, s = sqrt(0.75), plus = 1 + sqrt(1 - a * a), minus = 1 - sqrt(1 - a * a);
    struct kd_null_ray principal = {
        .hole = kd_hole_of(a), .radius = 10, .cos_theta = 0.5, .alpha = -a * s, .orders = 3, .outward = true
    };
    p = kd_null_trace(&principal);
    double turn = a / (plus - minus) * log((10 - minus) / (10 - plus));
    assert_true(p.fate == KD_NULL_ESCAPED && p.crossings == 0);
    within(0, 0, "u of a principal ray", fabs(p.sky_u - 0.5),
           1e-7); /* tolerance: at a double root of U, the rounding of alpha becomes its square root */
    within(0, 0, "phi of a principal ray", fabs(p.sky_phi + turn), 1e-7);
    struct kd_null_ray axis = { .hole = kd_hole_of(a), .radius = 10, .cos_theta = 1, .orders = 3, .outward = true };
    p = kd_null_trace(&axis);
    assert_true(p.fate == KD_NULL_ESCAPED && p.sky_u == 1);
    struct kd_null_ray equatorial = {
        .hole = kd_hole_of(a), .radius = 10, .cos_theta = 0, .alpha = -a, .orders = 3, .outward = true
    };
    p = kd_null_trace(&equatorial);
    assert_true(p.fate == KD_NULL_ESCAPED && p.sky_u == 0);
    within(0, 0, "phi in the plane", fabs(p.sky_phi + turn), 1e-14);
}

/* Rays near the critical curve have all 32 orders. Each half turn takes the same time until the error has grown to the
 * distance from the photon sphere. All numbers are finite, and the error estimates grow. */
static void many_orders(void **state)
{
    (void)state;
    double b = sqrt(27) * (1 + 1e-14);
    struct kd_null_ray ray = { .hole = kd_hole_of(0),
                               .radius = INFINITY,
                               .cos_theta = 0.5,
                               .alpha = b * 0.6,
                               .beta = b * 0.8,
                               .orders = KD_NULL_ORDERS };
    struct kd_null_path p = kd_null_trace(&ray);
    assert_in_range(p.crossings, 8, 20);
    for (int n = 1; n < p.crossings; n++) {
        assert_true(p.crossing[n].r > 2 && p.crossing[n].delay > p.crossing[n - 1].delay);
        within(0, n, "half a turn", fabs(fabs(p.crossing[n].phi - p.crossing[n - 1].phi) - M_PI), 1e-12);
        assert_true(isnan(p.crossing[n].error_r) == 0 && p.crossing[n].error_r > 0);
    }
    /* light at the photon sphere needs a time of sqrt(27) per radian, so half a turn takes pi sqrt(27) */
    for (int n = 2; n < 5; n++)
        within(0, n, "delay of half a turn", fabs(p.crossing[n].delay - p.crossing[n - 1].delay - M_PI * sqrt(27)),
               0.1);
    assert_true(p.crossing[4].error_r > 100 * p.crossing[2].error_r);
}

/* The scale at which the direction (x, y) of the image plane meets the critical curve, to the last bit. */
static double critical_scale(struct kd_null_ray ray, double x, double y)
{
    double low = 1, high = 20;
    for (int i = 0; i < 80; i++) {
        double middle = 0.5 * (low + high);
        ray.alpha = middle * x, ray.beta = middle * y;
        *(kd_null_trace_fast(&ray).fate == KD_NULL_CAPTURED ? &low : &high) = middle;
    }
    return high;
}

/* Rays a few roundings apart agree to within their error estimates, even if they stay at the photon sphere for a long
 * time or reach the horizon. At the horizon a rounding of r changes phi and t by thousands of roundings. */
static void neighbours(void **state)
{
    (void)state;
    static const double spins[] = { 0, 0.5, 0.9, -0.9, 0.998 }, off[] = { 1e-3, 1e-6, 1e-10, -1e-3, -1e-6, -1e-10 };
    for (size_t i = 0; i < COUNT(spins) * COUNT(off) * 6; i++) {
        struct kd_null_ray ray = {
            .hole = kd_hole_of(spins[i % COUNT(spins)]), .radius = INFINITY, .cos_theta = 0.6, .orders = 4
        };
        double angle = 1 + (double)(i / COUNT(spins) / COUNT(off)), x = cos(angle), y = sin(angle);
        double b = critical_scale(ray, x, y) * (1 + off[i / COUNT(spins) % COUNT(off)]);
        ray.alpha = b * x, ray.beta = b * y;
        struct kd_null_path p = kd_null_trace(&ray);
        for (int k = 1; k <= 8; k++) {
            struct kd_null_ray beside = ray;
            beside.alpha *= 1 + k * DBL_EPSILON, beside.beta *= 1 + k * DBL_EPSILON;
            struct kd_null_path q = kd_null_trace_fast(&beside);
            assert_int_equal(p.crossings, q.crossings);
            for (int n = 0; n < p.crossings; n++) {
                const struct kd_null_crossing *c = &p.crossing[n], *d = &q.crossing[n];
                within(i, n, "r beside", fabs(d->r / c->r - 1), 2 * c->error_r);
                within(i, n, "phi beside", fabs(d->phi - c->phi), 2 * c->error_phi);
                within(i, n, "delay beside", fabs(d->delay - c->delay), 2 * c->error_delay);
            }
        }
    }
}

/* A ray that is on the critical curve to the last bits is still traced, and is marked as having an uncertain fate. */
static void exactly_critical(void **state)
{
    (void)state;
    int uncertain = 0;
    for (int k = -50; k <= 50; k++) {
        struct kd_null_ray ray = { .hole = kd_hole_of(0),
                                   .radius = INFINITY,
                                   .cos_theta = 0.6,
                                   .alpha = sqrt(27) * (1 + k * DBL_EPSILON),
                                   .orders = 3 };
        struct kd_null_path p = kd_null_trace(&ray);
        uncertain += p.status == KD_NULL_CRITICAL;
        assert_int_equal(p.crossings, 3);
        for (int n = 1; n < 3; n++)
            within(k + 50, n, "r at the photon sphere", fabs(p.crossing[n].r - 3), n == 1 ? 0.05 : 0.003);
    }
    assert_in_range(uncertain, 10, 60); /* the uncertain rays lie within some 16 roundings to either side */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossings),
        cmocka_unit_test(accuracy),
        cmocka_unit_test(fast_is_the_same),
        cmocka_unit_test(mirrors),
        cmocka_unit_test(continuity),
        cmocka_unit_test(the_axis),
        cmocka_unit_test(observers_along_a_ray),
        cmocka_unit_test(degenerate_input),
        cmocka_unit_test(principal_rays),
        cmocka_unit_test(neighbours),
        cmocka_unit_test(exactly_critical),
        cmocka_unit_test(many_orders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
