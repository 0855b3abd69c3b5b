/* Tests of the contents of pictures of a playground: bodies in the metric's coordinates, and debris on a grid whose
 * total equals that of the pieces. */
#include "playground_support.h"

#include "playground/debris.h"
#include "playground/show.h"

#include <stdio.h>
#include <stdlib.h>

static struct kd_dynamic_bodies *shown(struct kd_playground *p)
{
    struct kd_dynamic_bodies *dynamic;
    struct kd_error error = { 0 };
    if (kd_playground_show(p, &dynamic, &error))
        fail_msg("%s", error.message);
    return dynamic;
}

/* The body is shown at its place. The energy of a body that moves by Newton's law, u^2/2, becomes (gamma v)^2/2, and
 * its direction stays. */
static void bodies(void **state)
{
    (void)state;
    struct kd_playground *p = playground_make(playground_quiet());
    playground_put(p,
                   (struct kd_playground_body) {
                       .mass = 1e-6, .radius = 0.3, .temperature_k = 4000, .x = { 0, 3, 4 }, .v = { -0.6, 0, 0.5 } });
    playground_put(p, (struct kd_playground_body) {
                          .mass = 1e-6, .radius = 0.2, .temperature_k = 9000, .x = { 2.5, 0, 0 }, .v = { -1, 0, 0 } });
    struct kd_dynamic_bodies *dynamic = shown(p);
    const struct kd_seen_body *b = &dynamic->bodies[0];
    double v2 = 0;
    for (int k = 0; k < 3; k++)
        v2 += b->velocity[k] * b->velocity[k];
    assert_true(fabs(b->r - 5) < 1e-12 && fabs(b->u - 0.8) < 1e-12 && fabs(b->s - 0.6) < 1e-12 &&
                fabs(b->phi - M_PI / 2) < 1e-12);
    assert_true(fabs(v2 / (1 - v2) - 0.61) < 1e-12);
    assert_true(fabs(b->velocity[0] / b->velocity[2] - 0.4 / 0.6) < 1e-9 &&
                fabs(b->velocity[1] / b->velocity[2] + 0.3 / 0.6) < 1e-9);
    assert_true(b->radius == 0.3 && b->temperature_k == 4000 && b->brightness == 1 && b->which == 0 &&
                dynamic->bodies[1].which == 1);
    assert_true(fabs(dynamic->bodies[1].velocity[0] + M_SQRT1_2) < 1e-12 && dynamic->approximate &&
                dynamic->time == 0 && !dynamic->debris.rows);
    kd_dynamic_bodies_release(dynamic);
    kd_playground_destroy(p);

    struct kd_playground_params kerr = playground_quiet();
    kerr.gravity = KD_GRAVITY_KERR;
    kerr.spin = 0.9;
    p = playground_make(kerr);
    playground_put(p, (struct kd_playground_body) {
                          .mass = 1e-6, .radius = 0.3, .temperature_k = 4000, .x = { 9, 0, 0 }, .v = { 0.1, 0.4, 0 } });
    dynamic = shown(p);
    assert_true(!dynamic->approximate && dynamic->bodies[0].velocity[0] == 0.1 &&
                dynamic->bodies[0].velocity[2] == 0.4);
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_defaults(&scene);
    scene.spacetime.spin = 0.5;
    assert_int_equal(kd_playground_may_show(p, &scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/spacetime/spin");
    scene.spacetime.spin = 0.9;
    assert_int_equal(kd_playground_may_show(p, &scene, &error), KD_OK);
    kd_dynamic_bodies_release(dynamic);
    kd_playground_destroy(p);
}

static uint32_t seed = 5;
static double chance(void)
{
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) * 0x1p-24;
}

static struct kd_debris_piece piece(double r, double phi, double z, double vr, double vphi)
{
    struct kd_debris_piece p = { .stage = KD_DEBRIS_LEAVES };
    p.x[0] = r * cos(phi);
    p.x[1] = r * sin(phi);
    p.x[2] = z;
    p.v[0] = vr * cos(phi) - vphi * sin(phi);
    p.v[1] = vr * sin(phi) + vphi * cos(phi);
    return p;
}

static struct kd_dynamic_bodies *grid_of(const struct kd_debris_piece *pieces, size_t n, double worth)
{
    const float worths[KD_DEBRIS_SOURCES] = { (float)worth };
    struct kd_show_place *places = malloc(n * sizeof *places);
    struct kd_dynamic_bodies_debris grid;
    struct kd_dynamic_bodies *dynamic;
    assert_non_null(places);
    kd_show_places(pieces, n, places);
    kd_show_grid(places, n, &grid);
    assert_int_equal(kd_dynamic_bodies_create(0, grid.rows, grid.columns, &dynamic, NULL), KD_OK);
    grid.nodes = dynamic->debris.nodes;
    dynamic->debris = grid;
    kd_show_share_out(pieces, places, n, worths, false, &dynamic->debris);
    free(places);
    return dynamic;
}

struct sums { double worth, r, phi; };
static struct sums sums_of(const struct kd_dynamic_bodies_debris *d)
{
    struct sums s = { 0 };
    for (size_t i = 0; i < (size_t)d->rows * d->columns; i++) {
        s.worth += d->nodes[3 * i];
        s.r += d->nodes[3 * i + 1];
        s.phi += d->nodes[3 * i + 2];
    }
    return s;
}

/* The grid neither loses nor adds any debris, whatever its shape: a stream across azimuth 0, a ring, or a cloud, all
 * within the plane. */
static void debris_is_all_there(void **state)
{
    (void)state;
    enum { N = 200000 };
    struct kd_debris_piece *pieces = calloc(N, sizeof *pieces);
    assert_non_null(pieces);
    for (int shape = 0; shape < 5; shape++) {
        const size_t n = shape == 4 ? 7 : N;
        double vr = 0, vphi = 0;
        size_t free_ = 0;
        for (size_t i = 0; i < n; i++) {
            const double t = chance(), noise = chance() - 0.5, u = 0.2 * chance(), w = 0.3 - 0.6 * chance();
            switch (shape) {
            case 0: pieces[i] = piece(40 + 200 * t, -0.4 + 0.9 * t + 1e-3 * noise, 0.01 * noise, u, w); break;
            case 1: pieces[i] = piece(60 + noise, 2 * M_PI * t, noise, u, w); break;
            case 2: pieces[i] = piece(50 + noise, 3.14 + 0.01 * (t - 0.5), 0, u, w); break;
            case 3: pieces[i] = piece(2.1 * pow(1e5, t), 2 * M_PI * chance(), 0, u, w); break;
            default: pieces[i] = piece(1e5 * t + 3, 6 * noise, 0, u, w); break;
            }
            if (i % 10 == 3) {
                pieces[i].stage = KD_DEBRIS_FREE;
                free_++;
                continue;
            }
            vr += u;
            vphi += w;
        }
        struct kd_dynamic_bodies *dynamic = grid_of(pieces, n, 1.0 / N);
        const struct kd_dynamic_bodies_debris *d = &dynamic->debris;
        const struct sums s = sums_of(d);
        printf("shape %d: %u rows of %u of %u a turn\n", shape, d->rows, d->columns, d->turn);
        assert_int_equal(d->pieces, n - free_);
        assert_int_equal(d->hidden, 0);
        assert_true((size_t)d->rows * d->columns <= KD_SHOW_NODES && d->rows >= 2 && d->columns >= 2);
        const double all = (double)(n - free_) / N;
        assert_true(fabs(s.worth / all - 1) < 1e-4 && fabs(s.phi - vphi / N) < 1e-4 * all);
        if (shape != 1) /* skipped for the thick ring, because off the plane e_r is not parallel to it */
            assert_true(fabs(s.r / (vr / N) - 1) < 1e-3);
        kd_dynamic_bodies_release(dynamic);
    }
    free(pieces);
}

/* A single piece is at the right place: the centroid of its four nodes. */
static void a_piece_is_at_its_place(void **state)
{
    (void)state;
    for (int k = 0; k < 200; k++) {
        const double r = 3 * pow(1000, chance()), phi = 2 * M_PI * (k < 20 ? 1 - 1e-4 * k : chance());
        const struct kd_debris_piece one = piece(r, phi, 0, 0, 0);
        struct kd_dynamic_bodies *dynamic = grid_of(&one, 1, 1);
        const struct kd_dynamic_bodies_debris *d = &dynamic->debris;
        const double cell = 2 * M_PI / d->turn;
        double row = 0, x = 0, y = 0;
        for (uint32_t i = 0; i < d->rows * d->columns; i++) {
            const double at = cell * (d->first_column + i % d->columns);
            row += d->nodes[3 * i] * (d->first_row + i / d->columns);
            x += d->nodes[3 * i] * cos(at);
            y += d->nodes[3 * i] * sin(at);
        }
        assert_true(fabs(cell * row - log(r)) < 1e-2 * cell);
        assert_true(fabs(remainder(atan2(y, x) - phi, 2 * M_PI)) < 2e-2 * cell);
        kd_dynamic_bodies_release(dynamic);
    }
}

/* A torn star is complete on the grid, whatever the number of pieces. Settings of its appearance do not change how it
 * moves. */
static void a_star_is_shown(void **state)
{
    (void)state;
    struct kd_playground *p = playground_read("{\"preset\":\"disruption\"}");
    struct kd_playground_params looks = p->params;
    struct kd_error error = { 0 };
    playground_advance(p, 2600); /* from now on only a part of the star is left */
    const double rate = p->rate;
    looks.debris_depth = 3;
    looks.debris_temperature_k = 7000;
    assert_int_equal(kd_playground_set(p, &looks, &error), KD_OK);
    assert_true(p->rate == rate && rate > 0);
    looks.debris_per_body = 500; /* applies only to pieces that are torn off from now on */
    assert_int_equal(kd_playground_set(p, &looks, &error), KD_OK);
    struct kd_dynamic_bodies *dynamic = shown(p);
    const struct sums s = sums_of(&dynamic->debris);
    printf("%u pieces on %u rows of %u of %u a turn, %g of the star, |z|/r %.2g\n", dynamic->debris.pieces,
           dynamic->debris.rows, dynamic->debris.columns, dynamic->debris.turn, s.worth, dynamic->debris.thick);
    assert_int_equal(dynamic->debris.pieces, p->debris.alive);
    assert_true(fabs(s.worth - p->debris.alive / 50000.0) < 1e-4 && s.worth > 0.4 && s.worth < 0.7);
    assert_true(dynamic->debris.depth == 3 && dynamic->debris.temperature_k == 7000 && dynamic->time == p->t);
    kd_dynamic_bodies_release(dynamic);
    kd_playground_destroy(p);
}

static double width_of(const struct kd_playground *p)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_defaults(&scene);
    assert_int_equal(kd_playground_widen(p, &scene, &error), KD_OK);
    return scene.camera.field_m;
}

