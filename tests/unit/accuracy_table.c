/* Tests of the accuracy table: choices from synthetic tables, the JSON document in both directions, the file, and the
 * sets of rays. */
#include "physics/spacetime/kerr.h"
#include "render/device/accuracy_store.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct kd_accuracy_table table, again;
static struct kd_error error;

static struct kd_accuracy_row *add(enum kd_engine engine, enum kd_precision precision, uint32_t steps, double speed,
                                   double median)
{
    struct kd_accuracy_row *row = &table.rows[table.n++];
    *row = (struct kd_accuracy_row) { .engine = engine, .precision = precision, .steps = steps };
    for (int k = 0; k < KD_ACCURACY_SETS; k++) {
        struct kd_accuracy_entry *e = &row->sets[k];
        *e = (struct kd_accuracy_entry) { .rays_per_s = speed, .rays = 1000, .crossings = 1500 };
        /* Only errors of radii count. Errors near the critical curve do not. */
        for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++)
            e->of[q] = k == KD_ACCURACY_NEAR_CRITICAL || q ? (struct kd_accuracy_errors) { 1, 1, 1 }
                                                           : (struct kd_accuracy_errors) { median, 4 * median, 1 };
    }
    return row;
}

/* made_up: in each row the medians are a quarter of the error that the row states. */
static int made_up(void **state)
{
    (void)state;
    table = (struct kd_accuracy_table) { .version = "1.2.3",
                                         .date = "2026-01-02T03:04:05Z",
                                         .command = "kerrd bench accuracy",
                                         .machine = "a \"machine\"",
                                         .device = "a device",
                                         .skipped = "nothing",
                                         .cores = 2,
                                         .device_clock = true,
                                         .quick = true,
                                         .seconds = 0.25 };
    error = (struct kd_error) { 0 };
    add(KD_ENGINE_CLOSED, KD_PRECISION_F64, 0, 1e9, NAN);
    add(KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 4, 4e6, 0.25e-5);
    add(KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 8, 2e6, 0.25e-6);
    add(KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 16, 1e6, 0.5e-6); /* limited by rounding */
    /* a device that is faster in double than in single precision */
    add(KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8, 2.5e6, 0.25e-8);
    add(KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 16, 1e5, 0.25e-11);
    add(KD_ENGINE_KS_RK4, KD_PRECISION_F32, 64, 3e6, 0.25e-4);
    return 0;
}

static void expect(double tolerance, enum kd_engine engine, enum kd_precision precision, uint32_t steps)
{
    struct kd_accuracy_choice choice;
    if (kd_accuracy_choose(&table, tolerance, NULL, &choice, &error))
        fail_msg("%g: %s", tolerance, error.message);
    assert_int_equal(choice.engine, engine);
    assert_int_equal(choice.precision, precision);
    assert_int_equal(choice.steps, steps);
    assert_true(choice.error <= tolerance && choice.error > 0 && choice.rays_per_s > 0);
}

