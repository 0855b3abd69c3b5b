/* Tests the error that a line profile states against its true error, over a random sample of all possible requests: at
 * least 999 of 1000 must be within the stated error. The true error is found with triangles between rays
 * (tests/oracle/line_triangles.h), whose number grows until their own uncertainty is below the stated error. Next to
 * edge on, where the line is summed over columns, the true error is found with two grids of rays, each at a random
 * place of its field.
 *
 *     unit_told_lines [PROFILES [SEED [SIDE]]]     a long run: 2000 take some ten minutes. With SIDE all are within 3
 *                                                  degrees of edge on, compared with grids of SIDE^2 rays */
#include "base/random.h"
#include "physics/disk/lamppost.h"
#include "physics/disk/line_profile.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include "line_triangles.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define RADIAN (M_PI / 180)
enum { BINS = 500, SHORT = 8, FINEST = 4, SHORT_SIDE = 400 };

static int profiles = SHORT, side = SHORT_SIDE;
static uint64_t seed = 1;
static struct kd_disk_image image;

struct asked {
    struct kd_hole hole;
    double inclination_deg;
    struct kd_line_params params;
    struct kd_lamppost lamp;
    int bins;
    double edges[BINS + 1];
};

static double between(struct kd_random *random, double low, double high)
{
    return low + (high - low) * kd_random(random);
}

static bool one_in(struct kd_random *random, int n) { return kd_random(random) * n < 1; }

static double any_spin(struct kd_random *random)
{
    double spin = one_in(random, 4) ? 1 - pow(10, between(random, -6, -2)) : between(random, 0, 0.998);
    return one_in(random, 2) ? -spin : spin;
}

/* One in four is charged, up to a^2 + q^2 = 1 - 1e-6. */
static struct kd_hole any_hole(struct kd_random *random)
{
    const double a = any_spin(random), room = sqrt((1 - a) * (1 + a));
    const double share = one_in(random, 3) ? 1 - pow(10, between(random, -6, -2)) : kd_random(random);
    return kd_hole_charged(a, one_in(random, 4) ? share * room : 0);
}

static void ask_light(struct kd_random *random, struct kd_line_params *p, double horizon)
{
    double ends[2] = { one_in(random, 5) ? -10 : 0, one_in(random, 5) ? 20 : 8 };
    p->emissivity = (enum kd_line_emissivity)(3 * kd_random(random));
    p->limb = (enum kd_limb)(4 * kd_random(random));
    p->energy = one_in(random, 2);
    p->index = between(random, ends[0], ends[1]);
    p->outer_index = between(random, ends[0], ends[1]);
    p->break_r = p->inner * pow(p->outer / p->inner, kd_random(random));
    p->height = 1.05 * horizon * pow(100, kd_random(random));
    p->photon_index = between(random, 1, 3.5);
}

/* Chooses even bins as by default, or a few edges at random places. */
static void ask_edges(struct kd_random *random, struct asked *q)
{
    double at = 0;
    q->bins = one_in(random, 2) ? BINS : 1 + (int)between(random, 0, 20);
    for (int e = 0; e <= q->bins; e++)
        q->edges[e] = q->bins == BINS ? 1.7 * e / BINS : (at += between(random, 1e-3, 3. / q->bins));
}

static struct asked ask(struct kd_random *random, double least, double most)
{
    struct asked q = { .hole = any_hole(random), .inclination_deg = between(random, least, most) };
    struct kd_line_params *p = &q.params;
    double isco = kd_kerr_isco(&q.hole);
    p->inner = one_in(random, 2) ? isco : isco * exp(between(random, 0, 3));
    p->outer = one_in(random, 2) ? 400 : p->inner * exp(between(random, 0.05, 7));
    ask_light(random, p, q.hole.outer);
    p->tolerance = one_in(random, 4) ? 0 : pow(10, between(random, -4, -1));
    ask_edges(random, &q);
    return q;
}

static double light_of(const void *user, double r, double g, double mu)
{
    const struct asked *q = user;
    const struct kd_line_params *p = &q->params;
    double emitted = p->emissivity == KD_LINE_LAMPPOST                  ? kd_lamppost_at(&q->lamp, r)
                     : p->emissivity == KD_LINE_POWER || r < p->break_r ? pow(r / p->break_r, -p->index)
                                                                        : pow(r / p->break_r, -p->outer_index);
    double limb = p->limb == KD_LIMB_LAOR     ? 1 + 2.06 * mu
                  : p->limb == KD_LIMB_HAARDT ? log(1 + 1 / mu)
                  /* this emission law is tested by physics_limb.c */
                  : p->limb == KD_LIMB_SCATTERING ? kd_limb_at(p->limb, mu)
                                                  : 1;
    return emitted * limb * g * g * g * (p->energy ? g : 1);
}

static double worst_of(const double *share, const double *want, int bins)
{
    double sum = 0, worst = 0;
    for (int i = 0; i < bins; i++) {
        sum += share[i];
        worst = fmax(worst, fabs(sum - want[i]));
    }
    return worst;
}

struct truth { double error, known; }; /* known: the uncertainty of `error` */

