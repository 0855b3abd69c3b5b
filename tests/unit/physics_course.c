/* Tests of the course of a ray, point by point. It is compared with the Hamiltonian integrated in Kerr-Schild
 * coordinates, a method without a formula in common. Points between crossings are checked by rays that start there. */
#include "physics/null/null_course.h"

#include "kerr_schild.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { ORDERS = 4, MOST = 4000 };

static double random_unit(uint64_t *seed) /* splitmix64 */
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static const double spins[] = { 0, 1e-6, 0.3, -0.5, 0.9, -0.9, 0.99, 0.998 };
static const double cosines[] = { 1, 0.9563, 0.7071, 0.342, 0.01, 0, -0.5, -0.9, -1 };

static struct kd_null_ray random_ray(uint64_t *seed, double field)
{
    struct kd_null_ray ray = { .hole = kd_hole_of(0), .radius = INFINITY, .orders = ORDERS };
    ray.hole = kd_hole_of(spins[(int)(8 * random_unit(seed))]);
    ray.cos_theta = cosines[(int)(9 * random_unit(seed))];
    ray.alpha = random_unit(seed) < 0.05 ? 0 : field * (2 * random_unit(seed) - 1);
    ray.beta = field * (2 * random_unit(seed) - 1);
    return ray;
}

static void say(const struct kd_null_ray *ray, const char *what, int n, double got, double want, double allowed)
{
    fail_msg("a = %.17g, r = %.17g%s, cos = %.17g, alpha = %.17g, beta = %.17g: %s %d: %.17g, not %.17g: off by %.2g, "
             "allowed %.2g",
             ray->hole.a, ray->radius, ray->outward ? " outwards" : "", ray->cos_theta, ray->alpha, ray->beta, what, n,
             got, want, fabs(got - want), allowed);
}

static double horizon(double a) { return 1 + sqrt((1 - a) * (1 + a)); }

/* The maximum distance of neighbours: 0.03 rad on the sphere, or the steps of w that straight rays take. */
static void check_neighbours(const struct kd_null_ray *ray, const struct kd_null_place *p,
                             const struct kd_null_place *q)
{
    const double s = sqrt((1 - p->u) * (1 + p->u)), t = sqrt((1 - q->u) * (1 + q->u));
    if (s < 0.05 || t < 0.05 || fabs(ray->hole.a) > 0.01) /* skipped, because frame dragging changes the azimuths too */
        return;
    const double apart = acos(fmin(1, p->u * q->u + s * t * cos(p->phi - q->phi)));
    if (apart > 0.035)
        say(ray, "angle between neighbours at order", p->order, apart, 0.03, 0.005);
}

/* The path's crossings must be those of the reference integration. Along the way the errors of both methods grow to
 * about ten DBL_EPSILON times the condition number, which is part of the closed form's error estimates. */
