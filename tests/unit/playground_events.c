/* Tests of events in the playground: inspiral, compared with Peters' closed form; mergers, exact to rounding; debris
 * that comes back; and hostile scenes. */
#include "playground_support.h"

#include "physics/waves/inspiral.h"
#include "playground/tide.h"
#include "playground/wave.h"

#include <stdio.h>

/* Two equal bodies far from the hole spiral together. The loss of energy is amplified A times and the distance is
 * A^(2/5) times as large, so that the ratio of attraction to loss is unchanged. The time from d0 to d1 is T(d0) -
 * T(d1), by P. C. Peters 1964, eq. 5.10, in physics/waves/inspiral.c. */
static void pairs_spiral_in_as_peters_says(void **state)
{
    (void)state;
    static const double amplifications[] = { 1, 1e3, 1e6 };
    for (int i = 0; i < 3; i++) {
        struct kd_playground_params params = playground_quiet();
        const double amplification = amplifications[i], d0 = 40 * pow(amplification, 0.4), d1 = 0.7 * d0,
                     v = 0.5 * sqrt(2 / d0);
        params.waves = true;
        params.amplification = amplification;
        params.h_max = 1e6;
        params.softening = 1e-3;
        struct kd_playground *p = playground_make(params);
        playground_put(p, (struct kd_playground_body) { .mass = 1, .x = { 9e5, d0 / 2, 0 }, .v = { v, 0, 0 } });
        playground_put(p, (struct kd_playground_body) { .mass = 1, .x = { 9e5, -d0 / 2, 0 }, .v = { -v, 0, 0 } });
        /* In units of m1 + m2 = 2: eta = 1/4. */
        const double expected =
            2 * (kd_inspiral_time(0.25, d0 / 2, 0) - kd_inspiral_time(0.25, d1 / 2, 0)) / amplification;
        double t = 0, d = d0;
        /* The semi-major axis follows from the energy, E = -m1 m2/(2 a). Unlike the distance, it does not oscillate. */
        while (d > d1 && t < 2 * expected) {
            playground_advance(p, expected / 2000);
            t = p->t;
            const struct kd_playground_body *b = p->bodies;
            const double w = kd_playground_radius(
                (double[3]) { b[0].v[0] - b[1].v[0], b[0].v[1] - b[1].v[1], b[0].v[2] - b[1].v[2] });
            const double gap = kd_playground_radius(
                (double[3]) { b[0].x[0] - b[1].x[0], b[0].x[1] - b[1].x[1], b[0].x[2] - b[1].x[2] });
            d = 1 / (2 / gap - w * w / 2);
        }
        print_message("amplification %g: %.6g M, Peters %.6g M, %.3f %%\n", amplification, t, expected,
                      100 * (t / expected - 1));
        assert_true(fabs(t / expected - 1) < 0.01);
        assert_false(p->held);
        kd_playground_destroy(p);
    }
}

/* A light body spirals towards the hole by Peters's formula, far out, where the hole's potential differs from Newton's
 * by 2/r^2. */
static void spiral_in(double mass, double amplification)
{
    struct kd_playground_params params = playground_quiet();
    const double r0 = 2000, r1 = 1800;
    params.waves = true;
    params.amplification = amplification;
    params.h_max = 1e6;
    struct kd_playground *p = playground_make(params);
    playground_put(
        p, (struct kd_playground_body) { .mass = mass, .x = { r0, 0, 0 }, .v = { 0, kd_playground_circular(r0), 0 } });
    const double m = 1 + mass, eta = mass / (m * m);
    const double expected = m * (kd_inspiral_time(eta, r0 / m, 0) - kd_inspiral_time(eta, r1 / m, 0)) / amplification;
    double r = r0;
    while (r > r1 && p->t < 2 * expected) {
        playground_advance(p, expected / 1000);
        const double e =
            kd_playground_totals(p).energy / mass; /* a circular orbit has the energy (4 - r)/(2 (r - 2)^2) per mass */
        const double x = (-0.5 - sqrt(0.25 + 4 * e)) / (2 * e); /* e = 1/x^2 - 1/(2 x), x = r - 2 */
        r = x + 2;
    }
    print_message("%.6g M, Peters %.6g M, %.3f %%\n", p->t, expected, 100 * (p->t / expected - 1));
    assert_true(fabs(p->t / expected - 1) < 0.01);
    kd_playground_destroy(p);
}

