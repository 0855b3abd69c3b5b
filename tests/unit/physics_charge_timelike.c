/* Tests of neutral bodies about charged holes, compared with the Hamiltonian in Kerr-Schild coordinates, with integrals
 * to 40 digits (tests/oracle/charge_reference.py), and with each other. */
#include "physics/orbit/orbit_lanes.h"
#include "physics/spacetime/kerr.h"

#include "charge_reference.h"
#include "kerr_schild.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static double random_unit(uint64_t *seed) /* splitmix64, so that the orbits are the same on every machine */
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* A random hole within a^2 + q^2 <= 1 - 1e-9; every eighth hole is at this limit. */
static struct kd_hole random_hole(uint64_t *seed, int i)
{
    const double size = i % 8 ? sqrt(random_unit(seed)) : 1 - 0.5e-9, turn = 2 * M_PI * random_unit(seed);
    return kd_hole_charged(size * cos(turn), size * sin(turn));
}

static struct kd_orbit random_orbit(uint64_t *seed, int i)
{
    const struct kd_hole hole = random_hole(seed, i);
    const double e = 0.9 * random_unit(seed), x = i % 5 ? 2 * random_unit(seed) - 1 : i % 2 ? 1 : 0;
    const double p = kd_orbit_separatrix(&hole, e, x) * (1.02 + 2 * random_unit(seed));
    struct kd_orbit orbit;
    struct kd_error error = { 0 };
    if (kd_orbit_from_shape(&hole, p, e, x, &orbit, &error))
        fail_msg("a = %.17g, q = %.17g, p = %.17g, e = %.17g, x = %.17g: %s", hole.a, hole.q, p, e, x, error.message);
    return orbit;
}

static void describe(const struct kd_orbit *o, const char *what, double got, double want, double allowed)
{
    fail_msg("a = %.17g, q = %.17g, E = %.17g, L = %.17g, Q = %.17g: %s %.17g, not %.17g: off by %.2g, allowed %.2g",
             o->hole.a, o->hole.q, o->energy, o->momentum, o->carter, what, got, want, fabs(got - want), allowed);
}

static void near(const struct kd_orbit *o, const char *what, double got, double want, double allowed)
{
    if (!(fabs(got - want) <= allowed))
        describe(o, what, got, want, allowed);
}

/* At both turning points in the equatorial plane, the norm of the momentum is that of a unit mass. */
static void norm_at_the_turning_points(void **state)
{
    (void)state;
    uint64_t seed = 21;
    for (int i = 0; i < 2000; i++) {
        const struct kd_orbit o = random_orbit(&seed, i);
        const long double a = o.hole.a, q = o.hole.q, e = o.energy, l = o.momentum;
        for (int end = 0; end < 2; end++) {
            const long double r = 1 / (long double)(end ? o.w_high : o.w_low), delta = r * r - 2 * r + a * a + q * q,
                              across = (r * r + a * a) * e - a * l, along = l - a * e;
            const long double norm = (-across * across / delta + along * along + (long double)o.carter) / (r * r);
            near(&o, "norm", (double)norm, -1, 1e-13 * (double)(across * across / delta / (r * r)));
        }
    }
}

/* dW/dE at fixed L and Q, by differences. */
static void radial_by_energy(void **state)
{
    (void)state;
    uint64_t seed = 22;
    for (int i = 0; i < 500; i++) {
        const struct kd_orbit o = random_orbit(&seed, i);
        const double w = o.w_low + random_unit(&seed) * (o.w_high - o.w_low), h = 1e-4;
        struct kd_orbit more = o, less = o;
        more.energy += h, less.energy -= h;
        more.binding = 1 - more.energy * more.energy, less.binding = 1 - less.energy * less.energy;
        kd_orbit_set_constants(&more);
        kd_orbit_set_constants(&less);
        const double slope = (kd_orbit_radial(&more, w) - kd_orbit_radial(&less, w)) / (2 * h);
        near(&o, "dW/dE", kd_orbit_radial_by_energy(&o, w), slope, 1e-10 * (1 + fabs(slope)));
    }
}

static void compare(const struct kd_orbit *o, const char *what, const struct kd_orbit_place *got,
                    const struct ks_body_place *want, double allowed)
{
    char text[80];
    snprintf(text, sizeof text, "r %s", what);
    near(o, text, got->r, want->r, allowed * want->r);
    snprintf(text, sizeof text, "u %s", what);
    near(o, text, cos(got->theta), want->u, allowed);
    snprintf(text, sizeof text, "t %s", what);
    near(o, text, got->t, want->t, allowed * want->t);
    snprintf(text, sizeof text, "phi %s", what);
    if (want->u * want->u < 0.999)
        near(o, text, remainder(got->phi - want->phi, 2 * M_PI), 0, allowed * (1 + fabs(got->phi)));
}