static void the_cheapest_that_holds(void **state)
{
    (void)state;
    expect(0.5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 4);
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 4);
    /* chooses the fastest row below the tolerance, not the most accurate row */
    expect(0.99e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    expect(1e-8, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    expect(0.99e-8, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 16);
    expect(1e-11, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 16);
    table.rows[1].sets[KD_ACCURACY_BULK].rays_per_s = 1; /* makes the Runge-Kutta method the fastest one at 1e-4 */
    expect(1e-4, KD_ENGINE_KS_RK4, KD_PRECISION_F32, 64);
}

static void refused(double tolerance, const char *part)
{
    struct kd_accuracy_choice choice;
    assert_int_equal(kd_accuracy_choose(&table, tolerance, NULL, &choice, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/accuracy/tolerance");
    if (!strstr(error.message, part))
        fail_msg("%g: %s", tolerance, error.message);
}

static void what_none_holds(void **state)
{
    (void)state;
    refused(0.99e-11, "1.01e-11 at best (mino-rkn6 f64 with 16 steps)");
    /* a tolerance that an error message suggests must be accepted */
    expect(1.01e-11, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 16);
    table.n = 4; /* a device without double precision */
    refused(0.99e-6, "mino-rkn6 f32 with 8 steps");
    refused(0, "above 0");
    refused(-1e-6, "above 0");
    refused(NAN, "nan");
    refused(1, "below 1");
    table.n = 1; /* the row of the closed form lacks the errors of the closed form itself */
    refused(0.5, "kerrd bench accuracy");
    table.n = 0;
    refused(0.5, "kerrd bench accuracy");
}

/* With some numbers of steps most rays are accurate enough, but edge-on rays are not. */
static void other_sets(void **state)
{
    (void)state;
    struct kd_accuracy_entry *edge_on = &table.rows[1].sets[KD_ACCURACY_EDGE_ON];
    edge_on->of[KD_ACCURACY_R].median = 1e-5;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 4);
    edge_on->of[KD_ACCURACY_R].median = 1.1e-5;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    expect(1.1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 4);
    edge_on->differ = 11;
    expect(0.5, KD_ENGINE_KS_RK4, KD_PRECISION_F32, 64);
    table.rows[6].sets[KD_ACCURACY_NEAR_CRITICAL].differ = 1000;
    expect(0.5, KD_ENGINE_KS_RK4, KD_PRECISION_F32, 64);
}

/* A row that loses rays, or has no measured errors, is not used. */
static void rows_to_be_left_out(void **state)
{
    (void)state;
    struct kd_accuracy_entry *bulk = &table.rows[1].sets[KD_ACCURACY_BULK];
    bulk->differ = 10;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 4);
    bulk->differ = 11;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    bulk->differ = 0;
    bulk->of[KD_ACCURACY_R].median = NAN;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    bulk->of[KD_ACCURACY_R].median = 0.25e-5;
    bulk->of[KD_ACCURACY_R].p99 = NAN;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    bulk->of[KD_ACCURACY_R].p99 = 1e-5;
    bulk->crossings = 0;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
    bulk->crossings = 1;
    bulk->rays_per_s = NAN;
    expect(1e-5, KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 8);
}

static void same(double a, double b)
{
    if (!(isnan(a) && isnan(b)) && !(fabs(a - b) <= 1e-3 * fabs(a)))
        fail_msg("%g is not %g", a, b);
}

static void there_and_back(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    table.rows[6].sets[2].of[KD_ACCURACY_DELAY] = (struct kd_accuracy_errors) { NAN, NAN, NAN };
    assert_int_equal(kd_accuracy_to_json(&table, &text), KD_OK);
    assert_int_equal(kd_accuracy_from_json((const char *)text.data, text.size, &again, &error), KD_OK);
    assert_string_equal(again.version, table.version);
    assert_string_equal(again.date, table.date);
    assert_string_equal(again.command, table.command);
    assert_string_equal(again.machine, table.machine);
    assert_string_equal(again.device, table.device);
    assert_string_equal(again.skipped, table.skipped);
    assert_true(again.cores == 2 && again.quick && again.device_clock && again.seconds == 0.25 && again.n == table.n);
    for (uint32_t i = 0; i < table.n; i++) {
        const struct kd_accuracy_row *a = &table.rows[i], *b = &again.rows[i];
        assert_true(a->engine == b->engine && a->precision == b->precision && a->steps == b->steps);
        for (int k = 0; k < KD_ACCURACY_SETS; k++) {
            const struct kd_accuracy_entry *x = &a->sets[k], *y = &b->sets[k];
            assert_true(x->rays == y->rays && x->crossings == y->crossings && x->differ == y->differ);
            same(x->rays_per_s, y->rays_per_s);
            for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
                same(x->of[q].median, y->of[q].median);
                same(x->of[q].p99, isnan(x->of[q].median) ? x->of[q].p99 : y->of[q].p99);
                same(x->of[q].worst, isnan(x->of[q].median) ? x->of[q].worst : y->of[q].worst);
            }
        }
    }
    kd_buffer_finish(&text);
}