static void a_body_spirals_into_the_hole_as_peters_says(void **state)
{
    (void)state;
    spiral_in(0.01, 1e6);
    spiral_in(0.3, 3e4);
}

/* Near the hole the power is that of Peters, (32/5) m^2 (1 + m)/r^5 for a circle. The rate of the inspiral is Peters's
 * rate times (r - 2)^3/(r^2 (r - 6)). */
static void near_the_hole_it_is_his_power_and_another_pace(void **state)
{
    (void)state;
    struct kd_playground_params params = playground_quiet();
    const double m = 1e-4, r0 = 20, r1 = 12, amplification = 20, strength = amplification * m * (1 + m);
    params.waves = true;
    params.amplification = amplification;
    struct kd_playground *p = playground_make(params);
    playground_put(
        p, (struct kd_playground_body) { .mass = m, .x = { r0, 0, 0 }, .v = { 0, kd_playground_circular(r0), 0 } });
    playground_advance(p, 50);
    assert_true(fabs(p->spent.radiated / (p->t * 6.4 * m * strength / pow(r0, 5)) - 1) < 5e-3);
    double r = r0, expected = 0;
    for (double x = r0 - 0.005; x > r1; x -= 0.01) /* dt/dr by Peters's rate, 64/5 m (1 + m)/r^3, and the factor */
        expected += 0.01 * pow(x, 3) / (12.8 * strength) * x * x * (x - 6) / pow(x - 2, 3);
    while (r > r1 && p->t < 2 * expected) {
        playground_advance(p, expected / 1000);
        const double e = kd_playground_totals(p).energy / m;
        r = 2 + (-0.5 - sqrt(0.25 + 4 * e)) / (2 * e);
    }
    print_message("from 20 to 12 M %.6g M, expected %.6g M, %.3f %%\n", p->t, expected, 100 * (p->t / expected - 1));
    assert_true(fabs(p->t / expected - 1) < 5e-3);
    kd_playground_destroy(p);
}

/* The eccentricity of a pair follows Peters' e(a), eq. 5.11. */
static void an_eccentric_pair_grows_round_as_peters_says(void **state)
{
    (void)state;
    struct kd_playground_params params = playground_quiet();
    const double a0 = 4000, e0 = 0.6, r = a0 * (1 + e0), v = sqrt(2 * (1 - e0) / (a0 * (1 + e0)));
    params.waves = true;
    params.amplification = 1e4;
    params.h_max = 1e6;
    params.softening = 1e-3;
    struct kd_playground *p = playground_make(params);
    playground_put(p, (struct kd_playground_body) { .mass = 1, .x = { 9e5, r / 2, 0 }, .v = { v / 2, 0, 0 } });
    playground_put(p, (struct kd_playground_body) { .mass = 1, .x = { 9e5, -r / 2, 0 }, .v = { -v / 2, 0, 0 } });
    double a = a0, e = e0;
    for (int i = 0; i < 20000 && e > 0.45; i++) {
        playground_advance(p, 2e5);
        const struct kd_playground_body *b = p->bodies;
        const double x[3] = { b[0].x[0] - b[1].x[0], b[0].x[1] - b[1].x[1], 0 },
                     w[3] = { b[0].v[0] - b[1].v[0], b[0].v[1] - b[1].v[1], 0 };
        const double l = x[0] * w[1] - x[1] * w[0],
                     energy = 0.5 * (w[0] * w[0] + w[1] * w[1]) - 2 / kd_playground_radius(x);
        a = -1 / energy;
        e = sqrt(fmax(1 - l * l / (2 * a), 0));
    }
    const double expected = kd_inspiral_axis(a0, e0, e);
    print_message("e = %.4f at a = %.2f, Peters %.2f\n", e, a, expected);
    assert_true(e <= 0.45);
    assert_true(fabs(a / expected - 1) < 0.01);
    kd_playground_destroy(p);
}