static void judge(const struct kd_null_ray *ray, const struct ks_photon *photon)
{
    static struct kd_null_place places[MOST];
    const double near = 0.01 * horizon(ray->hole.a), far = isinf(ray->radius) ? 50 : fmax(50, 2 * ray->radius);
    const struct kd_null_course course = kd_null_course_of(ray, far, near, places, MOST);
    const struct ks_path oracle = ks_trace(*photon, ORDERS);
    const struct kd_null_path closed = kd_null_trace(ray);
    int met = 0;
    if (course.end != KD_COURSE_CAPTURED && course.end != KD_COURSE_ESCAPED)
        say(ray, "end", 0, course.end, KD_COURSE_ESCAPED, 0);
    if (oracle.fate != KS_UNDECIDED && (course.end == KD_COURSE_ESCAPED) != (oracle.fate == KS_ESCAPED))
        say(ray, "fate", 0, course.end, oracle.fate, 0);
    if (!(course.drift < 1e-9))
        say(ray, "drift of the first integrals", 0, course.drift, 0, 1e-9);
    for (size_t i = 0; i < course.n; i++) {
        const struct kd_null_place *p = &places[i];
        const int n = p->crossing;
        if (i)
            check_neighbours(ray, &places[i - 1], p);
        if (n < 0 || n >= oracle.crossings || n >= closed.crossings)
            continue;
        const double factor = 2e-10 / DBL_EPSILON, r = factor * closed.crossing[n].error_r,
                     phi = factor * closed.crossing[n].error_phi, delay = factor * closed.crossing[n].error_delay;
        met++;
        if (!(fabs(p->u) < 1e-9))
            say(ray, "cosine of crossing", n, p->u, 0, 1e-9);
        if (!(fabs(p->r / oracle.r[n] - 1) <= r))
            say(ray, "r of crossing", n, p->r, oracle.r[n], r * p->r);
        if (!(fabs(remainder(p->phi - oracle.phi[n], 2 * M_PI)) <= phi))
            say(ray, "phi of crossing", n, p->phi, oracle.phi[n], phi);
        if (!(fabs(p->delay - oracle.delay[n]) <= delay))
            say(ray, "delay of crossing", n, p->delay, oracle.delay[n], delay);
        if (!(fabs(p->phi - closed.crossing[n].phi) <= phi)) /* azimuths include whole turns */
            say(ray, "turns of crossing", n, p->phi, closed.crossing[n].phi, phi);
    }
    int there = 0; /* crossings beyond the ends of the path, at larger or smaller radii, are not part of it */
    for (int n = 0; n < oracle.crossings; n++)
        there += oracle.r[n] < 0.999 * far && oracle.r[n] > 1.001 * (horizon(ray->hole.a) + near);
    if (met < there)
        say(ray, "crossings", 0, met, there, 0);
}

static void from_infinity(void **state)
{
    uint64_t seed = 1;
    (void)state;
    for (int i = 0; i < 1500; i++) {
        const struct kd_null_ray ray = random_ray(&seed, i % 3 == 0 ? 25 : 8);
        const struct ks_photon photon = ks_from_infinity(ray.hole.a, ray.cos_theta, ray.alpha, ray.beta);
        judge(&ray, &photon);
    }
}

/* The photon of `ray` at the ray's radius. Returns false if there is none, or if the reference integration would start
 * inaccurately there. */
static bool photon_of(const struct kd_null_ray *ray, struct ks_photon *photon)
{
    const double a = ray->hole.a, u = ray->cos_theta, r = ray->radius, lambda = -ray->alpha * sqrt((1 - u) * (1 + u));
    const double eta = (ray->alpha * ray->alpha - a * a) * u * u + ray->beta * ray->beta;
    const double delta = r * r - 2 * r + a * a, w = r * r + a * a - a * lambda,
                 big = w * w - delta * (eta + (lambda - a) * (lambda - a));
    if (!(big > 1e-3 * w * w))
        return false;
    *photon = (struct ks_photon) { .a = a,
                                   .r = r,
                                   .u = u,
                                   .energy = 1,
                                   .momentum = lambda,
                                   .p_r = (ray->outward ? -1 : 1) * sqrt(big) / delta,
                                   .p_theta = ray->beta };
    return true;
}

static void from_nearby(void **state)
{
    uint64_t seed = 2;
    int compared = 0;
    (void)state;
    for (int i = 0; i < 2500; i++) {
        struct kd_null_ray ray = random_ray(&seed, 9);
        struct ks_photon photon;
        ray.radius = horizon(ray.hole.a) * (1.25 + exp(6 * random_unit(&seed) - 3));
        ray.outward = random_unit(&seed) < 0.5;
        if (fabs(ray.cos_theta) == 1)
            ray.cos_theta *= 0.99;
        if (!photon_of(&ray, &photon))
            continue;
        judge(&ray, &photon);
        compared++;
    }
    assert_true(compared > 1000);
}

/* Every point of a path lies on the ray: a ray in closed form that starts at the point, with the same constants, has
 * the same remaining crossings. Their azimuths and delays are those of the first ray minus the part already covered. */