/* The view is 2.4 times as wide as the distance of the farthest body, or as the radius that contains nine in ten pieces
 * of debris, if that is larger. */
static void a_view_is_as_wide_as_what_there_is(void **state)
{
    (void)state;
    struct kd_playground *p = playground_make(playground_quiet());
    struct kd_scene usual;
    kd_scene_defaults(&usual);
    assert_true(width_of(p) == usual.camera.field_m);
    playground_put(p, (struct kd_playground_body) { .mass = 1e-6, .radius = 2, .x = { 0, 300, 400 } });
    assert_true(fabs(width_of(p) / (2.4 * 502) - 1) < 1e-8);
    kd_playground_destroy(p);

    p = playground_read("{\"preset\":\"disruption\",\"debris_per_body\":2000}");
    playground_advance(p, 12000);
    assert_true(p->n == 0 && p->debris.alive > 1000);
    const double width = width_of(p);
    size_t within = 0, nearer = 0;
    for (uint32_t i = 0; i < p->debris.used; i++) {
        const double r = kd_playground_radius(p->debris.pieces[i].x) / (width / 2.4);
        within += p->debris.pieces[i].stage != KD_DEBRIS_FREE && r <= 1;
        nearer += p->debris.pieces[i].stage != KD_DEBRIS_FREE && r <= 0.985;
    }
    printf("a view of a torn star is %.4g M wide, and %.3f of it are within 1/2.4 of that, %.3f within 0.985 of it\n",
           width, (double)within / p->debris.alive, (double)nearer / p->debris.alive);
    assert_true(width > 2 * usual.camera.field_m && within >= 0.9 * p->debris.alive && nearer < 0.9 * p->debris.alive);
    kd_playground_destroy(p);
}