static void mergers_keep_mass_and_momentum(void **state)
{
    (void)state;
    struct kd_playground_params params = kd_playground_defaults();
    params.tides = false;
    struct kd_playground *p = playground_make(params);
    playground_put(
        p, (struct kd_playground_body) { .mass = 3e-4, .radius = 0.5, .x = { 1e5, 5, 0.1 }, .v = { 0.01, -0.2, 0 } });
    playground_put(
        p, (struct kd_playground_body) { .mass = 1e-4, .radius = 0.3, .x = { 1e5, -5, 0 }, .v = { 0, 0.3, 0.01 } });
    /* The bodies are so fast that they touch only within a step, and not at the end of any step. */
    playground_put(
        p, (struct kd_playground_body) { .mass = 1e-5, .radius = 0.01, .x = { -1e5, -5, 0 }, .v = { 0, 0.99, 0 } });
    playground_put(
        p, (struct kd_playground_body) { .mass = 2e-5, .radius = 0.01, .x = { -1e5, 5, 0 }, .v = { 0, -0.99, 0 } });
    const struct kd_playground_totals before = kd_playground_totals(p);
    playground_advance(p, 40);
    const struct kd_playground_totals after = kd_playground_totals(p);
    assert_int_equal(p->n, 2);
    assert_true(fabs(after.mass / before.mass - 1) < 4e-16);
    /* The hole attracts the bodies with 1e-10 per M. The change of momentum that this causes is subtracted. */
    for (int k = 0; k < 3; k++) {
        const double pulled = k ? 0 : -p->t * 1e-10 * (4e-4 - 3e-5);
        assert_true(fabs(after.momentum[k] - before.momentum[k] - pulled) < 2e-15);
    }
    assert_true(fabs(pow(p->bodies[0].radius, 3) - 0.125 - 0.027) < 1e-15);
    assert_int_equal(kd_playground_event_at(&p->events, 1)->kind, KD_PLAYGROUND_MERGER);
    /* The energy balances: what is lost is heat, half of mu v^2, and the pair's own potential. The error of the step is
     * a thousandth of it. */
    assert_true(fabs(after.energy + p->spent.merged - before.energy) < 1e-3 * p->spent.merged);
    kd_playground_destroy(p);
}

/* The logarithmic slope of the rate at which debris comes back, by least squares over the decade of time that begins at
 * twice the return time of the first piece. The returns are counted without Kepler's law. Half of the debris is
 * bound. */