static struct kd_orbit_place followed(const struct kd_orbit *o, const struct kd_orbit_state *start,
                                      enum kd_orbit_method method, double mino, int steps)
{
    struct kd_orbit_path path;
    kd_orbit_path_init(&path, o, start, method);
    for (int k = 0; k < steps; k++)
        kd_orbit_path_step(&path, mino / steps);
    return kd_orbit_path_place(&path);
}

/* Bound orbits are followed for somewhat more than a radial period by the closed form and by both integrators. If the
 * orbit is closer to the separatrix than to 0, the errors of all three are magnified, including those of the rounded
 * constants from which the oracle starts. */
static void bound_orbits(void **state)
{
    (void)state;
    uint64_t seed = 23;
    for (int i = 0; i < 500; i++) {
        const struct kd_orbit o = random_orbit(&seed, i);
        const struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
        const struct kd_orbit_bound bound = kd_orbit_bound_of(&o, &start);
        const double mino = 1.3 * 2 * M_PI / kd_orbit_frequencies_of(&bound).mino_r;
        const struct kd_orbit_place closed = kd_orbit_bound_at(&bound, mino);
        const struct ks_body body = { o.hole.a, o.hole.q, 1 / o.w_high, 0, o.energy, o.momentum, 0, -sqrt(o.carter) };
        const struct ks_body_place want = ks_body_after(&body, closed.proper);
        const struct kd_orbit_place yoshida = followed(&o, &start, KD_ORBIT_YOSHIDA6, mino, 1200),
                                    nystroem = followed(&o, &start, KD_ORBIT_RKN6, mino, 1200);
        compare(&o, "in closed form", &closed, &want, 4e-9);
        compare(&o, "by Yoshida", &yoshida, &want, 4e-9);
        compare(&o, "by Nystroem", &nystroem, &want, 4e-9);
        near(&o, "proper time", yoshida.proper, closed.proper, 1e-11 * closed.proper);
    }
}

/* Bodies that fall in or escape. A body starts at a point, with a velocity measured by an observer there. */
static void free_motion(void **state)
{
    (void)state;
    uint64_t seed = 25;
    int fallen = 0, escaped = 0;
    for (int i = 0; i < 500; i++) {
        const struct kd_hole hole = random_hole(&seed, i);
        const double r = 4 + 8 * random_unit(&seed), theta_deg = 20 + 140 * random_unit(&seed);
        const double v[3] = { 1.1 * random_unit(&seed) - 0.55, 1.1 * random_unit(&seed) - 0.55,
                              1.1 * random_unit(&seed) - 0.55 };
        struct kd_orbit o;
        struct kd_orbit_state start;
        struct kd_error error = { 0 };
        if (kd_orbit_from_state(&hole, r, theta_deg, KD_OBSERVER_ZAMO, v, &o, &start, &error))
            fail_msg("a = %.17g, q = %.17g, r = %.17g: %s", hole.a, hole.q, r, error.message);
        if (o.fate == KD_ORBIT_BOUND || kd_orbit_whirl(&o, &start, NULL) > 1e3)
            continue;
        struct kd_orbit_path path;
        kd_orbit_path_init(&path, &o, &start, KD_ORBIT_RKN6);
        const double h = 2e-3 / sqrt(o.total + 1);
        for (int k = 0;
             k < 20000 && 1 / path.place[KD_PATH_W].value < 40 && 1 / path.place[KD_PATH_W].value > hole.outer * 1.05;
             k++)
            kd_orbit_path_step(&path, h);
        const struct kd_orbit_place got = kd_orbit_path_place(&path);
        const double delta = kd_hole_delta(&hole, r), sine = sin(theta_deg * (M_PI / 180));
        const struct ks_body body = {
            hole.a, hole.q, r, start.u, o.energy, o.momentum, -start.w_rate * r * r / delta, -start.u_rate / sine
        };
        const struct ks_body_place want = ks_body_after(&body, got.proper);
        compare(&o, "by Nystroem", &got, &want, 4e-9);
        fallen += got.r < 2;
        escaped += got.r > 30;
    }
    print_message("%d falls and %d flights\n", fallen, escaped);
    assert_true(fallen > 100 && escaped > 20);
}

