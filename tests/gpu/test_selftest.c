/* Tests that the self-test passes here and detects a wrong number. Every device would pass a comparison that cannot
 * fail. */
#include "render/selftest/selftest.h"

#include "render_support.h"

#include <math.h>

#define ROWS 256

struct table {
    struct kd_selftest_row rows[ROWS];
    int n, failed;
};

static bool keep(void *user, const struct kd_selftest_row *row)
{
    struct table *t = user;
    assert_true(t->n < ROWS);
    t->rows[t->n++] = *row;
    t->failed += !row->ok;
    return true;
}

static void run(const struct kd_selftest_reference *reference, struct table *t)
{
    *t = (struct table) { .n = 0 };
    OK(kd_selftest_run(renderer, reference, keep, t, &error));
}

static struct table table;

static void test_passes(void **state)
{
    (void)state;
    run(&kd_selftest_reference, &table);
    for (int i = 0; i < table.n; i++) {
        const struct kd_selftest_row *row = &table.rows[i];
        if (!row->ok)
            print_message("%s by %s: %g, bound %g\n", row->what, row->by, row->error, row->bound);
        assert_true(row->compared > 0 && row->error >= 0 && row->bound >= 0 && row->source[0]);
    }
    assert_int_equal(table.failed, 0);
    assert_true(table.n > 60);
}

/* If every number is off by more than single precision allows, every line that uses the table must fail. */
static void test_everything_wrong(void **state)
{
    (void)state;
    static struct kd_selftest_reference wrong;
    wrong = kd_selftest_reference;
    for (size_t i = 0; i < wrong.n_orbits; i++)
        for (double *x = &wrong.orbits[i].horizon; x <= &wrong.orbits[i].efficiency; x++)
            *x *= 1 + 1e-12;
    struct kd_selftest_ray *all[64];
    size_t n = 0;
    for (size_t i = 0; i < wrong.n_rays; i++)
        all[n++] = &wrong.rays[i];
    for (size_t i = 0; i < wrong.n_cameras; i++)
        all[n++] = &wrong.cameras[i].ray;
    for (size_t i = 0; i < n; i++) {
        all[i]->theta += 0.2;
        for (int k = 0; k < all[i]->n_crossings; k++) {
            struct kd_selftest_crossing *c = &all[i]->crossing[k];
            c->r *= 1.01, c->phi += 0.01, c->delay += 0.5, c->g *= 1.01;
        }
    }
    for (size_t i = 0; i < wrong.n_deflections; i++)
        wrong.deflections[i].phi += 1e-3;
    for (size_t i = 0; i < wrong.n_criticals; i++) /* moves two rays next to the edge to the other side */
        wrong.criticals[i].alpha *= 1 + 2e-5, wrong.criticals[i].beta *= 1 + 2e-5;
    for (size_t i = 0; i < wrong.n_bounds; i++)
        for (double *x = &wrong.bounds[i].energy; x <= &wrong.bounds[i].mino_proper; x++)
            *x *= 1 + 1e-11;
    for (size_t i = 0; i < wrong.n_fluxes; i++)
        wrong.fluxes[i].flux *= 1 + 1e-9;
    for (size_t i = 0; i < wrong.n_pixels; i++)
        wrong.pixels[i].brightness *= 1.001;
    for (size_t i = 0; i < wrong.n_greys; i++)
        wrong.greys[i].srgb += 3 / 65535.0, wrong.greys[i].film[i % 3] += 3 / 65535.0;
    run(&wrong, &table);
    for (int i = 0; i < table.n; i++) {
        bool itself =
            table.rows[i].bound == 0 || strstr(table.rows[i].what, "Mercury"); /* excluded, because this line's numbers
                                                                                * are not from the table */
        if (table.rows[i].ok != itself)
            fail_msg("%s by %s: %g, bound %g", table.rows[i].what, table.rows[i].by, table.rows[i].error,
                     table.rows[i].bound);
    }
}

/* If one radius is wrong in its tenth digit, double precision detects it, and only lines of that set fail. */
static void test_one_wrong(void **state)
{
    (void)state;
    static struct kd_selftest_reference wrong;
    wrong = kd_selftest_reference;
    wrong.rays[4].crossing[0].r *= 1 + 1e-10;
    run(&wrong, &table);
    int seen = 0;
    for (int i = 0; i < table.n; i++) {
        const struct kd_selftest_row *row = &table.rows[i];
        if (row->ok)
            continue;
        seen++;
        assert_string_equal(row->what, "rays, bulk: r (relative)");
        assert_non_null(strstr(row->by, "f64"));
        assert_true(row->error > 0.9e-10 && row->error < 1.1e-10 && row->bound < 1e-10);
    }
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    assert_int_equal(seen, capacity.float64 ? 2 : 1);
}

/* The self-test detects a fate or a number of crossings that differs from the table's. */
static void test_fates(void **state)
{
    (void)state;
    static struct kd_selftest_reference wrong;
    for (int k = 0; k < 2; k++) {
        wrong = kd_selftest_reference;
        if (k)
            wrong.rays[4].n_crossings = 1;
        else
            wrong.rays[4].captured = !wrong.rays[4].captured;
        run(&wrong, &table);
        assert_true(table.failed >= 3);
    }
}

static void test_compare(void **state)
{
    (void)state;
    struct kd_selftest_row row;
    kd_selftest_begin(&row, "source", "by", "what %d", 1);
    kd_selftest_compare(&row, -1e-3, 1e-3);
    assert_true(row.ok && row.error == 1e-3 && row.compared == 1);
    kd_selftest_compare(&row, 1e-2, 1e-1); /* this error is larger than the other one, but farther below its bound */
    assert_true(row.ok && row.error == 1e-3);
    kd_selftest_compare(&row, nextafter(1e-3, 1), 1e-3);
    assert_true(!row.ok && row.bound == 1e-3);
    kd_selftest_compare(&row, 0, 1);
    assert_false(row.ok);
    static const double bad[] = { NAN, INFINITY };
    for (int i = 0; i < 2; i++) {
        kd_selftest_begin(&row, "source", "by", "what");
        kd_selftest_compare(&row, 0, 1);
        kd_selftest_compare(&row, bad[i], 1);
        assert_true(!row.ok && isinf(row.error));
        kd_selftest_compare(&row, 2, 1);
        assert_true(isinf(row.error));
    }
    kd_selftest_begin(&row, "source", "by", "what");
    kd_selftest_compare(&row, 0, 0);
    assert_true(row.ok);
    kd_selftest_compare(&row, 1, 0);
    assert_true(!row.ok && row.error == 1);
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_compare),   cmocka_unit_test(test_passes), cmocka_unit_test(test_everything_wrong),
        cmocka_unit_test(test_one_wrong), cmocka_unit_test(test_fates),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