static void debris_comes_back_as_the_fifth_third_power(void **state)
{
    (void)state;
    struct kd_playground *p =
        playground_read("{\"preset\":\"disruption\",\"debris_per_body\":12000,\"h_max\":50,\"budget\":100000000}");
    playground_advance(p, 3000);
    assert_int_equal(p->n, 0);
    const struct kd_debris_source *source = kd_debris_source_of(&p->debris, 1);
    assert_int_equal(source->pieces, 12000);
    assert_true(fabs(p->spent.torn_mass / 1e-6 - 1) < 1e-12);
    p->params.h_max = 1e4;
    playground_advance(p, 1.5e7);
    /* dM/deps is flat, so the first piece returns at t_min = 2 pi (2 deps)^(-3/2) */
    const double first = 2 * M_PI * pow(2 * source->spread, -1.5);
    double sw = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, line = 0;
    uint32_t early = 0;
    for (int i = 0; i < KD_DEBRIS_BINS; i++) {
        const struct kd_debris_rate rate = kd_debris_rate(source, i);
        early += rate.t + rate.width / 2 < 0.9 * first ? rate.pieces : 0;
        if (rate.t < 2 * first || rate.t > 20 * first || !rate.pieces)
            continue;
        const double x = log(rate.t), y = log(rate.rate), w = rate.pieces;
        sw += w, sx += w * x, sy += w * y, sxx += w * x * x, sxy += w * x * y;
        line += w * log(rate.rate / rate.line);
    }
    const double slope = (sw * sxy - sx * sy) / (sw * sxx - sx * sx);
    print_message("slope %.4f, %.0f pieces, over the line by %.2f %%, back %u, early %u\n", slope, sw,
                  100 * (exp(line / sw) - 1), source->all_back, early);
    assert_true(fabs(slope + 5. / 3) < 0.05);
    assert_true(fabs(line / sw) < 0.05);
    assert_true(source->all_back > 4800 && source->all_back < 6040);
    assert_int_equal(early, 0);
    kd_playground_destroy(p);
}

/* J. Guillochon & E. Ramirez-Ruiz 2013, figure 10: at depth 0.7 a fifth to a quarter of the mass is lost. The fit gives
 * the fraction that a star loses at the depth d of its periastron. */
static void a_grazing_star_sheds_and_goes_on(void **state)
{
    (void)state;
    struct kd_playground_params params = kd_playground_defaults();
    params.h_max = 20;
    params.budget = 1000000;
    struct kd_playground *p = playground_make(params);
    const double radius = 0.47, mass = 1e-6, depth = 0.7, pericentre = kd_tide_radius(mass, radius) / depth, r = 300;
    const double l = pericentre * sqrt(2 / (pericentre - 2)), across = l / r;
    playground_put(p, (struct kd_playground_body) { .mass = mass,
                                                    .radius = radius,
                                                    .x = { r, 0, 0 },
                                                    .v = { -sqrt(2 / (r - 2) - across * across), across, 0 } });
    playground_advance(p, 6000);
    assert_int_equal(p->n, 1);
    const double lost = 1 - p->bodies[0].mass / mass;
    print_message("lost %.4f, the fit %.4f\n", lost, kd_tide_share(depth));
    assert_true(fabs(lost - kd_tide_share(depth)) < 0.003);
    assert_true(fabs(pow(p->bodies[0].radius / radius, 3) - (1 - lost)) < 1e-12);
    assert_true(p->events.last >= 1 && kd_playground_event_at(&p->events, 1)->kind == KD_PLAYGROUND_SHEDDING);
    kd_playground_destroy(p);
}

static void all_finite(struct kd_playground *p)
{
    for (size_t i = 0; i < p->n; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(p->bodies[i].x[k]) || !(fabs(p->bodies[i].v[k]) <= 1 + 1e-12))
                fail_msg("body %u: x %g, v %g", p->bodies[i].id, p->bodies[i].x[k], p->bodies[i].v[k]);
    assert_true(isfinite(p->t) && isfinite(kd_playground_totals(p).energy));
}

