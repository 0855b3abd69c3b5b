/* Tests of bodies with gravity "kerr", compared with the closed form of bound orbits (physics/orbit/orbit_bound.h),
 * which does not integrate in steps. Also tests that a snapshot continues to the bit. */
#include "playground_support.h"

#include "physics/orbit/orbit_bound.h"
#include "physics/spacetime/hole.h"

#include <stdio.h>
#include <stdlib.h>

/* A body starts with the velocity v measured by an observer of zero angular momentum, and moves for a hundred radial
 * periods. At a thousand times its place is compared with the closed form. Bisection finds the Mino time of each
 * of these times. */
static void test_bodies_follow_the_closed_form(void **state)
{
    (void)state;
    static const struct {
        double spin, charge, x[3], v[3];
    } cases[] = {
        { 0.9, 0, { 10, 0, 0 }, { 0, 0.36, 0 } },          { 0.9, 0, { 6, 0, 2 }, { 0.1, 0.4, 0.2 } },
        { -0.5, 0, { 0, 20, 3 }, { -0.22, 0.02, 0.1 } },   { 0, 0, { 12, 3, 0 }, { 0, 0.34, 0.1 } },
        { 0, 0.9, { 8, 0, 0 }, { 0, 0.36, 0.1 } },         { 0.6, 0.75, { 6, 0, 2 }, { 0.1, 0.38, 0.2 } },
        { -0.7, 0.7, { 0, 20, 3 }, { -0.22, 0.02, 0.1 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_playground_params params = playground_quiet();
        struct kd_error error = { 0 };
        params.gravity = KD_GRAVITY_KERR;
        params.spin = cases[i].spin;
        params.charge = cases[i].charge;
        params.h_max = 10;
        struct kd_playground *p = playground_make(params);
        struct kd_playground_body body = { .mass = 1e-6 };
        memcpy(body.x, cases[i].x, sizeof body.x);
        memcpy(body.v, cases[i].v, sizeof body.v);
        playground_put(p, body);
        const struct kd_playground_spherical from = kd_playground_spherical(body.x, body.v);
        struct kd_orbit orbit;
        struct kd_orbit_state start;
        if (kd_orbit_from_state(kd_playground_hole(&params), from.r, from.theta * 180 / M_PI, KD_OBSERVER_ZAMO, from.v,
                                &orbit, &start, &error))
            fail_msg("%s", error.message);
        assert_int_equal(orbit.fate, KD_ORBIT_BOUND);
        const struct kd_orbit_bound bound = kd_orbit_bound_of(&orbit, &start);
        const struct kd_orbit_frequencies f = kd_orbit_frequencies_of(&bound);
        const double end = 100 * 2 * M_PI / f.r;
        double worst = 0, mino = 0;
        for (int k = 0; k < 1000; k++) {
            playground_advance(p, end / 1000);
            double low = mino, high = mino + 4 * end / 1000 / f.mino_t + 1e-3;
            while (high - low > 1e-15 * high && 0.5 * (low + high) > low && 0.5 * (low + high) < high) {
                const double middle = 0.5 * (low + high);
                *(kd_orbit_bound_at(&bound, middle).t < p->t ? &low : &high) = middle;
            }
            mino = high;
            const struct kd_orbit_place at = kd_orbit_bound_at(&bound, mino);
            const double phi = from.phi + at.phi, s = at.r * sin(at.theta),
                         want[3] = { s * cos(phi), s * sin(phi), at.r * cos(at.theta) };
            for (int n = 0; n < 3; n++)
                worst = fmax(worst, fabs(p->bodies[0].x[n] - want[n]) / at.r);
        }
        print_message("spin %g, charge %g: t = %.4g, worst %.2g\n", params.spin, params.charge, p->t, worst);
        assert_true(worst < 1e-8);
        kd_playground_destroy(p);
    }
}

/* A start from the reported velocity gives the same motion. */
static void the_velocity_told_begins_the_same_motion(void **state)
{
    (void)state;
    struct kd_playground *p = playground_read("{\"gravity\":\"kerr\",\"spin\":0.8,\"h_max\":1,\"bodies\":[{"
                                              "\"position\":[9,1,2],\"velocity\":[-0.05,0.3,0.1]}]}");
    playground_advance(p, 137);
    struct kd_playground *q = playground_read("{\"gravity\":\"kerr\",\"spin\":0.8,\"h_max\":1}");
    playground_put(q, p->bodies[0]);
    playground_advance(p, 500);
    playground_advance(q, 500);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(p->bodies[0].x[k] - q->bodies[0].x[k]) < 1e-8);
    kd_playground_destroy(p);
    kd_playground_destroy(q);
}

/* Bodies that fall in or fly away are reported. No body reaches the speed of light. */
static void who_leaves_is_told(void **state)
{
    (void)state;
    struct kd_playground *p = playground_read(
        "{\"gravity\":\"kerr\",\"spin\":0.5,\"h_max\":1e5,\"budget\":10000000,\"bodies\":[{\"position\":[9,0,0],"
        "\"velocity\":[-0.5,0,0]},"
        "{\"position\":[0,30,0],\"velocity\":[0,0.9,0]},{\"position\":[0,0,40],\"velocity\":[0.1,0.01,0]}]}");
    struct kd_error error = { 0 };
    playground_advance(p, 3e6);
    assert_int_equal(p->n, 1);
    assert_int_equal(p->events.last, 2);
    unsigned kinds = 0;
    for (uint64_t k = 1; k <= 2; k++)
        kinds |= 1u << kd_playground_event_at(&p->events, k)->kind;
    assert_int_equal(kinds, 1u << KD_PLAYGROUND_CAPTURED | 1u << KD_PLAYGROUND_ESCAPE);
    const struct kd_playground_body fast = { .x = { 10, 0, 0 }, .v = { 0, 1, 0 } }, inside = { .x = { 1, 0, 0 } };
    assert_int_equal(kd_playground_add(p, &fast, NULL, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/velocity");
    assert_int_equal(kd_playground_add(p, &inside, NULL, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/position");
    kd_playground_destroy(p);
}

/* A body that starts on a circle, next to one, or at a turning point up to rounding, is never refused. The middle of
 * the motion is the maximum of W. There W gives the rate of oscillation. The cubic part of W changes this rate by the
 * square of the width. */
static void circles_are_no_refusals(void **state)
{
    (void)state;
    uint32_t seed = 1;
    double u[6], worst = 0;
    for (int k = 0; k < 8000; k++) {
        for (int i = 0; i < 6; i++)
            u[i] = (seed = seed * 1664525u + 1013904223u) * 0x1p-32;
        const double spin = 1.99 * u[0] - 0.995, r = k % 3 ? 8 + 30 * u[1] : 12, phi = 2 * M_PI * u[2],
                     tilt = M_PI * u[3];
        const double v = k % 5 ? (1 + (k % 2) * pow(10, -1 - 14 * u[4])) / sqrt(r - 2) : 0.3;
        const double x[3] = { r * cos(phi), r * sin(phi) * cos(tilt), r * sin(phi) * sin(tilt) };
        const double to[3] = { -v * sin(phi), v * cos(phi) * cos(tilt), v * cos(phi) * sin(tilt) };
        struct kd_playground_geodesic g;
        struct kd_error error = { 0 };
        if (kd_geodesic_begin(&g, kd_hole(spin), x, to, 0, &error))
            fail_msg("spin %.17g, x %.17g %.17g %.17g, v %.17g %.17g %.17g: %s", spin, x[0], x[1], x[2], to[0], to[1],
                     to[2], error.message);
        const struct kd_orbit *o = &g.path.orbit;
        const double middle = 0.5 * (o->w_low + o->w_high), width = (o->w_high - o->w_low) / middle;
        if (o->fate == KD_ORBIT_BOUND && width < 1e-6)
            worst = fmax(worst, fabs(kd_orbit_radial_slope(o, middle) / (2 * o->w[2] * middle)));
    }
    print_message("the middle of circles all but is off by %.2g\n", worst);
    assert_true(worst < 1e-11);
}

/* On the circle of r = 12 of a hole without spin the azimuth is t sqrt(r - q^2)/r^2. It is exact also at the times when
 * steps end, of which there are 256 in a turn. */
static void circles_go_round_evenly(void **state)
{
    (void)state;
    static const double charges[] = { 0, 0.9 };
    for (int i = 0; i < 2; i++) {
        const double q2 = charges[i] * charges[i], r = 12, rate = sqrt(r - q2) / (r * r), step = 2 * M_PI / rate / 256;
        struct kd_playground_params params = playground_quiet();
        params.gravity = KD_GRAVITY_KERR;
        params.charge = charges[i];
        params.h_max = 100;
        struct kd_playground *p = playground_make(params);
        playground_put(p, (struct kd_playground_body) {
                              .x = { r }, .v = { 0, r * rate / sqrt(1 - 2 / r + q2 / (r * r)) }, .mass = 1e-6 });
        for (int k = 1; k <= 400; k++) {
            playground_advance(p, k * step - p->t);
            assert_true(hypot(p->bodies[0].x[0] - r * cos(rate * p->t), p->bodies[0].x[1] - r * sin(rate * p->t)) <
                        1e-9);
        }
        kd_playground_destroy(p);
    }
}

/* If the budget ends within a stride, all bodies are where they were at the beginning of the stride, at one common
 * time. After further calls, also from a snapshot, the state equals bit by bit that of a single call with enough
 * budget. A call takes at most the budget's number of steps, however long a stride is. */
static void bodies_are_at_one_time(void **state)
{
    (void)state;
    const char *text =
        "{\"gravity\":\"kerr\",\"spin\":0.9,\"h_max\":500,\"budget\":100000000,\"bodies\":[{\"position\":[9,1,2],"
        "\"velocity\":[-0.05,0.3,0.1]},"
        "{\"position\":[0,12,0],\"velocity\":[-0.3,-0.05,0.1]},{\"position\":[0,0,30],\"velocity\":[0.1,0.15,0]}]}";
    struct kd_playground *p = playground_read(text), *q = playground_read(text), *single[3];
    struct kd_playground_progress progress;
    struct kd_error error = { 0 };
    playground_advance(p, 2000);
    q->params.budget = 37; /* less than a stride takes */
    for (int k = 0; q->t < 2000; k++) {
        const double t = q->t, x = q->bodies[2].x[0];
        kd_playground_advance(q, 2000 - q->t, &progress);
        assert_true(progress.slowed || q->t == 2000);
        assert_true(q->t > t || q->bodies[2].x[0] == x);
        if (k % 50 == 0) { /* the reference is a playground that has enough budget up to this time */
            struct kd_playground *whole = playground_read(text);
            playground_advance(whole, q->t);
            assert_true(whole->t == q->t && whole->n == 3 && q->n == 3);
            for (int i = 0; i < 3; i++)
                assert_memory_equal(whole->bodies[i].x, q->bodies[i].x, sizeof q->bodies[i].x);
            kd_playground_destroy(whole);
        }
        if (k % 7 == 3) {
            struct kd_buffer out = { 0 };
            assert_int_equal(kd_playground_write(q, true, &out), KD_OK);
            kd_playground_destroy(q);
            assert_int_equal(kd_playground_read((const char *)out.data, out.size, &q, &error), KD_OK);
            kd_buffer_finish(&out);
        }
    }
    /* A stride is interrupted in the middle, and then a shorter time is requested: the playground must not go farther
     * than that time. */
    struct kd_playground_run run;
    const double before = q->t;
    q->params.budget = 100000000;
    kd_playground_begin(q, 500, &run);
    assert_true(kd_playground_go_on(q, &run, 1) && q->t == before && q->aim > before + 1);
    kd_playground_advance(q, 1e-3, &progress);
    assert_true(!progress.slowed && progress.done <= progress.asked && q->t == before + 1e-3);
    playground_advance(p, q->t - p->t);
    assert_true(p->t == q->t);
    for (int i = 0; i < 3; i++) { /* each body is where it would be alone */
        single[i] = playground_read("{\"gravity\":\"kerr\",\"spin\":0.9,\"h_max\":500,\"budget\":100000000}");
        struct kd_playground *begun = playground_read(text);
        playground_put(single[i], begun->bodies[i]);
        kd_playground_destroy(begun);
        playground_advance(single[i], q->t);
        for (int k = 0; k < 3; k++)
            assert_true(p->bodies[i].x[k] == q->bodies[i].x[k] && p->bodies[i].x[k] == single[i]->bodies[0].x[k] &&
                        p->bodies[i].v[k] == q->bodies[i].v[k]);
        kd_playground_destroy(single[i]);
    }
    unsigned pieces = 1;
    kd_playground_begin(q, 500, &run);
    for (uint32_t left = run.left; kd_playground_go_on(q, &run, 1); left = run.left, pieces++)
        assert_true(left - run.left <= 256);
    assert_true(pieces > 3);
    kd_playground_destroy(p);
    kd_playground_destroy(q);
}

/* The playground's time has a largest value. Reaching it is reported, and no snapshot may exceed it. */
static void time_has_an_end(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "{\"h_max\":1000000}",
        "{\"h_max\":1000000,\"gravity\":\"kerr\",\"bodies\":[{\"position\":[900000,0,0],\"velocity\":[0,0.00105,0]}]}"
    };
    for (int i = 0; i < 2; i++) {
        struct kd_playground *p = playground_read(texts[i]), *q;
        struct kd_playground_progress progress;
        struct kd_error error = { 0 };
        p->t = KD_PLAYGROUND_TIME - 3e6;
        if (i)
            p->geodesics[0].from_t = p->t;
        kd_playground_advance(p, 1e12, &progress);
        assert_true(progress.slowed && progress.ended && p->t >= KD_PLAYGROUND_TIME &&
                    p->t <= KD_PLAYGROUND_TIME + 1e6);
        struct kd_buffer out = { 0 };
        assert_int_equal(kd_playground_write(p, true, &out), KD_OK);
        assert_int_equal(kd_playground_read((const char *)out.data, out.size, &q, &error), KD_OK);
        kd_playground_destroy(q);
        p->t = 1e300;
        out.size = 0;
        assert_int_equal(kd_playground_write(p, true, &out), KD_OK);
        assert_int_equal(kd_playground_read((const char *)out.data, out.size, &q, &error), KD_EINVAL);
        assert_string_equal(error.pointer, "/state/t");
        assert_non_null(strstr(error.message, "must be"));
        kd_buffer_finish(&out);
        kd_playground_destroy(p);
    }
}

static struct kd_buffer snapshot(struct kd_playground *p)
{
    struct kd_buffer out = { 0 };
    assert_int_equal(kd_playground_write(p, true, &out), KD_OK);
    return out;
}

/* A snapshot is taken, the playground goes on, and a second one is taken. A playground that continues from the first
 * snapshot must give the same bytes as the second. This is tested in the middle of shedding, of an inspiral, and of
 * geodesics. */
static void snapshots_start_again_to_the_bit(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double first, then;
    } cases[] = {
        { "{\"preset\":\"disruption\",\"debris_per_body\":300,\"debris_capacity\":250}", 2600, 400 },
        { "{\"preset\":\"disruption\",\"debris_per_body\":200000,\"debris_capacity\":200000,\"h_max\":100}", 2760,
          60 }, /* with debris, which limits the step */
        { "{\"preset\":\"binary\"}", 3000, 4000 },
        { "{\"preset\":\"system\",\"waves\":true,\"amplification\":10}", 100, 100 },
        { "{\"gravity\":\"kerr\",\"spin\":0.9,\"charge\":0.4,\"bodies\":[{\"position\":[9,1,2],\"velocity\":[-0.05,0.3,"
          "0.1]},{\"position\":[0,12,0],\"velocity\":[-0.4,-0.25,0.1]}]}",
          25, 40 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_playground *p = playground_read(cases[i].text), *q;
        struct kd_error error = { 0 };
        playground_advance(p, cases[i].first);
        struct kd_buffer middle = snapshot(p);
        if (kd_playground_read((const char *)middle.data, middle.size, &q, &error))
            fail_msg("case %zu: %s (at %s)", i, error.message, error.pointer);
        struct kd_buffer again = snapshot(q);
        assert_int_equal(again.size, middle.size);
        assert_memory_equal(again.data, middle.data, middle.size);
        playground_advance(p, cases[i].then);
        playground_advance(q, cases[i].then);
        struct kd_buffer one = snapshot(p), other = snapshot(q);
        assert_int_equal(one.size, other.size);
        assert_memory_equal(one.data, other.data, one.size);
        kd_buffer_finish(&middle);
        kd_buffer_finish(&again);
        kd_buffer_finish(&one);
        kd_buffer_finish(&other);
        kd_playground_destroy(p);
        kd_playground_destroy(q);
    }
}

/* A snapshot with one byte changed is refused, or gives a playground that stays finite. */
static void damaged_snapshots_do_no_harm(void **state)
{
    (void)state;
    struct kd_playground *p =
        playground_read("{\"preset\":\"disruption\",\"debris_per_body\":100,\"debris_capacity\":90}");
    playground_advance(p, 2600);
    struct kd_buffer whole = snapshot(p);
    unsigned read = 0;
    for (size_t at = 0; at < whole.size; at += 7) {
        const uint8_t kept = whole.data[at];
        struct kd_playground *q = NULL;
        struct kd_playground_progress progress;
        whole.data[at] = (uint8_t)"9.-e,A/"[at % 7];
        if (!kd_playground_read((const char *)whole.data, whole.size, &q, NULL)) {
            q->params.budget = 5;
            kd_playground_advance(q, 5, &progress);
            for (size_t k = 0; k < q->n; k++)
                assert_true(isfinite(q->bodies[k].x[0]) && isfinite(q->bodies[k].v[1]));
            read++;
        }
        kd_playground_destroy(q);
        whole.data[at] = kept;
    }
    assert_true(read > 10);
    kd_buffer_finish(&whole);
    kd_playground_destroy(p);
}

static void refuse(struct kd_playground **p, const char *text, const char *pointer)
{
    struct kd_error error = { 0 };
    const enum kd_status status =
        *p ? kd_playground_patch(p, text, strlen(text), &error) : kd_playground_read(text, strlen(text), p, &error);
    assert_int_equal(status, KD_EINVAL);
    assert_string_equal(error.pointer, pointer);
}

static void documents_are_checked_and_changes_are_whole(void **state)
{
    (void)state;
    struct kd_playground *none = NULL;
    refuse(&none, "[]", "");
    refuse(&none, "{\"gravity\":\"newton\"}", "/gravity");
    refuse(&none, "{\"softening\":0}", "/softening");
    refuse(&none, "{\"preset\":\"chaos\"}", "/preset");
    refuse(&none, "{\"colour\":1}", "/colour");
    refuse(&none, "{\"bodies\":[{\"mass\":1}]}", "/bodies/0");
    refuse(&none, "{\"bodies\":[{\"position\":[10,0,0],\"mass\":1e-40}]}", "/bodies/0/mass");
    refuse(&none, "{\"bodies\":[{\"position\":[10,0,0],\"radius\":1e-320}]}", "/bodies/0/radius");
    refuse(&none, "{\"bodies\":[{\"position\":[10,0,0]},{\"position\":[1,1,1]}]}", "/bodies/1/position");
    refuse(&none, "{\"bodies\":[{\"position\":[10,0,0],\"velocity\":[0.9,0.9,0]}]}", "/bodies/0/velocity");
    struct kd_playground *p = playground_read("{\"preset\":\"system\"}");
    struct kd_error error = { 0 };
    refuse(&p, "{\"waves\":true,\"add\":[{\"position\":[40,0,0]}],\"remove\":[99]}", "/remove/0");
    refuse(&p, "{\"change\":[{\"id\":2,\"mass\":-1}]}", "/change/0/mass");
    refuse(&p, "{\"spin\":0.5}", "/spin");
    assert_int_equal(p->n, 6);
    assert_false(p->params.waves);
    const char *good = "{\"waves\":true,\"add\":[{\"position\":[40,0,0],\"name\":\"new\"}],\"change\":[{\"id\":2,"
                       "\"mass\":0.5}],\"remove\":[1]}";
    assert_int_equal(kd_playground_patch(&p, good, strlen(good), &error), KD_OK);
    assert_int_equal(p->n, 6);
    assert_true(p->params.waves && kd_playground_find(p, 2)->mass == 0.5 && !kd_playground_find(p, 1));
    assert_string_equal(kd_playground_find(p, 7)->name, "new");
    kd_playground_destroy(p);
    /* A star that is being torn at its periastron continues to be torn when its temperature is changed. A snapshot
     * contains the energy that new bodies added. */
    p = playground_read("{\"preset\":\"disruption\",\"debris_per_body\":1000}");
    playground_advance(p, 2600);
    const double shed = p->bodies[0].shed;
    const char *warm = "{\"change\":[{\"id\":1,\"temperature_k\":9000}]}",
               *more = "{\"add\":[{\"position\":[500,0,0],\"mass\":0.001}]}";
    assert_int_equal(kd_playground_patch(&p, warm, strlen(warm), &error), KD_OK);
    assert_true(shed > 0 && p->bodies[0].shed == shed && p->bodies[0].whole_mass == 1e-6);
    assert_int_equal(kd_playground_patch(&p, more, strlen(more), &error), KD_OK);
    struct kd_buffer out = snapshot(p);
    assert_true(fabs(p->spent.given + 0.001 / 498) < 1e-7);
    kd_buffer_finish(&out);
    kd_playground_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bodies_follow_the_closed_form),
        cmocka_unit_test(the_velocity_told_begins_the_same_motion),
        cmocka_unit_test(who_leaves_is_told),
        cmocka_unit_test(circles_are_no_refusals),
        cmocka_unit_test(circles_go_round_evenly),
        cmocka_unit_test(bodies_are_at_one_time),
        cmocka_unit_test(time_has_an_end),
        cmocka_unit_test(snapshots_start_again_to_the_bit),
        cmocka_unit_test(damaged_snapshots_do_no_harm),
        cmocka_unit_test(documents_are_checked_and_changes_are_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