static void precession_without_spin(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_advance_reference); i++) {
        const struct charge_advance_reference *want = &charge_advance_reference[i];
        struct kd_orbit o;
        struct kd_error error = { 0 };
        const struct kd_hole hole = kd_hole_charged(0, want->q);
        if (kd_orbit_from_shape(&hole, want->p, want->e, 0.6, &o, &error))
            fail_msg("row %zu: %s", i, error.message);
        const struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
        const struct kd_orbit_bound bound = kd_orbit_bound_of(&o, &start);
        near(&o, "advance", kd_orbit_periastron_advance(&bound), want->advance, 2e-14 * want->advance * (1 + want->p));
    }
}

/* The innermost stable orbit in tilted planes about a hole without spin, found as the separatrix of general orbits. */
static void separatrix_without_spin(void **state)
{
    (void)state;
    int seen = 0;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++) {
        const struct charge_place_reference *want = &charge_place_reference[i];
        const struct kd_hole hole = kd_hole_charged(want->a, want->q);
        assert_true(fabs(kd_orbit_separatrix(&hole, 0, 1) / want->isco - 1) < 1e-13);
        if (want->a != 0)
            continue;
        seen++;
        struct kd_orbit o;
        struct kd_error error = { 0 };
        assert_true(fabs(kd_orbit_separatrix(&hole, 0, 0.3) / want->isco - 1) < 1e-9);
        assert_true(fabs(kd_orbit_least_circle(&hole, 0.3) / want->photon - 1) < 1e-9);
        assert_int_equal(kd_orbit_from_shape(&hole, want->isco * 0.999, 0.01, 0.3, &o, &error), KD_EINVAL);
        assert_string_equal(error.pointer, "/p");
    }
    assert_true(seen >= 3);
}

static void lanes_are_scalar_paths(void **state)
{
    (void)state;
    uint64_t seed = 27;
    struct kd_orbit_path scalar[KD_ORBIT_LANES], wide[KD_ORBIT_LANES];
    struct kd_orbit_drift worst[KD_ORBIT_LANES] = { { 0 } }, single[KD_ORBIT_LANES] = { { 0 } };
    struct kd_orbit_lanes lanes = { .h = { 0 } };
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        const struct kd_orbit o = random_orbit(&seed, i + 1);
        const struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
        kd_orbit_path_init(&scalar[i], &o, &start, KD_ORBIT_YOSHIDA6);
        wide[i] = scalar[i];
        lanes.path[i] = &wide[i], lanes.steps[i] = 400, lanes.h[i] = 0.01 / sqrt(o.total), lanes.worst[i] = &worst[i];
        for (int k = 0; k < 400; k++) {
            kd_orbit_path_step(&scalar[i], lanes.h[i]);
            single[i].energy = fmax(single[i].energy, fabs(kd_orbit_path_drift(&scalar[i]).energy));
        }
    }
    kd_orbit_lanes_run(&lanes);
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        const struct kd_orbit_place a = kd_orbit_path_place(&scalar[i]), b = kd_orbit_path_place(&wide[i]);
        assert_memory_equal(&a, &b, sizeof a);
        assert_true(worst[i].energy == single[i].energy);
    }
}

/* With the smallest charge the results are the same to the bit. With the largest, no number is undefined. */
static void extremes(void **state)
{
    (void)state;
    uint64_t seed = 29;
    for (int i = 0; i < 300; i++) {
        const double turn = 2 * M_PI * random_unit(&seed), size = sqrt(1 - 1e-12), e = 0.95 * random_unit(&seed),
                     x = 2 * random_unit(&seed) - 1;
        const struct kd_hole hole = kd_hole_charged(size * cos(turn), i % 2 ? size * sin(turn) : 1e-300);
        const double p = kd_orbit_separatrix(&hole, e, x) * (1 + pow(10, -6 * random_unit(&seed)));
        struct kd_orbit o, same;
        struct kd_error error = { 0 };
        assert_int_equal(kd_orbit_from_shape(&hole, p, e, x, &o, &error), KD_OK);
        const struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
        const struct kd_orbit_bound bound = kd_orbit_bound_of(&o, &start);
        const struct kd_orbit_place at = kd_orbit_bound_at(&bound, 1.7 * bound.quarter_r / bound.unit_r);
        if (!(at.r > hole.outer && isfinite(at.t) && isfinite(at.phi) && isfinite(at.proper) && isfinite(at.theta)))
            fail_msg("a = %.17g, q = %.17g, p = %.17g, e = %.17g, x = %.17g: r %g, t %g", hole.a, hole.q, p, e, x, at.r,
                     at.t);
        if (i % 2)
            continue;
        assert_int_equal(kd_orbit_from_shape(kd_hole(hole.a), p, e, x, &same, &error), KD_OK);
        const struct kd_orbit_state begin = kd_orbit_start(&same, NAN, true);
        const struct kd_orbit_bound other = kd_orbit_bound_of(&same, &begin);
        const struct kd_orbit_place there = kd_orbit_bound_at(&other, 1.7 * bound.quarter_r / bound.unit_r);
        assert_memory_equal(&at, &there, sizeof at);
    }
}