static void between_crossings(void **state)
{
    static struct kd_null_place places[MOST];
    uint64_t seed = 3;
    int judged = 0;
    (void)state;
    for (int i = 0; i < 150; i++) {
        struct kd_null_ray ray = random_ray(&seed, 9);
        const struct kd_null_course course = kd_null_course_of(&ray, 50, 0.01 * horizon(ray.hole.a), places, MOST);
        const struct kd_null_path whole = kd_null_trace(&ray);
        const double s = sqrt((1 - ray.cos_theta) * (1 + ray.cos_theta)), lambda = -ray.alpha * s;
        const double eta =
            (ray.alpha * ray.alpha - ray.hole.a * ray.hole.a) * ray.cos_theta * ray.cos_theta + ray.beta * ray.beta;
        for (size_t k = 20; k + 1 < course.n; k += 17) {
            const struct kd_null_place *p = &places[k];
            const double sin2 = (1 - p->u) * (1 + p->u), alpha = -lambda / sqrt(sin2);
            const double beta2 = eta - (alpha * alpha - ray.hole.a * ray.hole.a) * p->u * p->u;
            const bool outward = places[k + 1].r > p->r;
            if (p->crossing >= 0 || p->order >= whole.crossings || !(sin2 > 1e-2 && beta2 > 1e-2) ||
                fabs(places[k + 1].r / p->r - 1) < 1e-3 || fabs(p->u) < 1e-2)
                continue;
            const struct kd_null_ray rest = { .hole = ray.hole,
                                              .radius = p->r,
                                              .cos_theta = p->u,
                                              .sin_theta = sqrt(sin2),
                                              .alpha = alpha,
                                              .beta = copysign(sqrt(beta2), places[k + 1].u - p->u),
                                              .outward = outward,
                                              .orders = ORDERS };
            const struct kd_null_path there = kd_null_trace_fast(&rest);
            const struct kd_null_crossing *want = &whole.crossing[p->order], *got = &there.crossing[0];
            if (there.crossings < 1 || want->r > 1e3)
                continue;
            const double allowed = 1e-7 + 1e6 * fmin(fmax(want->error_r, fmax(want->error_phi, want->error_delay)), 1);
            if (!(fabs(got->r / want->r - 1) <= allowed))
                say(&ray, "r of the crossing from place", (int)k, got->r, want->r, allowed);
            if (!(fabs(remainder(p->phi + got->phi - want->phi, 2 * M_PI)) <= 10 * allowed))
                say(&ray, "phi of the crossing from place", (int)k, p->phi + got->phi, want->phi, 10 * allowed);
            if (!(fabs(p->delay + got->delay - want->delay) <= 10 * allowed * (1 + want->r)))
                say(&ray, "delay of the crossing from place", (int)k, p->delay + got->delay, want->delay,
                    10 * allowed * (1 + want->r));
            judged++;
        }
    }
    assert_true(judged > 300);
}

/* Errors are returned if no such ray exists, or if its course has more places than the array. */
static void without_a_course(void **state)
{
    struct kd_null_place places[10];
    (void)state;
    const struct kd_null_ray forbidden = {
        .hole = kd_hole_of(0.5), .radius = 5, .cos_theta = 0.2, .alpha = 40, .beta = 1, .orders = 1
    };
    assert_int_equal(kd_null_course_of(&forbidden, 50, 0.01, places, 10).end, KD_COURSE_NONE);
    static const double no_number[] = { INFINITY, -INFINITY, NAN, 1e200 };
    for (int i = 0; i < 16; i++) {
        const struct kd_null_ray none = { .hole = kd_hole_of(0.5),
                                          .radius = i & 8 ? 1.9 : INFINITY,
                                          .cos_theta = 0.2,
                                          .sin_theta = sqrt(0.96),
                                          .alpha = i & 4 ? 1 : no_number[i & 3],
                                          .beta = i & 4 ? no_number[i & 3] : 1,
                                          .orders = 1 };
        assert_int_equal(kd_null_course_of(&none, 50, 0.01, places, 10).end, KD_COURSE_NONE);
    }
    const struct kd_null_ray ray = {
        .hole = kd_hole_of(0.5), .radius = INFINITY, .cos_theta = 0.2, .alpha = 6, .beta = 1, .orders = 1
    };
    const struct kd_null_course course = kd_null_course_of(&ray, 50, 0.01, places, 10);
    assert_int_equal(course.end, KD_COURSE_LONG);
    assert_int_equal(course.n, 10);
}