static void scenes_that_mean_harm_stay_finite(void **state)
{
    (void)state;
    static const double masses[] = { 0, 1e-12, 1, 1e12 };
    for (int i = 0; i < 4; i++)
        for (int waves = 0; waves < 2; waves++) {
            struct kd_playground_params params = kd_playground_defaults();
            struct kd_playground_progress progress;
            params.budget = 300;
            params.softening = 1e-4;
            params.waves = waves;
            params.amplification = 1e9;
            struct kd_playground *p = playground_make(params);
            const double m = masses[i];
            /* two bodies at the same place */
            playground_put(p, (struct kd_playground_body) { .mass = m, .x = { 10, 0, 0 } });
            playground_put(p, (struct kd_playground_body) { .mass = m, .x = { 10, 0, 0 }, .v = { 1, 0, 0 } });
            playground_put(p, (struct kd_playground_body) { /* a body at the horizon with speed c */
                                                            .mass = m,
                                                            .x = { 8, 0, 0 },
                                                            .v = { -1, 0, 0 } });
            playground_put(p, (struct kd_playground_body) {
                                  .mass = m, .radius = 3, .x = { 2.06, 0, 0 } }); /* next to the hole, at rest */
            playground_put(p, (struct kd_playground_body) { .mass = 1e12, .x = { 0, 0, -1e6 } });
            playground_put(p, (struct kd_playground_body) { .mass = m, .radius = 1e6, .x = { 0, 500, 0 } });
            kd_playground_advance(p, 100, &progress);
            all_finite(p);
            kd_playground_advance(p, 1e9, &progress);
            all_finite(p);
            assert_true(progress.slowed);
            kd_playground_destroy(p);
        }
}

/* All bodies are captured in one sub-step, or all shed mass in every sub-step. Each case must cost a few passes over
 * all pairs, and not one pass for each body. With gravity "kerr" two cases must stop at the budget: steps that would
 * never end, and times so large that adding a step does not change them. */
static void harm_is_bounded(void **state)
{
    (void)state;
    struct kd_playground_params params = kd_playground_defaults();
    struct kd_playground_progress progress;
    for (int torn = 0; torn < 2; torn++) {
        params.budget = 3;
        params.softening = 10;
        params.debris_capacity = 1000;
        params.debris_per_body = 100;
        params.mergers = false;
        struct kd_playground *p = playground_make(params);
        for (unsigned i = 0; i < KD_PLAYGROUND_BODIES_MAX; i++)
            playground_put(p, (struct kd_playground_body) { .mass = 1e-12,
                                                            .radius = torn ? 2e-4 : 0,
                                                            .x = { torn ? 1.3 + 1e-9 * i : 1.4502, torn ? 2 : 1.45, 0 },
                                                            .v = { -0.7, -0.7, 0 } });
        kd_playground_advance(p, 100, &progress);
        all_finite(p);
        assert_true(torn ? p->debris.last_source > 4000 : p->n == 0);
        kd_playground_destroy(p);
    }
    struct kd_playground *p = playground_read("{\"gravity\":\"kerr\",\"h_max\":1e-6,\"budget\":100,\"bodies\":[{"
                                              "\"position\":[9,0,0],\"velocity\":[0,0.3,0]}]}");
    kd_playground_advance(p, 1000, &progress);
    assert_true(progress.slowed && progress.done > 0 && progress.done < 1);
    p->t = 1e12;
    kd_playground_advance(p, 1000, &progress);
    assert_true(progress.slowed);
    kd_playground_destroy(p);
    params = playground_quiet();
    params.h_max = 1e-6;
    p = playground_make(params);
    playground_put(p, (struct kd_playground_body) { .x = { 9, 0, 0 }, .v = { 0, 0.3, 0 } });
    p->t = 1e12;
    kd_playground_advance(p, 1000, &progress);
    assert_true(progress.slowed && p->bodies[0].x[0] == 9);
    kd_playground_destroy(p);
}

static void four_thousand_at_one_point(void **state)
{
    (void)state;
    for (int touching = 0; touching < 2; touching++) {
        struct kd_playground_params params = kd_playground_defaults();
        struct kd_playground_progress progress;
        params.budget = 2;
        params.tides = false;
        struct kd_playground *p = playground_make(params);
        struct kd_error error = { 0 };
        for (unsigned i = 0; i < KD_PLAYGROUND_BODIES_MAX; i++) {
            const struct kd_playground_body body = {
                .mass = 1e-6, .radius = touching, .x = { 50, 0, 0 }, .v = { 0, 0.1, 0 }
            };
            if (i < 40 || touching == 0)
                playground_put(p, body);
        }
        if (!touching)
            assert_int_equal(kd_playground_add(p, &p->bodies[0], NULL, &error), KD_ETOOBIG);
        const double mass = kd_playground_totals(p).mass;
        kd_playground_advance(p, 1, &progress);
        all_finite(p);
        assert_int_equal(p->n, touching ? 1 : KD_PLAYGROUND_BODIES_MAX);
        assert_true(fabs(kd_playground_totals(p).mass / mass - 1) < 1e-12);
        kd_playground_destroy(p);
    }
}