/* A document that is cut anywhere, or damaged, gives an error and never a table. */
static void no_table(void **state)
{
    (void)state;
    static const char *const bad[] = { "", "null", "[]", "{}", "{\"format\":1}", "{\"format\":1,\"rows\":[]}" };
    struct kd_buffer text = { 0 };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(kd_accuracy_from_json(bad[i], strlen(bad[i]), &again, &error), KD_EINVAL);
    assert_int_equal(kd_accuracy_to_json(&table, &text), KD_OK);
    for (size_t n = 0; n + 2 < text.size; n += 7)
        assert_int_equal(kd_accuracy_from_json((const char *)text.data, n, &again, &error), KD_EINVAL);
    static const struct {
        const char *from, *to;
    } damage[] = {
        { "\"format\": 1", "\"format\": 2" }, { "mino-rkn6", "mino-rkn7" },       { "\"f32\"", "\"f16\"" },
        { "\"steps\": 8", "\"steps\": .8" },  { "\"rays\": 10", "\"rays\": -1" }, { "\"differ\": 0", "\"differ\": \"" },
    };
    for (size_t i = 0; i < sizeof damage / sizeof *damage; i++) {
        char *copy = strdup((const char *)text.data), *at = strstr(copy, damage[i].from);
        if (!at)
            fail_msg("%s is not in the document", damage[i].from);
        memcpy(at, damage[i].to, strlen(damage[i].to));
        assert_int_equal(kd_accuracy_from_json(copy, text.size, &again, &error), KD_EINVAL);
        free(copy);
    }
    kd_buffer_finish(&text);
}

static void kept(void **state)
{
    (void)state;
    char folder[] = "/tmp/kerrd-accuracy-XXXXXX", path[100], inner[80];
    assert_non_null(mkdtemp(folder));
    snprintf(inner, sizeof inner, "%s/a", folder);
    snprintf(path, sizeof path, "%s/table.json", inner);
    assert_int_equal(kd_accuracy_load(path, &again, &error), KD_EIO);
    assert_non_null(strstr(error.message, "kerrd bench accuracy"));
    assert_int_equal(kd_accuracy_load(NULL, &again, &error), KD_EIO);
    assert_int_equal(kd_accuracy_save(&table, path, &error), KD_OK); /* creates the folder */
    assert_int_equal(kd_accuracy_load(path, &again, &error), KD_OK);
    assert_int_equal(again.n, table.n);
    table.n = 2;
    assert_int_equal(kd_accuracy_save(&table, path, &error), KD_OK);
    assert_int_equal(kd_accuracy_load(path, &again, &error), KD_OK);
    assert_int_equal(again.n, 2);
    assert_int_equal(truncate(path, 100), 0);
    assert_int_equal(kd_accuracy_load(path, &again, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "kerrd bench accuracy"));
    assert_int_equal(kd_accuracy_load(inner, &again, &error), KD_EIO); /* a directory */
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(inner), 0); /* no other file was left in the folder */
    assert_int_equal(kd_accuracy_save(&table, "/proc/kerrd/table.json", &error), KD_EIO);
    assert_int_equal(rmdir(folder), 0);
}

static void markdown(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    int columns = 0, lines = 0;
    assert_int_equal(kd_accuracy_to_markdown(&table, &text), KD_OK);
    for (char *save, *line = strtok_r((char *)text.data, "\n", &save); line; line = strtok_r(NULL, "\n", &save)) {
        int bars = 0;
        for (const char *c = line; line[0] == '|' && *c; c++)
            bars += *c == '|' && (c == line || c[-1] == ' ' || c[-1] == '-');
        if (line[0] != '|')
            continue;
        columns = columns ? columns : bars;
        assert_int_equal(bars, columns);
        lines++;
    }
    assert_int_equal(lines, KD_ACCURACY_SETS * (2 + table.n));
    kd_buffer_finish(&text);
}