static void too_much_charge(void **state)
{
    (void)state;
    struct kd_orbit o;
    struct kd_error error;
    const struct kd_hole hole = kd_hole_charged(0.8, 0.7);
    assert_int_equal(kd_orbit_from_shape(&hole, 10, 0.1, 1, &o, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/charge");
    assert_non_null(strstr(error.message, "charge is 0.7 M; with spin 0.8 its magnitude must be below 0.6 M"));
}

/* Radial parts of the rates of phi and t in Mino time where the horizons are close, sqrt(1 - a^2 - q^2) from 5e-7 to
 * 1.4e-3. The reference is a quadrature of the metric's rates in 40 digits between the roots of the radial potential,
 * for the same constants of motion as in the library. */
static void rates_about_close_horizons(void **state)
{
    static const struct {
        double a, q, p, e, x, phi, t;
    } known[] = {
        { 0.9, 0.43588989435371955, 6, 0.3, 0.8, 0.32732540718754065, 53.684249561512082 },
        { 0.9999999999995, 0, 8, 0.5, 0.5, 0.29129828210758094, 112.37339787345746 },
        { 0, 0.9999999999995, 9, 0.2, 1, 0, 102.19272645849319 },
        { 0.999999, 0, 4, 0.4, 0.9, 0.5894295094823465, 30.390445664737223 },
    };
    (void)state;
    for (size_t i = 0; i < COUNT(known); i++) {
        const struct kd_hole hole = kd_hole_charged(known[i].a, known[i].q);
        struct kd_orbit o;
        struct kd_error error;
        assert_int_equal(kd_orbit_from_shape(&hole, known[i].p, known[i].e, known[i].x, &o, &error), KD_OK);
        const struct kd_orbit_state start = kd_orbit_start(&o, NAN, false);
        const struct kd_orbit_bound b = kd_orbit_bound_of(&o, &start);
        const double half = b.quarter_r / b.unit_r;
        assert_true(fabs(b.half_r.phi / half - known[i].phi) <= 2e-14 * known[i].phi);
        assert_true(fabs(b.half_r.t / half - known[i].t) <= 2e-14 * known[i].t);
    }
}

/* Phi along the orbit in the plane: the integral of a (2E r - aL - q^2 E)/Delta + L over Mino time, by Simpson's rule.
 * */
static void way_about_close_horizons(void **state)
{
    enum { STEPS = 400 };
    const struct kd_hole hole = kd_hole_charged(0.9, 0.43588989435371955);
    struct kd_orbit o;
    struct kd_error error;
    (void)state;
    assert_int_equal(kd_orbit_from_shape(&hole, 5, 0.3, 1, &o, &error), KD_OK);
    const struct kd_orbit_state start = kd_orbit_start(&o, NAN, false);
    const struct kd_orbit_bound b = kd_orbit_bound_of(&o, &start);
    for (int part = 1; part <= 5; part++) {
        const double mino = 0.37 * part * b.quarter_r / b.unit_r, step = mino / STEPS;
        double sum = 0;
        for (int k = 0; k <= STEPS; k++) {
            const double r = kd_orbit_bound_at(&b, k * step).r, delta = (r - 1 - hole.root) * (r - 1 + hole.root),
                         rate = hole.a * (2 * o.energy * r - hole.a * o.momentum - hole.q * hole.q * o.energy) / delta;
            sum += (k == 0 || k == STEPS ? 1 : k % 2 ? 4 : 2) * (rate + o.momentum);
        }
        const double phi = sum * step / 3;
        assert_true(fabs(kd_orbit_bound_at(&b, mino).phi - phi) < 1e-11 * fabs(phi));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_about_close_horizons),
        cmocka_unit_test(way_about_close_horizons),
        cmocka_unit_test(norm_at_the_turning_points),
        cmocka_unit_test(radial_by_energy),
        cmocka_unit_test(bound_orbits),
        cmocka_unit_test(free_motion),
        cmocka_unit_test(precession_without_spin),
        cmocka_unit_test(separatrix_without_spin),
        cmocka_unit_test(lanes_are_scalar_paths),
        cmocka_unit_test(extremes),
        cmocka_unit_test(too_much_charge),
    };
    return cmocka_run_group_tests_name("bodies about charged holes", tests, NULL, NULL);
}