/* Position of the n-th crossing, or NULL if the course has fewer crossings. */
static const struct kd_null_place *crossing_of(const struct kd_null_course *course, const struct kd_null_place *places,
                                               int n)
{
    for (size_t i = 0; i < course->n; i++)
        if (places[i].crossing == n)
            return &places[i];
    return NULL;
}

/* Light that reaches an infalling observer inside the horizon, with energy at infinity above and below 0. Crossings,
 * fate and direction are compared with the reference integration, whose coordinates are regular at the horizon. */
static void from_within(void **state)
{
    static struct kd_null_place places[MOST], others[MOST];
    uint64_t seed = 5;
    int met = 0, escaped = 0, captured = 0, below = 0;
    (void)state;
    for (int i = 0; i < 600; i++) {
        const double a = spins[(int)(8 * random_unit(&seed))], root = sqrt((1 - a) * (1 + a)),
                     up = 2 * random_unit(&seed) - 1, round = 2 * M_PI * random_unit(&seed);
        const struct ks_place at = { a, 1 + root * (2 * (0.1 + 0.9 * random_unit(&seed)) - 1),
                                     acos(0.95 * (2 * random_unit(&seed) - 1)) };
        const double k[3] = { up, sqrt((1 - up) * (1 + up)) * cos(round), sqrt((1 - up) * (1 + up)) * sin(round) };
        const struct ks_frame rain = ks_rain(&at);
        double p[4], c[4];
        ks_seen(&rain, k, p);
        ks_constants(&at, p, c);
        if (fabs(c[0]) < 0.02)
            continue;
        const struct kd_null_ray ray = { .hole = kd_hole_of(a),
                                         .radius = at.r,
                                         .cos_theta = cos(at.theta),
                                         .sin_theta = sin(at.theta),
                                         .alpha = -c[1] / sin(at.theta) / c[0],
                                         .beta = c[2] / fabs(c[0]),
                                         .outward = true,
                                         .orders = ORDERS };
        const struct ks_path oracle = ks_follow(&at, p, ORDERS);
        const struct kd_null_course course =
            kd_null_course_ingoing(&ray, c[0] < 0, INFINITY, 1e-3 * horizon(a), places, MOST);
        struct kd_null_ray moved = ray; /* a ray shifted by 1e-8, which shows how much errors are amplified */
        moved.alpha *= 1 + 1e-8, moved.beta *= 1 + 1e-8;
        const struct kd_null_course beside =
            kd_null_course_ingoing(&moved, c[0] < 0, INFINITY, 1e-3 * horizon(a), others, MOST);
        const double sign = c[0] < 0 ? -1 : 1;
        if (course.end != KD_COURSE_CAPTURED && course.end != KD_COURSE_ESCAPED)
            say(&ray, "end", 0, course.end, KD_COURSE_ESCAPED, 0);
        if (!(course.drift < 1e-7))
            say(&ray, "drift of the first integrals", 0, course.drift, 0, 1e-7);
        if (oracle.fate != KS_UNDECIDED && (course.end == KD_COURSE_ESCAPED) != (oracle.fate == KS_ESCAPED))
            say(&ray, "fate", 0, course.end, oracle.fate, 0);
        for (size_t n = 0; n < course.n; n++) {
            const struct kd_null_place *q = &places[n];
            if (q->crossing < 0 || q->crossing >= oracle.crossings)
                continue;
            const struct kd_null_place *other = crossing_of(&beside, others, q->crossing);
            if (!other)
                continue;
            const double r = oracle.r[q->crossing],
                         allowed = 1e-8 + fabs(other->r / q->r - 1) + fabs(other->phi - q->phi);
            if (!(fabs(q->r / r - 1) <= allowed))
                say(&ray, "r of crossing", q->crossing, q->r, r, allowed * r);
            /* Boyer-Lindquist azimuth grows without bound next to the horizon, and does not exist inside it */
            if (r < 1.02 * horizon(a))
                continue;
            const double twist = root > 0 ? a / (2 * root) * log1p(2 * root / (r - 1 - root)) : 0,
                         phi = sign * q->phi + twist;
            if (!(fabs(remainder(phi - oracle.phi[q->crossing], 2 * M_PI)) <= 10 * allowed))
                say(&ray, "phi of crossing", q->crossing, phi, oracle.phi[q->crossing], 10 * allowed);
            met++;
        }
        below += c[0] < 0;
        captured += course.end == KD_COURSE_CAPTURED;
        if (course.end == KD_COURSE_ESCAPED) {
            const struct kd_null_place *last = &places[course.n - 1];
            if (!(fabs(last->u - oracle.u) < 1e-5) ||
                !(fabs(remainder(sign * last->phi - oracle.sky_phi, 2 * M_PI)) * sqrt(1 - oracle.u * oracle.u) < 1e-5))
                say(&ray, "direction", 0, sign * last->phi, oracle.sky_phi, 1e-5);
            escaped++;
        }
    }
    print_message("from within: %d crossings, %d escaped, %d captured, %d of negative energy\n", met, escaped, captured,
                  below);
    assert_true(met > 150 && escaped > 100 && captured > 50 && below > 20);
}