/* Pieces that are torn off keep their weight when another number of pieces is set for later bodies. This holds in a
 * snapshot, too, and for the pieces of each of two stars. */
static void a_piece_keeps_its_worth(void **state)
{
    (void)state;
    struct kd_playground *p = playground_read("{\"preset\":\"disruption\",\"debris_per_body\":4000}"), *q;
    struct kd_error error = { 0 };
    struct kd_buffer text = { 0 };
    playground_advance(p, 5000);
    assert_int_equal(p->n, 0);
    const double first = p->debris.alive / 4000.0;
    struct kd_playground_params params = p->params;
    params.debris_per_body = 500;
    assert_int_equal(kd_playground_set(p, &params, &error), KD_OK);
    struct kd_dynamic_bodies *dynamic = shown(p);
    assert_true(fabs(sums_of(&dynamic->debris).worth - first) < 1e-4 && first > 0.9);
    kd_dynamic_bodies_release(dynamic);
    const uint32_t before = p->debris.alive;
    playground_put(
        p, (struct kd_playground_body) { .mass = 1e-6, .radius = 0.47, .x = { 0, 60, 0 }, .v = { 0.15, -0.03, 0 } });
    for (int i = 0; p->n && i < 300; i++)
        playground_advance(p, 5);
    assert_int_equal(p->debris.last_source, 2);
    assert_int_equal(kd_playground_write(p, true, &text), KD_OK);
    assert_int_equal(kd_playground_read((const char *)text.data, text.size, &q, &error), KD_OK);
    dynamic = shown(q);
    uint32_t of[2] = { 0, 0 };
    for (uint32_t i = 0; i < q->debris.used; i++)
        of[q->debris.pieces[i].source - 1] += q->debris.pieces[i].stage != KD_DEBRIS_FREE;
    assert_true(of[0] <= before && of[1] > 100);
    assert_true(fabs(sums_of(&dynamic->debris).worth - of[0] / 4000.0 - of[1] / 500.0) < 1e-3);
    kd_dynamic_bodies_release(dynamic);
    kd_buffer_finish(&text);
    kd_playground_destroy(p);
    kd_playground_destroy(q);
}