/* Debris far out moves by the same distance however short the strides are. In single precision, neither its place nor
 * its velocity would change. */
static void far_debris_moves(void **state)
{
    (void)state;
    static const double out[] = { 1e3, 1e4, 1e5, 1e6 };
    struct kd_playground_debris debris[2] = { { 0 }, { 0 } };
    const size_t n = sizeof out / sizeof *out;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(kd_debris_resize(&debris[i], (uint32_t)n, NULL), KD_OK);
        kd_debris_source_begin(&debris[i], "star", 1e-6, 1e-3, 1e-4);
        for (size_t k = 0; k < n; k++)
            debris[i].pieces[k] = (struct kd_debris_piece) { .x = { out[k], 0.3 * out[k], 0 },
                                                             .v = { -0.3 / sqrt(out[k]), 0.8 / sqrt(out[k]), 0 },
                                                             .source = 1,
                                                             .stage = KD_DEBRIS_LEAVES };
        debris[i].used = debris[i].alive = (uint32_t)n;
    }
    kd_debris_advance(&debris[0], 4000, 1e-4, true);
    for (int k = 1; k <= 40000; k++)
        kd_debris_advance(&debris[1], 0.1 * k, 1e-4, true);
    for (size_t k = 0; k < n; k++)
        for (int i = 0; i < 2; i++) {
            const struct kd_debris_piece *one = &debris[0].pieces[k], *other = &debris[1].pieces[k];
            assert_true(fabs(one->x[i] - other->x[i]) < 1e-7 * out[k] &&
                        fabs(one->v[i] - other->v[i]) < 1e-7 / sqrt(out[k]));
            assert_true(fabs(one->v[i] - (i ? 0.8 : -0.3) / sqrt(out[k])) >
                        300 / (out[k] * out[k])); /* the hole's attraction has changed the velocity */
        }
    for (int i = 0; i < 2; i++)
        kd_debris_finish(&debris[i]);
}

/* After the heaviest and widest bodies have merged, a snapshot can be read back. */
static void the_greatest_merge(void **state)
{
    (void)state;
    struct kd_playground_params params = kd_playground_defaults();
    params.tides = false;
    struct kd_playground *p = playground_make(params), *q;
    struct kd_playground_progress progress;
    struct kd_error error = { 0 };
    struct kd_buffer out = { 0 };
    for (int i = 0; i < 3; i++)
        playground_put(p, (struct kd_playground_body) { .mass = 1e12, .radius = 1e6, .x = { 5e5, i, 0 } });
    kd_playground_advance(p, 1, &progress);
    assert_true(p->n == 1 && p->bodies[0].mass == 3e12 && p->bodies[0].radius > 1.4e6);
    assert_int_equal(kd_playground_write(p, true, &out), KD_OK);
    if (kd_playground_read((const char *)out.data, out.size, &q, &error))
        fail_msg("%s (at %s)", error.message, error.pointer);
    kd_buffer_finish(&out);
    kd_playground_destroy(p);
    kd_playground_destroy(q);
}

/* The smallest allowed stars and radii give no NaN, whether they are torn apart or not, and a snapshot of them can be
 * continued. */