/* On the critical curve the radial potential R = (r^2 + a^2 - a l)^2 - Delta (eta + (l - a)^2) has a double root
 * outside the horizon; beside the curve it has no root or two roots there (Bardeen 1973). Returns the minimum of R
 * outside the horizon, by search. */
static double least_potential(double a, double inclination_deg, const double *x)
{
    double s = sin(inclination_deg * M_PI / 180), u2 = 1 - s * s;
    double l = -x[0] * s, eta = (x[0] * x[0] - a * a) * u2 + x[1] * x[1], least = INFINITY;
    for (double r = kd_hole(a)->outer * 1.0001; r < 6; r += 1e-5) {
        double q = r * r + a * a - a * l, delta = (r - 2) * r + a * a;
        least = fmin(least, q * q - delta * (eta + (l - a) * (l - a)));
    }
    return least;
}

/* Rays of the near-critical set lie alternately on both sides of the critical curve, at the stated distances. Rays of
 * the other sets are not near it. */
static void critical_curve(void **state)
{
    (void)state;
    enum { N = 40 };
    double rays[2 * N];
    struct kd_accuracy_view views[KD_ACCURACY_VIEWS];
    kd_accuracy_views(KD_ACCURACY_NEAR_CRITICAL, views);
    kd_accuracy_rays(KD_ACCURACY_NEAR_CRITICAL, 0, N, rays);
    double a = views[0].spin, i = views[0].inclination_deg;
    for (int k = 0; k < N; k++) {
        int decade = k / 2 % 5 + 2;
        double least = least_potential(a, i, rays + 2 * k), scale = fabs(least) * 0.2 * pow(10, decade);
        /* R grows with the distance from the curve, by some tens of M^4 per unit, so its minimum is resolved beyond
         * 1e-4. */
        if ((k % 2 ? least > 0 : least < 0) || (decade <= 4 && !(scale > 5 && scale < 500)))
            fail_msg("ray %d: R is %g at least, 5e-%d from the curve", k, least, decade);
    }
    kd_accuracy_rays(KD_ACCURACY_BULK, 0, N, rays);
    for (int k = 0; k < N; k++)
        assert_true(fabs(least_potential(a, i, rays + 2 * k)) > 5e-2);
}

static void lists_of_rays(void **state)
{
    (void)state;
    enum { N = 600 };
    double first[2 * N], rays[2 * N];
    struct kd_accuracy_view views[KD_ACCURACY_VIEWS];
    for (int set = 0; set < KD_ACCURACY_SETS; set++) {
        uint32_t n_views = kd_accuracy_views((enum kd_accuracy_set)set, views);
        assert_in_range(n_views, 1, KD_ACCURACY_VIEWS);
        for (uint32_t v = 0; v < n_views; v++) {
            kd_accuracy_rays((enum kd_accuracy_set)set, v, 50, first);
            kd_accuracy_rays((enum kd_accuracy_set)set, v, N, rays);
            assert_memory_equal(first, rays, 100 * sizeof(double)); /* the longer list begins with the shorter one */
            int quadrants[4] = { 0 };
            for (int k = 0; k < N; k++) {
                assert_true(fabs(rays[2 * k]) <= 12 && fabs(rays[2 * k + 1]) <= 12);
                quadrants[2 * (rays[2 * k] > 0) + (rays[2 * k + 1] > 0)]++;
            }
            for (int k = 0; k < 4; k++)
                assert_in_range(quadrants[k], N / 12, N / 2);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_cheapest_that_holds, made_up),
        cmocka_unit_test_setup(what_none_holds, made_up),
        cmocka_unit_test_setup(other_sets, made_up),
        cmocka_unit_test_setup(rows_to_be_left_out, made_up),
        cmocka_unit_test_setup(there_and_back, made_up),
        cmocka_unit_test_setup(no_table, made_up),
        cmocka_unit_test_setup(kept, made_up),
        cmocka_unit_test_setup(markdown, made_up),
        cmocka_unit_test(critical_curve),
        cmocka_unit_test(lists_of_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