/* Pieces without a valid place are counted as hidden, and leave no NaN. */
static void nowhere(void **state)
{
    (void)state;
    struct kd_debris_piece pieces[7] = { piece(10, 1, 0, 0, 0),  piece(20, 2, 0, 0, 0), piece(1, 0, 0, 0, 0),
                                         piece(5, 0, 0, 0, 0),   piece(6, 0, 0, 0, 0),  piece(7, 0, 0, 0, 0),
                                         piece(1e-9, 0, 0, 0, 0) };
    pieces[2].x[0] = pieces[2].x[1] = 0; /* on the axis */
    pieces[3].x[1] = NAN;
    pieces[4].x[0] = INFINITY;
    pieces[5].x[2] = 1e20;
    struct kd_dynamic_bodies *dynamic = grid_of(pieces, 7, 1);
    assert_int_equal(dynamic->debris.pieces + dynamic->debris.hidden, 7);
    assert_true(dynamic->debris.pieces == 2 && fabs(sums_of(&dynamic->debris).worth - 2) < 1e-5);
    kd_dynamic_bodies_release(dynamic);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies),
        cmocka_unit_test(debris_is_all_there),
        cmocka_unit_test(a_piece_is_at_its_place),
        cmocka_unit_test(a_star_is_shown),
        cmocka_unit_test(a_piece_keeps_its_worth),
        cmocka_unit_test(nowhere),
        cmocka_unit_test(a_view_is_as_wide_as_what_there_is),
    };
    return cmocka_run_group_tests_name("playground_show", tests, NULL, NULL);
}