static void the_least_stars(void **state)
{
    (void)state;
    static const double sizes[] = { 1e-30, 1e-12, 1, 1e6 }, masses[] = { 1e-30, 1e-15, 1, 1e12 };
    for (int i = 0; i < 16; i++) {
        struct kd_playground_params params = kd_playground_defaults();
        params.debris_per_body = 100;
        struct kd_playground *p = playground_make(params), *q;
        struct kd_playground_progress progress;
        struct kd_error error = { 0 };
        struct kd_buffer out = { 0 };
        playground_put(p,
                       (struct kd_playground_body) {
                           .mass = masses[i / 4], .radius = sizes[i % 4], .x = { 30, 0, 0 }, .v = { -0.1, 0.05, 0 } });
        kd_playground_advance(p, 60, &progress);
        assert_true(isfinite(p->spent.torn_energy) && isfinite(kd_playground_totals(p).energy));
        for (uint32_t k = 0; k < p->debris.used; k++)
            assert_true(isfinite(p->debris.pieces[k].x[0]) && isfinite(p->debris.pieces[k].v[1]));
        for (size_t k = 0; k < p->n; k++)
            assert_true(isfinite(p->bodies[k].x[0]) && p->bodies[k].mass >= KD_PLAYGROUND_LEAST &&
                        p->bodies[k].radius >= KD_PLAYGROUND_LEAST);
        assert_int_equal(kd_playground_write(p, true, &out), KD_OK);
        if (kd_playground_read((const char *)out.data, out.size, &q, &error))
            fail_msg("mass %g, radius %g: %s (at %s)", masses[i / 4], sizes[i % 4], error.message, error.pointer);
        kd_buffer_finish(&out);
        kd_playground_destroy(p);
        kd_playground_destroy(q);
    }
}

/* A series without end keeps rows at equal distances from the beginning, however long it gets. In files the last row is
 * the present state. */
static void series_of_no_end_are_even(void **state)
{
    (void)state;
    struct kd_playground *p = playground_read("{\"preset\":\"emri\",\"h_max\":0.1,\"budget\":100000000}");
    for (int k = 0; k < 40; k++) {
        playground_advance(p, 40);
        const struct kd_playground_series *s = &p->series;
        double now[KD_SERIES_N];
        kd_playground_series_row(p, now);
        assert_true(s->n < KD_SERIES_ROWS && kd_series_next(s) > p->t && kd_series_next(s) < p->t + 2 * s->interval);
        assert_true(k < 20 || s->n >= KD_SERIES_ROWS / 2);
        for (size_t i = 0; i < s->n; i++)
            assert_true(fabs(s->rows[i][KD_SERIES_t] - (double)i * s->interval) < 1e-9);
        struct kd_buffer csv = { 0 };
        assert_int_equal(kd_series_csv(s, now, &csv), KD_OK);
        size_t lines = 0;
        for (size_t i = 0; i < csv.size; i++)
            lines += csv.data[i] == '\n';
        assert_true(lines == s->n + 2 || (lines == s->n + 1 && s->rows[s->n - 1][KD_SERIES_t] == p->t));
        kd_buffer_finish(&csv);
    }
    kd_playground_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_spiral_in_as_peters_says),
        cmocka_unit_test(a_body_spirals_into_the_hole_as_peters_says),
        cmocka_unit_test(near_the_hole_it_is_his_power_and_another_pace),
        cmocka_unit_test(series_of_no_end_are_even),
        cmocka_unit_test(an_eccentric_pair_grows_round_as_peters_says),
        cmocka_unit_test(mergers_keep_mass_and_momentum),
        cmocka_unit_test(debris_comes_back_as_the_fifth_third_power),
        cmocka_unit_test(a_grazing_star_sheds_and_goes_on),
        cmocka_unit_test(scenes_that_mean_harm_stay_finite),
        cmocka_unit_test(four_thousand_at_one_point),
        cmocka_unit_test(harm_is_bounded),
        cmocka_unit_test(far_debris_moves),
        cmocka_unit_test(the_least_stars),
        cmocka_unit_test(the_greatest_merge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