static struct truth truth_of(const struct asked *q, const double *share, double told)
{
    const struct lt_law law = { q->params.inner, q->params.outer, light_of, q };
    static double want[BINS];
    struct truth t = { 0, INFINITY };
    for (int n = 64, level = 0; level <= FINEST && !(t.error + t.known < told); level++, n *= 2) {
        double apart = lt_profile_of(&image, &law, n, n, q->edges, q->bins, want);
        assert_true(apart >= 0);
        t = (struct truth) { worst_of(share, want, q->bins), level ? 0.25 * apart : INFINITY };
    }
    return t;
}

/* The sum over one ray in each field of a grid over the image plane, even in asinh(alpha/2) and asinh(beta/0.2). */
static void sum_grid(const struct asked *q, struct kd_random *random, double *want)
{
    const double u = fabs(cos(q->inclination_deg * RADIAN)), outer = q->params.outer, wide = asinh((outer + 8) / 2),
                 high = asinh((outer * u + 2 * sqrt(outer) + 10) / 0.2);
    double all = 0;
    memset(want, 0, BINS * sizeof *want);
    for (int k = 0; k < side * side; k++) {
        const double x = wide * (2 * (k / side + kd_random(random)) / side - 1),
                     y = high * (2 * (k % side + kd_random(random)) / side - 1);
        const struct kd_null_ray ray = { .hole = q->hole,
                                         .radius = INFINITY,
                                         .cos_theta = u,
                                         .alpha = 2 * sinh(x),
                                         .beta = 0.2 * sinh(y),
                                         .orders = 2 };
        const struct kd_null_path path = kd_null_trace_fast(&ray);
        const int at = path.crossings > 1 && path.crossing[0].r > outer;
        const double r = path.crossing[at].r;
        if (!path.crossings || r < q->params.inner || r > outer)
            continue;
        const struct kd_disk_ring gas = kd_disk_image_gas(&image, r);
        const struct lt_place p = { .alpha = ray.alpha,
                                    .beta = ray.beta,
                                    .g = kd_disk_image_redshift(&image, &gas, ray.alpha) };
        const double light = light_of(q, r, p.g, lt_cosine(&image, &p, r)) * cosh(x) * cosh(y);
        all += light;
        for (int e = 0; e < q->bins; e++)
            if (p.g >= q->edges[e] && p.g < q->edges[e + 1]) {
                want[e] += light;
                break;
            }
    }
    for (int e = 0; e < q->bins; e++)
        want[e] = (e ? want[e - 1] : 0) + want[e] / all;
}

static struct truth truth_of_grids(const struct asked *q, const double *share, struct kd_random *random)
{
    static double one[BINS], other[BINS];
    double apart = 0;
    sum_grid(q, random, one);
    sum_grid(q, random, other);
    for (int e = 0; e < q->bins; e++) {
        apart = fmax(apart, fabs(one[e] - other[e]));
        one[e] = 0.5 * (one[e] + other[e]);
    }
    return (struct truth) { worst_of(share, one, q->bins), 2 * apart }; /* some four standard errors */
}

static void describe(const struct asked *q, double told, struct truth t)
{
    const struct kd_line_params *p = &q->params;
    print_message(
        "a = %.17g, q = %.17g, i = %.17g, %g to %g M, law %d (%g, %g from %g; lamp at %g, %g), limb %d, energy %d, %d "
        "bins, tolerance %.1e: told %.2e, off by %.2e +- %.1e\n",
        q->hole.a, q->hole.q, q->inclination_deg, p->inner, p->outer, (int)p->emissivity, p->index, p->outer_index,
        p->break_r, p->height, p->photon_index, (int)p->limb, p->energy, q->bins, p->tolerance, told, t.error, t.known);
}

static void compare(double least, double most, int wanted)
{
    struct kd_random random = { seed };
    int beyond = 0, asked = 0;
    while (asked < wanted) {
        static double share[BINS];
        struct asked q = ask(&random, least, most);
        const struct kd_line_params *p = &q.params;
        struct kd_line_profile profile;
        struct kd_error error;
        assert_true(kd_disk_image_init(&image, &q.hole, q.inclination_deg * RADIAN));
        if (p->emissivity == KD_LINE_LAMPPOST &&
            !kd_lamppost_init(&q.lamp, &q.hole, p->height, p->photon_index, p->inner, p->outer))
            continue;
        if (kd_line_profile(&image, p, q.edges, q.bins, share, &profile, &error))
            continue;
        struct truth t = image.angles ? truth_of(&q, share, profile.error) : truth_of_grids(&q, share, &random);
        asked++;
        if (t.error - t.known > profile.error || !(profile.error <= 1)) {
            describe(&q, profile.error, t);
            beyond++;
        } else if (profiles > SHORT && t.error > 0.7 * profile.error)
            describe(&q, profile.error, t);
    }
    print_message("%d of %d beyond the stated error\n", beyond, asked);
    assert_true(1000 * beyond <= asked);
}

static void test_lines(void **state)
{
    (void)state;
    compare(0, 87, profiles);
}

static void test_edge_on(void **state)
{
    (void)state;
    compare(87, 93, profiles == SHORT ? SHORT / 2 : profiles);
}

int main(int count, char **words)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_edge_on), cmocka_unit_test(test_lines) };
    profiles = count > 1 ? atoi(words[1]) : SHORT;
    seed = count > 2 ? strtoull(words[2], NULL, 10) : 1;
    side = count > 3 ? atoi(words[3]) : SHORT_SIDE;
    cmocka_set_test_filter(count > 3 ? "test_edge_on" : NULL);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