/* Outside the horizon the ingoing azimuth and time follow from those of the closed form and the integrals of a/Delta
 * and 2r/Delta. */
static void ingoing_time(void **state)
{
    static struct kd_null_place places[MOST];
    uint64_t seed = 6;
    int judged = 0;
    (void)state;
    for (int i = 0; i < 900; i++) {
        struct kd_null_ray ray = random_ray(&seed, 6);
        const double a = ray.hole.a, root = sqrt((1 - a) * (1 + a)), inner = a * a / (1 + root);
        ray.radius = 1.05 * horizon(a) + 20 * random_unit(&seed);
        ray.outward = i & 1;
        const struct kd_null_path closed = kd_null_trace(&ray);
        const struct kd_null_course course = kd_null_course_ingoing(&ray, false, 200, 0.01 * horizon(a), places, MOST);
        for (size_t n = 0; n < course.n && (closed.status == KD_NULL_OK || closed.status == KD_NULL_IN_PLANE); n++) {
            const struct kd_null_place *q = &places[n];
            if (q->crossing < 0 || q->crossing >= closed.crossings || q->r < 1.1 * horizon(a))
                continue;
            const struct kd_null_crossing *c = &closed.crossing[q->crossing];
            const double by = 1e-7 + 1e6 * fmin(fmax(c->error_r, fmax(c->error_phi, c->error_delay)), 1),
                         r_o = ray.radius, r_c = c->r;
            const double twist =
                0.5 * a / root * (log((r_c - inner) / (r_c - 1 - root)) - log((r_o - inner) / (r_o - 1 - root)));
            const double time =
                ((1 + root) * log((r_o - 1 - root) / (r_c - 1 - root)) - inner * log((r_o - inner) / (r_c - inner))) /
                root;
            if (!(fabs(q->phi + twist - c->phi) <= 10 * by))
                say(&ray, "phi of crossing", q->crossing, q->phi + twist, c->phi, 10 * by);
            if (!(fabs(q->delay - time - c->delay) <= 10 * by * (1 + c->r)))
                say(&ray, "delay of crossing", q->crossing, q->delay - time, c->delay, 10 * by * (1 + c->r));
            judged++;
        }
    }
    print_message("ingoing time: %d crossings\n", judged);
    assert_true(judged > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_infinity),    cmocka_unit_test(from_nearby), cmocka_unit_test(between_crossings),
        cmocka_unit_test(without_a_course), cmocka_unit_test(from_within), cmocka_unit_test(ingoing_time),
    };
    return cmocka_run_group_tests_name("physics_course", tests, NULL, NULL);
}
