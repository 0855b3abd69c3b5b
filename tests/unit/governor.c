/* Tests of the governor and its ladder of qualities, on simulated machines that are steady, noisy, temporarily loaded,
 * recorded, or adversarial. */
#include "governor_recorded.h"
#include "governor_simulation.h"

#include "scene/dynamic_bodies.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double targets[] = { 8, 16.7, 33, 66, 100 };

static struct kd_governor_params with_target(double ms) { return *kd_governor_params(.target_ms = ms); }

static uint32_t last_rung(const struct simulation *s) { return (uint32_t)s->governor.ladder.n_rungs - 1; }

/* The ladder */

static void some_scene(struct kd_scene *scene)
{
    kd_scene_smooth(scene);
    scene->image.width = 1 + (int32_t)(uniform() * uniform() * 3000);
    scene->image.height = 1 + (int32_t)(uniform() * uniform() * 2000);
    /* rays along a side of a pixel; 0: as many rays as each pixel needs */
    scene->image.samples = (int32_t)(uniform() * 9);
    scene->accuracy.orders = 1 + (int32_t)(uniform() * 8);
    scene->accuracy.profile = (int32_t)(uniform() * 5);
    scene->accuracy.steps = uniform() < 0.2 ? 8 : 0;
    scene->accuracy.precision = uniform() < 0.2 ? 2 : 0;
    scene->accuracy.engine = uniform() < 0.2 ? 3 : 0;
    scene->volume.model = scene->image.height % 2 ? KD_VOLUME_UNIFORM : KD_VOLUME_NONE;
    if (!scene->accuracy.steps && uniform() < 0.2)
        scene->accuracy.tolerance = 1e-5;
}

static void assert_same_scene(const struct kd_scene *a, const struct kd_scene *b)
{
    struct kd_buffer text[2] = { 0 };
    assert_int_equal(kd_scene_to_json(a, &text[0]), KD_OK);
    assert_int_equal(kd_scene_to_json(b, &text[1]), KD_OK);
    assert_string_equal((char *)text[0].data, (char *)text[1].data);
    kd_buffer_finish(&text[0]);
    kd_buffer_finish(&text[1]);
}

static int rank(int samples) { return samples ? samples : 9; }

/* Checks the order of qualities: a quality is reduced only after all qualities before it are reduced. */
static void assert_order(const struct kd_quality *before, const struct kd_quality *after)
{
    bool scale = after->scale < before->scale, samples = rank(after->samples) < rank(before->samples);
    bool orders = after->orders < before->orders, profile = after->profile != before->profile;
    assert_int_equal(scale + samples + orders + profile + after->sketch, 1);
    assert_true(after->scale <= before->scale && rank(after->samples) <= rank(before->samples) &&
                after->orders <= before->orders);
}

static void check_ladder(const struct kd_scene *asked, const struct kd_ladder_bounds *bounds)
{
    struct kd_ladder ladder;
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_ladder_make(asked, bounds, &ladder);
    assert_in_range(ladder.n_rungs, 1, KD_LADDER_RUNGS);
    assert_in_range(ladder.n_steps, 1, KD_LADDER_STEPS);
    for (size_t i = 0; i < ladder.n_rungs; i++) {
        const struct kd_quality *q = &ladder.rungs[i].quality;
        kd_quality_apply(q, asked, &scene);
        if (kd_scene_validate(&scene, &error))
            fail_msg("rung %zu: %s", i, error.message);
        assert_int_equal(scene.image.width, q->width);
        assert_int_equal(scene.image.height, q->height);
        assert_int_equal(q->final, i == 0);
        assert_true(i == 0 || q->width >= bounds->width || q->scale == 1);
        assert_true(q->scale >= bounds->scale);
        assert_true(q->samples >= bounds->samples || q->samples == asked->image.samples || !asked->image.samples);
        assert_true(q->orders >= bounds->orders || q->orders == asked->accuracy.orders);
        assert_true(q->profile < 0 || q->profile >= bounds->profile);
        assert_int_equal(q->sketch, i + 1 == ladder.n_rungs && asked->volume.model != KD_VOLUME_NONE);
        assert_int_equal(scene.accuracy.engine, asked->accuracy.engine);
        if (q->profile >= 0)
            assert_true(isinf(scene.accuracy.tolerance) && !scene.accuracy.steps && !scene.accuracy.precision);
        if (i) {
            assert_true(ladder.rungs[i].rays < ladder.rungs[i - 1].rays);
            assert_order(&ladder.rungs[i - 1].quality, q);
        }
    }
    kd_quality_apply(&ladder.rungs[0].quality, asked, &scene);
    assert_same_scene(&scene, asked);
    kd_quality_apply(&ladder.steps[ladder.n_steps - 1].quality, asked, &scene);
    assert_same_scene(&scene, asked);
    for (size_t i = 0; i < ladder.n_steps; i++) {
        assert_int_equal(ladder.steps[i].quality.final, i + 1 == ladder.n_steps);
        assert_true(ladder.steps[i].quality.scale == 1 && !ladder.steps[i].quality.sketch);
        assert_int_equal(ladder.steps[i].quality.orders, asked->accuracy.orders);
        assert_true(i == 0 || ladder.steps[i].rays > ladder.steps[i - 1].rays);
    }
}

static void ladders_go_down_in_order_and_up_to_what_is_asked(void **state)
{
    (void)state;
    struct kd_scene asked;
    for (int i = 0; i < 3000; i++) {
        some_scene(&asked);
        if (i % 50 == 1)
            asked.image.width = asked.image.height = 1;
        struct kd_ladder_bounds bounds = KD_LADDER_BOUNDS_DEFAULT;
        bounds.scale = (double[]) { 0.25, 0.5, 1 }[i % 3];
        bounds.width = i % 2 ? 0 : 160;
        bounds.samples = 1 + (int32_t)(uniform() * 3);
        bounds.orders = 1 + (int32_t)(uniform() * 3);
        check_ladder(&asked, &bounds);
    }
    kd_scene_smooth(&asked);
    const struct kd_ladder_bounds bounds = KD_LADDER_BOUNDS_DEFAULT;
    struct kd_ladder ladder;
    asked.image.samples = 2;
    kd_ladder_make(&asked, &bounds, &ladder);
    static const struct {
        double scale;
        int samples, orders, profile;
    } expected[] = {
        { 1, 2, 3, -1 },
        { 1, 1, 3, -1 },
        { .75, 1, 3, -1 },
        { .625, 1, 3, -1 },
        { .5, 1, 3, -1 },
        { .375, 1, 3, -1 },
        { .25, 1, 3, -1 },
        { .25, 1, 2, -1 },
        { .25, 1, 2, KD_PROFILE_INTERACTIVE },
        { .25, 1, 2, KD_PROFILE_DRAFT },
    };
    assert_int_equal(ladder.n_rungs, sizeof expected / sizeof *expected);
    for (size_t i = 0; i < ladder.n_rungs; i++) {
        assert_true(ladder.rungs[i].quality.scale == expected[i].scale);
        assert_int_equal(ladder.rungs[i].quality.samples, expected[i].samples);
        assert_int_equal(ladder.rungs[i].quality.orders, expected[i].orders);
        assert_int_equal(ladder.rungs[i].quality.profile, expected[i].profile);
    }
    assert_int_equal(ladder.rungs[4].quality.width, 640);
    assert_int_equal(ladder.rungs[4].quality.height, 360);
    asked.camera.projection = KD_PROJECTION_RING; /* the picture has as many photon rings (image orders) as requested */
    asked.accuracy.orders = 7;
    kd_ladder_make(&asked, &bounds, &ladder);
    for (size_t i = 0; i < ladder.n_rungs; i++)
        assert_int_equal(ladder.rungs[i].quality.orders, 7);
    asked.camera.projection = KD_PROJECTION_AUTO;
    kd_ladder_make(&asked, &bounds, &ladder);
    assert_int_equal(ladder.rungs[ladder.n_rungs - 1].quality.orders, 2);
    asked.accuracy.orders = 3;
    kd_ladder_make(&asked, &bounds, &ladder);
    const size_t without = ladder.n_rungs;
    asked.volume.model = KD_VOLUME_UNIFORM;
    kd_ladder_make(&asked, &bounds, &ladder);
    assert_int_equal(ladder.n_rungs, without + 1);
    assert_true(ladder.rungs[without].quality.sketch && ladder.rungs[without].quality.profile == KD_PROFILE_DRAFT);
}

/* If a view with adaptive sampling is too slow, it has one ray a pixel while it moves, and all rays at rest. The scale
 * is not reduced instead. */
static void adaptive_pictures_move_with_one_ray(void **state)
{
    (void)state;
    const struct kd_ladder_bounds bounds = KD_LADDER_BOUNDS_DEFAULT;
    struct kd_scene asked, moving;
    struct kd_ladder ladder;
    kd_scene_defaults(&asked);
    asked.image.samples = 0;
    kd_ladder_make(&asked, &bounds, &ladder);
    kd_quality_apply(&ladder.rungs[1].quality, &asked, &moving);
    assert_true(ladder.rungs[0].quality.final && ladder.rungs[0].quality.samples == 0);
    assert_true(moving.image.samples == 1 && ladder.rungs[1].quality.scale == 1 && !ladder.rungs[1].quality.final);
    assert_int_equal(ladder.n_steps, 2);
    assert_true(ladder.steps[0].quality.samples == 1 && !ladder.steps[0].quality.final);
    assert_true(ladder.steps[1].quality.samples == 0 && ladder.steps[1].quality.final);
}

/* Steady machines */

/* After half a minute nothing changes any more. The target is met if the machine can meet it, and quality is not lower
 * than necessary. */
static void settles_on_a_steady_machine(void **state)
{
    (void)state;
    struct simulation s;
    int reached = 0, hopeless = 0;
    for (int i = 0; i < 600; i++) {
        double target = targets[i % 5];
        struct kd_governor_params params = with_target(target);
        enum pattern pattern = i % 2 ? DRAG : PLAY;
        begin(&s, &params, 1280, 720, some_truth());
        s.asked.image.samples = 1 + i % 3;
        run(&s, pattern, 30e3);
        uint64_t changes = s.changes;
        double mean = mean_over(&s, pattern, 60e3);
        uint32_t rung = rung_of(&s, pattern);
        double fixed = s.truth.fixed, may = may_take(target, fixed);
        assert_int_equal(s.changes, changes);
        if (rung < last_rung(&s)) {
            assert_true(mean <= 1.1001 * may);
            reached++;
        } else if (mean > 1.1 * may) {
            assert_true(true_cost(&s, last_rung(&s), pattern == PLAY) > 1.1 * (may - fixed) + fixed);
            hopeless++;
        }
        if (rung > 0) /* the governor climbs to a rung if a frame there takes at most 80 % of the target */
            assert_true(true_cost(&s, rung - 1, pattern == PLAY) - fixed > 0.8 * (may - fixed) ||
                        (pattern == PLAY && true_cost(&s, rung - 1, false) - fixed > 0.7 * s.governor.params.stall_ms));
    }
    print_message("settled below the target %d times, on the last rung above it %d times\n", reached, hopeless);
    assert_true(reached > 200 && hopeless > 20);
}

/* The governor also settles if frames report only their total time. */
static void settles_when_told_only_totals(void **state)
{
    (void)state;
    struct simulation s;
    for (int i = 0; i < 300; i++) {
        double target = targets[i % 5];
        struct kd_governor_params params = with_target(target);
        struct truth truth = some_truth();
        truth.silent = true;
        begin(&s, &params, 1280, 720, truth);
        run(&s, DRAG, 60e3);
        double mean = mean_over(&s, DRAG, 30e3);
        uint32_t rung = s.governor.paces[1].rung;
        assert_true(rung == last_rung(&s) || mean <= 1.1001 * target || s.last_change > 60e3);
        assert_true(s.changes <= 4 * s.governor.ladder.n_rungs);
    }
}

/* With an estimate before the first frame, no frame at the beginning is slow. */
static void begins_where_it_is_told_to_expect(void **state)
{
    (void)state;
    struct simulation s;
    const struct truth truth = { .traced = 400, .reused = 40, .pixels = 20 };
    begin(&s, kd_governor_params(), 1280, 720, truth);
    change(&s, true);
    const struct kd_frame_cost guess = { .rays_ms = 400, .pixels_ms = 20, .total_ms = 420 };
    kd_governor_expect(&s.governor, &guess);
    assert_true(true_cost(&s, s.governor.paces[1].rung, false) <= 33);
    assert_int_equal(s.governor.paces[0].rung, 0);
    run(&s, DRAG, 60e3);
    assert_int_equal(s.changes, 0);
    /* has no effect, because the cost has been measured already */
    kd_governor_expect(&s.governor, &(struct kd_frame_cost) { .rays_ms = 1, .total_ms = 1 });
    assert_true(s.governor.paces[1].rung > 0);
    /* The estimate for a larger picture is scaled from the cost of the smaller one. */
    s.asked.image.width *= 2;
    s.asked.image.height *= 2;
    s.truth.traced *= 4;
    s.truth.reused *= 4;
    s.truth.pixels *= 4;
    change(&s, true);
    frame(&s);
    assert_true(s.sum / (double)s.summed < 60);
    assert_true(true_cost(&s, s.governor.paces[1].rung, false) <= 33 || s.governor.paces[1].rung == last_rung(&s));
}

/* During a drag on a slow machine the governor reacts soon. */
static void two_slow_frames_are_enough(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 400, .reused = 40, .pixels = 20 });
    change(&s, true);
    frame(&s);
    assert_int_equal(s.changes, 0); /* a single slow frame may be due to the compilation of a kernel */
    change(&s, true);
    frame(&s);
    assert_int_equal(s.changes, 1);
    assert_true(true_cost(&s, s.governor.paces[1].rung, false) <= 33);
}

/* Costs that do not depend on the size */

/* Ten million particles take 220 ms, so that no size of the picture has frames of 33 ms. */
static void what_cannot_be_mended_costs_no_resolution(void **state)
{
    (void)state;
    struct simulation s;
    for (enum pattern pattern = PLAY; pattern <= DRAG; pattern++)
        for (int noisy = 0; noisy < 2; noisy++) {
            const struct truth truth = { .traced = 25,
                                         .reused = 8,
                                         .pixels = 4,
                                         .hidden = 3,
                                         .fixed = 220,
                                         .noise = noisy ? 0.25 : 0,
                                         .spikes = noisy ? 0.05 : 0,
                                         .spike = 3 };
            const struct kd_frame_cost guess = { .fixed_ms = 220, .rays_ms = 25, .pixels_ms = 4, .total_ms = 249 };
            begin(&s, kd_governor_params(), 640, 360, truth);
            change(&s, true);
            kd_governor_expect(&s.governor, &guess);
            run(&s, pattern, 600e3);
            assert_int_equal(s.changes, 0);
            assert_true(s.last.final);
        }
}

/* The part of the time that depends on the picture's size is limited to half the target or a quarter of the fixed
 * part, whichever is larger. */
static void what_can_be_mended_is(void **state)
{
    (void)state;
    struct simulation s;
    for (double fixed = 0; fixed < 1000; fixed = 1.5 * fixed + 5) {
        begin(&s, kd_governor_params(), 1280, 720,
              (struct truth) { .traced = 200, .reused = 80, .pixels = 20, .fixed = fixed });
        run(&s, DRAG, 30e3);
        double mean = mean_over(&s, DRAG, 30e3);
        assert_true(mean - fixed <= 1.1 * (may_take(33, fixed) - fixed));
        uint32_t rung = rung_of(&s, DRAG);
        assert_true(rung == 0 || true_cost(&s, rung - 1, false) - fixed > 0.8 * (may_take(33, fixed) - fixed));
        assert_true(rung > 0 || fixed > 500);
    }
}

/* Full size returns soon, however slow the first frames are. */
static void recovers_from_a_slow_beginning(void **state)
{
    (void)state;
    struct simulation s;
    for (int slow = 1; slow <= 20; slow++) {
        begin(&s, kd_governor_params(), 640, 360,
              (struct truth) { .traced = 12, .reused = 8, .pixels = 3, .hidden = 1.5, .fixed = 5 });
        change(&s, true);
        kd_governor_expect(&s.governor, &(struct kd_frame_cost) { .rays_ms = 300, .total_ms = 310 });
        s.load = 10;
        for (int i = 0; i < slow; i++)
            run(&s, DRAG, 1);
        s.load = 1;
        run(&s, DRAG, 4500); /* time of the wait after a slow frame, and of a few climbs */
        assert_int_equal(rung_of(&s, DRAG), 0);
        run(&s, PLAY, 600); /* after this time the drag counts as over */
        assert_int_equal(rung_of(&s, PLAY), 0);
        assert_true(s.last.final);
    }
}

/* Time advances for minutes, and then the view is dragged. After the drag time advances at full size again, however
 * long the time before was. */
static void a_drag_is_soon_forgotten(void **state)
{
    (void)state;
    struct simulation s;
    for (double before = 500; before < 60e3; before *= 2) {
        begin(&s, kd_governor_params(), 640, 360,
              (struct truth) { .traced = 100, .reused = 8, .pixels = 3, .fixed = 4 });
        run(&s, PLAY, before);
        run(&s, DRAG, 3e3);
        assert_true(s.last.scale < 1);
        run(&s, PLAY, 500 + (before < 2000 ? 1600 : 0));
        assert_true(s.last.scale == 1);
    }
}

/* Earlier slow frames no longer count after the number of particles has fallen to a thousandth, or after a sky, a
 * volume, turbulence or a body has been removed. */
static void another_kind_of_scene_begins_anew(void **state)
{
    (void)state;
    struct simulation s;
    for (int how = 0; how < 6; how++) {
        begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 400, .reused = 400, .pixels = 20 });
        s.asked.sky.model = KD_SKY_GRID;
        s.asked.disk.model = how == 4 ? KD_DISK_NOVIKOV_THORNE : KD_DISK_PARTICLES;
        s.asked.volume.model = how == 3 ? KD_VOLUME_UNIFORM : KD_VOLUME_NONE;
        s.asked.gas.amplitude = how == 4 ? 0.5 : 0;
        s.asked.bodies.count = how == 5;
        s.asked.bodies.at[0] = (struct kd_body) { .radius = 1, .r = 10 };
        run(&s, DRAG, 60e3);
        assert_true(s.last.scale <= 0.25);
        s.asked.volume.model = KD_VOLUME_NONE;
        s.asked.gas.amplitude = 0;
        s.asked.bodies.count = 0;
        s.asked.sky.model = how == 0 ? KD_SKY_NONE : KD_SKY_GRID;
        s.asked.disk.model = how == 1 || how == 4 ? KD_DISK_NOVIKOV_THORNE : KD_DISK_PARTICLES;
        s.asked.disk.particles = how == 2 ? 1000 : 300000;
        s.truth = (struct truth) { .traced = 12, .reused = 12, .pixels = 10 };
        run(&s, DRAG, 300);
        assert_true(s.last.final);
    }
}

/* A user drags the number of particles to and fro across a power of two. After small changes the measurements are kept.
 * A change by more than a factor of two discards them, and later changes are compared with the new number. */
static void drags_across_an_octave_go_on(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 640, 360, (struct truth) { .traced = 4, .reused = 3, .pixels = 2, .fixed = 2 });
    s.asked.disk.model = KD_DISK_PARTICLES;
    s.asked.disk.particles = 141000;
    run(&s, DRAG, 2000);
    for (int i = 0; i < 400; i++) { /* numbers of particles from 100 000 to 199 000 */
        const uint32_t before = s.governor.paces[1].count;
        s.asked.disk.particles = (uint32_t)(141000 * exp2(0.499 * sin(0.1 * i)));
        change(&s, true);
        assert_true(s.governor.paces[1].count >= before && before > 8);
        assert_true(frame(&s));
    }
    for (int i = 0, anew = 0; i <= 200; i++) { /* the number of particles grows by a factor of ten in small steps */
        s.asked.disk.particles = (uint32_t)(141000 * pow(10, i / 200.));
        change(&s, true);
        anew += !s.governor.paces[1].count;
        assert_true(frame(&s));
        if (i == 200)
            assert_int_equal(anew, 3); /* log2 of 10 */
    }
}

/* The number of bodies of a playground determines the cost of a frame, although the governor does not store the bodies.
 */
static void bodies_of_a_playground_count(void **state)
{
    (void)state;
    struct simulation s;
    struct kd_dynamic_bodies *bodies;
    struct kd_error error;
    begin(&s, kd_governor_params(), 640, 360, (struct truth) { .traced = 4, .reused = 3, .pixels = 2, .fixed = 2 });
    run(&s, DRAG, 2000);
    assert_true(s.governor.paces[1].count > 8);
    assert_false(kd_dynamic_bodies_create(1000, 0, 0, &bodies, &error));
    for (size_t i = 0; i < bodies->n; i++)
        bodies->bodies[i] = (struct kd_seen_body) { .r = 10 + (double)i, .s = 1, .radius = 1, .brightness = 1 };
    kd_scene_show(&s.asked, bodies);
    change(&s, true);
    assert_int_equal(s.governor.paces[1].count, 0);
    assert_true(frame(&s));
    change(&s, true);
    assert_int_equal(s.governor.paces[1].count, 1);
    assert_null(s.governor.asked.dynamic.at);
    kd_scene_show(&s.asked, NULL);
    kd_dynamic_bodies_release(bodies);
    change(&s, true);
    assert_int_equal(s.governor.paces[1].count, 0);
}

/* A smooth disk that rings does not move. The picture keeps its size on any machine, and regains it after a drag. */
static void what_only_rings_keeps_its_size(void **state)
{
    (void)state;
    struct simulation s;
    for (int before = 0; before < 4; before++) {
        begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 400, .reused = 300, .pixels = 60 });
        s.asked.image.samples = 2;
        if (before)
            run(&s, before == 1 ? PLAY : DRAG, 5000);
        else
            change(&s, true);
        s.now += before < 3 ? 3000 : 0; /* in the last round the scene changes just before a drag ends */
        while (before < 3 && frame(&s))
            s.now += 200;
        assert_true(s.last.final == (before < 3));
        s.asked.motion.time_rate = 8;
        change(&s, false); /* the picture does not change with time */
        assert_true(kd_governor_decide(&s.governor, s.now).wait_ms > 0);
        s.asked.style.ringdown = 1;
        for (int i = 0; i < 200; i++) {
            s.asked.top.time += 0.1;
            change(&s, false);
            assert_true(frame(&s));
            assert_true(s.last.scale == 1);
        }
        assert_int_equal(s.last.samples, 1);
        s.asked.top.time = 1e4; /* the ringing has faded */
        change(&s, false);
        s.now += 200;
        while (frame(&s))
            s.now += 200;
        assert_true(s.last.final);
        s.asked.disk.model = KD_DISK_PARTICLES; /* particles move */
        run(&s, PLAY, 5000);
        assert_true(s.last.scale < 1);
    }
}

/* A first estimate that is much too high is corrected by the first frame, before a drag begins. */
static void what_refinement_measured_is_believed(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 640, 360, (struct truth) { .traced = 18, .reused = 6, .pixels = 4 });
    change(&s, true);
    kd_governor_expect(&s.governor, &(struct kd_frame_cost) { .rays_ms = 500, .total_ms = 510 });
    frame(&s);
    assert_true(s.last.scale <= 0.25);
    s.now += 200;
    assert_true(frame(&s) && s.last.final);
    change(&s, true);
    frame(&s);
    assert_true(s.last.final);
    /* a first estimate that is much too low is also corrected */
    begin(&s, kd_governor_params(), 640, 360, (struct truth) { .traced = 180, .reused = 6, .pixels = 4 });
    change(&s, true);
    /* Nothing was rendered while the camera moved. From one frame without a cached lens map the governor learns that
     * frames must trace rays. */
    s.now += 1000;
    frame(&s);
    change(&s, true);
    frame(&s);
    assert_true(s.last.scale < 0.5);
}

/* Noise and load */

static void noise_and_spikes_change_little(void **state)
{
    (void)state;
    struct simulation s;
    uint64_t most = 0, all = 0;
    for (int i = 0; i < 200; i++) {
        double target = targets[i % 5];
        struct kd_governor_params params = with_target(target);
        struct truth truth = some_truth();
        truth.noise = 0.25;
        truth.spikes = 0.05;
        truth.spike = 10;
        begin(&s, &params, 1280, 720, truth);
        run(&s, i % 2 ? DRAG : PLAY, 30e3);
        uint64_t before = s.changes;
        run(&s, i % 2 ? DRAG : PLAY, 300e3);
        most = s.changes - before > most ? s.changes - before : most;
        all += s.changes - before;
    }
    print_message("changes in 5 minutes of noise and spikes: %.2f on average, %llu at most\n", (double)all / 200,
                  (unsigned long long)most);
    assert_true(most <= 12 && all <= 100);
}

static void load_that_comes_and_goes_is_followed(void **state)
{
    (void)state;
    struct simulation s;
    for (int i = 0; i < 200; i++) {
        struct kd_governor_params params = with_target(33);
        double load = 1.5 + 6 * uniform();
        begin(&s, &params, 1280, 720,
              (struct truth) { .traced = 14, .reused = 14, .pixels = 8 * uniform(), .hidden = 4 * uniform() });
        run(&s, DRAG, 10e3);
        assert_int_equal(s.changes, 0);
        s.load = load;
        run(&s, DRAG, 3e3); /* within three seconds */
        uint32_t rung = s.governor.paces[1].rung;
        assert_true(true_cost(&s, rung, false) <= 1.1 * 33 || rung == last_rung(&s));
        run(&s, DRAG, 30e3);
        assert_true(s.changes <= 7);
        s.load = 1;
        run(&s, DRAG, 15e3); /* the governor climbs back without further changes */
        assert_int_equal(s.governor.paces[1].rung, 0);
        run(&s, DRAG, 60e3);
        assert_true(s.changes <= 8);
    }
}

/* Machines whose costs make a simple governor oscillate */

/* A machine on which frames are fast until the governor climbs a rung, and slow while it stays there. */
static struct kd_frame_cost slow_after_each_climb(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    (void)scene, (void)reused;
    const struct kd_pace *pace = &s->governor.paces[kd_governor_decide(&s->governor, s->now).traced];
    double ms = pace->climbed || (pace->rung == 0 && !s->climbs) ? 90 : 3;
    return (struct kd_frame_cost) { .rays_ms = ms / 2, .pixels_ms = ms / 2, .total_ms = ms };
}

/* A machine like slow_after_each_climb that also slows down at a time when the governor does not climb, and so forces
 * it down a rung. */
static struct kd_frame_cost greedy(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    (void)scene, (void)reused;
    const struct kd_pace *pace = &s->governor.paces[kd_governor_decide(&s->governor, s->now).traced];
    bool can_climb = pace->rung > (s->now - pace->failed_at < pace->retry_ms ? pace->ceiling : 0);
    double ms = can_climb ? 1 : pace->rung < last_rung(s) ? 37 : 1;
    return (struct kd_frame_cost) { .rays_ms = ms / 2, .pixels_ms = ms / 2, .total_ms = ms };
}

static struct kd_frame_cost by_count(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    (void)scene, (void)reused;
    uint64_t period = (uint64_t)s->truth.spike;
    double ms = s->frames / period % 2 ? 100 : 5;
    return (struct kd_frame_cost) { .rays_ms = ms / 2, .pixels_ms = ms / 2, .total_ms = ms };
}

static struct kd_frame_cost telegraph(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    bool slow = fmod(s->now, 2 * s->truth.spike) > s->truth.spike;
    struct kd_frame_cost c = truthful(s, scene, reused);
    double factor = slow ? 5 : 1;
    return (struct kd_frame_cost) { .fixed_ms = factor * c.fixed_ms,
                                    .rays_ms = factor * c.rays_ms,
                                    .pixels_ms = factor * c.pixels_ms,
                                    .total_ms = factor * c.total_ms };
}

/* A machine that reports only a fixed cost while the picture is small, and only a cost proportional to the size while
 * it is large. */
static struct kd_frame_cost liar(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    (void)reused;
    bool large = rays_of(scene) > 0.3 * rays_of(&s->asked);
    return (
        struct kd_frame_cost) { .fixed_ms = large ? 0 : 70, .rays_ms = large ? 80 : 1, .total_ms = large ? 80 : 71 };
}

/* A machine whose fixed part comes and goes. */
static struct kd_frame_cost restless(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    struct kd_frame_cost c = truthful(s, scene, reused);
    double more = fmod(s->now, 2 * s->truth.spike) > s->truth.spike ? 200 : 0;
    c.fixed_ms += more;
    c.total_ms += more;
    return c;
}

/* Bounds the number of changes within a time T by the number n of failed climbs. The wait doubles after each failed
 * climb, so that 3 s (2^n - 1) <= T. Before the first wait there may be one more failed climb for each rung. Each
 * failed climb causes at most a descent and a climb of the whole ladder. */
static void assert_settles(machine *adversary, struct truth truth, int hours)
{
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, truth);
    s.cost = adversary;
    run(&s, DRAG, 3600e3);
    uint64_t hour = s.changes, n = s.governor.ladder.n_rungs;
    uint64_t vain = n + (uint64_t)ceil(log2(3600 / 3.0));
    assert_true(hour <= 2 * vain * n);
    run(&s, DRAG, (hours - 1) * 3600e3);
    assert_true(s.changes - hour <= 8 * n); /* since the wait doubles, at most log2(10) more tries */
    assert_true(s.least_pause >= 1000);
    print_message("%llu changes in an hour, %llu in %d more\n", (unsigned long long)hour,
                  (unsigned long long)(s.changes - hour), hours - 1);
}

static void adversaries_are_outwaited(void **state)
{
    (void)state;
    assert_settles(slow_after_each_climb, (struct truth) { 0 }, 10);
    assert_settles(greedy, (struct truth) { 0 }, 10);
    for (int period = 1; period <= 40; period += period < 10 ? 1 : 10)
        assert_settles(by_count, (struct truth) { .spike = period }, 2);
    for (double ms = 100; ms < 100e3; ms *= 3.3) /* period of the load */
        assert_settles(telegraph, (struct truth) { .traced = 20, .reused = 3, .pixels = 3, .spike = ms }, 3);
    assert_settles(liar, (struct truth) { 0 }, 10);
    for (double ms = 100; ms < 100e3; ms *= 3.3)
        assert_settles(restless, (struct truth) { .traced = 30, .reused = 3, .pixels = 3, .spike = ms }, 3);
}

static void no_climb_back_before_the_wait_is_over(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { 0 });
    s.cost = slow_after_each_climb;
    double left = 0, waited = 0, longest = 0;
    uint32_t top = 0;
    for (double end = 3600e3; s.now < end;) {
        uint32_t before = s.governor.paces[1].rung;
        run(&s, DRAG, 1);
        uint32_t after = s.governor.paces[1].rung;
        if (after > before) {
            left = s.now;
            top = before;
        } else if (after < before && after <= top) {
            waited = s.now - left;
            assert_true(waited >= longest && waited >= 3000); /* each wait is longer than the one before */
            longest = waited;
        }
    }
    assert_true(longest > 100e3);
}

/* Kinds of frames */

static void slow_traced_frames_leave_cheap_ones_alone(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 300, .reused = 12, .pixels = 10 });
    run(&s, DRAG, 20e3);
    assert_true(s.governor.paces[1].rung >= 2);
    assert_true(s.last.scale <= 0.5);
    run(&s, PLAY, 20e3);
    assert_int_equal(s.governor.paces[0].rung, 0);
    assert_true(s.last.final);
    uint64_t changes = s.changes;
    for (int i = 0; i < 20; i++) {
        run(&s, DRAG, 700);
        assert_true(s.last.scale <= 0.5);
        run(&s, PLAY, 10e3);
        assert_true(s.last.final);
    }
    assert_int_equal(s.changes, changes);
}

/* The first frame after a drag in which only time advances traces rays, and is on the rung of such frames. */
static void the_end_of_a_drag_is_no_stall(void **state)
{
    (void)state;
    for (int i = 0; i < 100; i++) {
        struct simulation s;
        double full = 100 * pow(100, uniform());
        begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = full, .reused = 12, .pixels = 10 });
        run(&s, DRAG, 60e3);
        double longest = 0;
        for (double end = s.now + 60e3; s.now < end;) {
            double before = s.now;
            run(&s, PLAY, 1);
            longest = fmax(longest, s.now - before);
        }
        assert_true(longest <= 1.1 * 500);
        uint32_t rung = s.governor.paces[0].rung;
        assert_true(full > 0.7 * 500 ? true_cost(&s, rung, false) <= 1.1 * 500 : s.last.final);
        /* The rung is as high as the governor can know: on this machine, orders and steps cost less than the governor
         * assumes. */
        assert_true(rung == 0 || true_cost(&s, rung - 1, false) > 0.4 * 500);
    }
}

/* The visible quality settles too, and not only the rung of each kind of frame. */
static void mixed_changes_do_not_flicker(void **state)
{
    (void)state;
    for (enum pattern pattern = 0; pattern < PATTERNS; pattern++) {
        struct simulation s;
        uint64_t seen = 0;
        begin(&s, kd_governor_params(), 1280, 720,
              (struct truth) { .traced = 300, .reused = 12, .pixels = 10, .noise = 0.1 });
        run(&s, pattern, 30e3);
        for (double last = s.last.scale; s.now < 90e3; last = s.last.scale) {
            run(&s, pattern, 1);
            seen += s.last.scale != last;
        }
        print_message("pattern %d: %llu changes seen in a minute\n", pattern, (unsigned long long)seen);
        assert_true(seen <= (pattern == AT_RANDOM ? 6 : 2));
    }
}

/* The picture is so large that its lens map is not cached. */
static void lens_maps_that_are_never_kept(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 300, .reused = 12, .pixels = 10 });
    s.forgets = true;
    run(&s, PLAY, 60e3);
    double mean = mean_over(&s, PLAY, 600e3);
    print_message("mean %.1f ms though nothing is kept\n", mean);
    assert_true(mean < 1.1 * 33);
    uint64_t seen = 0;
    for (double end = s.now + 600e3, last = s.last.scale; s.now < end; last = s.last.scale) {
        run(&s, PLAY, 1);
        seen += s.last.scale != last;
    }
    print_message("hoped for %llu times more\n", (unsigned long long)seen);
    assert_true(seen <= 4); /* down and up again; the time between retries doubles */
}

/* Rest */

static double refine_to_rest(struct simulation *s, int *n)
{
    struct kd_quality before = s->last;
    for (*n = 0; *n < 100; ++*n) {
        struct kd_frame_decision turn = kd_governor_decide(&s->governor, s->now);
        if (isinf(turn.wait_ms)) {
            assert_true(turn.quality.final);
            break;
        }
        s->now += turn.wait_ms; /* waits exactly as long as the governor says */
        assert_true(frame(s));
        assert_true(s->last.scale >= before.scale &&
                    (s->last.samples >= before.samples || s->last.scale > before.scale));
        before = s->last;
    }
    return s->now;
}

static void rest_refines_to_what_is_asked_and_then_costs_nothing(void **state)
{
    (void)state;
    struct simulation s;
    for (int i = 0; i < 400; i++) {
        struct kd_governor_params params = with_target(targets[i % 5]);
        int frames;
        begin(&s, &params, 640, 360, some_truth());
        some_scene(&s.asked);
        run(&s, i % 2 ? DRAG : PLAY, 5000 * uniform());
        change(&s, i % 3);
        double changed = s.now;
        assert_true(frame(&s)); /* the frame is rendered at once, at the current rung */
        const bool final = s.last.final, slow = s.now > changed + 150;
        struct kd_frame_decision turn = kd_governor_decide(&s.governor, s.now);
        if (!slow) { /* the quality shown is the quality in use */
            assert_int_equal(turn.quality.width, s.last.width);
            assert_int_equal(turn.quality.samples, s.last.samples);
        }
        assert_true(final ? isinf(turn.wait_ms)
                          : fabs(turn.wait_ms - fmax(changed + 150 - s.now, 50)) <
                                1e-9); /* after the wait for a slow frame, there is time for a change by the user */
        refine_to_rest(&s, &frames);
        assert_true(final ? frames == 0 : frames >= 1 && frames <= KD_LADDER_STEPS);
        assert_true(s.last.final);
        for (int hour = 1; hour <= 10; hour++) {
            s.now += 3600e3;
            assert_true(isinf(kd_governor_decide(&s.governor, s.now).wait_ms));
            assert_true(kd_governor_decide(&s.governor, s.now).quality.final);
        }
    }
}

/* Compares member by member, because the content of padding is undefined. */
static void assert_same_pace(const struct kd_pace *a, const struct kd_pace *b)
{
    assert_true(a->rung == b->rung && a->ceiling == b->ceiling && a->count == b->count && a->climbed == b->climbed &&
                a->held == b->held && a->tried == b->tried);
    for (uint32_t i = 0; i < a->count && i < KD_PACE_FRAMES; i++)
        assert_memory_equal(&a->costs[i].fixed_ms, &b->costs[i].fixed_ms, 4 * sizeof(double));
    const double *numbers[][2] = { { &a->changed_at, &b->changed_at },       { &a->failed_at, &b->failed_at },
                                   { &a->retry_ms, &b->retry_ms },           { &a->widest, &b->widest },
                                   { &a->failed_target, &b->failed_target }, { &a->held_target, &b->held_target },
                                   { &a->other_ms, &b->other_ms },           { &a->stays, &b->stays } };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        assert_memory_equal(numbers[i][0], numbers[i][1], sizeof(double));
}

static void a_change_breaks_into_refinement(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 1e6, .reused = 1e5, .pixels = 10 });
    s.asked.image.samples = 8;
    s.asked.accuracy.profile = KD_PROFILE_REFERENCE;
    run(&s, DRAG, 1e8);
    s.now += 200;
    struct kd_frame_decision turn = kd_governor_decide(&s.governor, s.now);
    assert_true(turn.refining && turn.wait_ms == 0 && turn.quality.samples == 1 &&
                turn.quality.profile == KD_PROFILE_BALANCED);
    /* The refinement was not reported as rendered, so it is offered again. */
    assert_true(kd_governor_decide(&s.governor, s.now + 50).refining);
    change(&s, true);
    struct kd_frame_decision next = kd_governor_decide(&s.governor, s.now);
    assert_true(!next.refining && next.wait_ms == 0 && next.quality.scale < 1);
    /* The old frame arrives late. Its scene is no longer requested, so the frame does not count as a measurement. */
    struct kd_pace pace = s.governor.paces[1];
    kd_governor_frame(&s.governor, s.now, &turn, &(struct kd_frame_cost) { .rays_ms = 9e5, .total_ms = 9e5 });
    assert_same_pace(&pace, &s.governor.paces[1]);
    assert_true(kd_governor_decide(&s.governor, s.now).wait_ms == 0);
    int frames;
    frame(&s);
    refine_to_rest(&s, &frames);
    /* refinement in steps: 1, 2, 4 and 8 rays along a side of a pixel, then a frame in double precision */
    assert_int_equal(frames, 5);
    /* this frame shows the old scene */
    kd_governor_frame(&s.governor, s.now, &turn, &(struct kd_frame_cost) { .total_ms = 1 });
    assert_true(isinf(kd_governor_decide(&s.governor, s.now).wait_ms));
}

/* If no lens map is cached, frames in which only time advances trace, too. The camera is at rest and the photon ring
 * visible, so it has the full number of rays. */
static void time_keeps_the_rays_at_the_curve(void **state)
{
    (void)state;
    struct simulation s;
    int traced = 0;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 200, .reused = 200, .pixels = 5 });
    for (int k = 0; k < 60; k++) {
        s.now += 300;
        change(&s, false);
        const struct kd_frame_decision turn = kd_governor_decide(&s.governor, s.now);
        kd_governor_frame(&s.governor, s.now, &turn, &(struct kd_frame_cost) { .rays_ms = 200, .total_ms = 205 });
        traced += turn.traced && turn.rung;
        assert_int_equal(turn.quality.critical, 0);
    }
    assert_true(traced > 0);
    change(&s, true);
    const struct kd_frame_decision dragged = kd_governor_decide(&s.governor, s.now);
    assert_true(dragged.rung && dragged.quality.critical == 2);
}

/* In a drag there are fewer rays near the critical curve and fewer stars, on every rung except the first. While time
 * advances, and at rest, the full numbers are used. */
static void a_drag_has_fewer_rays_at_the_curve(void **state)
{
    (void)state;
    static const enum pattern patterns[] = { DRAG, PLAY };
    static const int32_t asked[] = { 1, 2, 4, 16 };
    for (int k = 0; k < 16; k++) {
        struct simulation s;
        struct kd_scene scene;
        int frames;
        begin(&s, kd_governor_params(), 1280, 720,
              (struct truth) { .traced = k & 1 ? 200 : 5, .reused = k & 1 ? 200 : 5, .pixels = 5 });
        s.asked.image.critical_factor = asked[k / 4];
        run(&s, patterns[k / 2 % 2], 5e3);
        const bool fewer = patterns[k / 2 % 2] == DRAG && (k & 1) && asked[k / 4] > 2;
        assert_int_equal(s.last.final, !(k & 1));
        assert_int_equal(s.last.bright, patterns[k / 2 % 2] == DRAG && (k & 1));
        kd_quality_apply(&s.last, &s.asked, &scene);
        assert_int_equal(scene.image.critical_factor, fewer ? 2 : asked[k / 4]);
        change(&s, true);
        assert_int_equal(kd_governor_decide(&s.governor, s.now).audit, k & 1 ? 4 : 1);
        kd_governor_share(&s.governor, 0.5);
        assert_int_equal(kd_governor_decide(&s.governor, s.now).audit, 4);
        kd_governor_share(&s.governor, 1);
        frame(&s);
        refine_to_rest(&s, &frames);
        assert_false(s.last.bright);
        kd_quality_apply(&s.last, &s.asked, &scene);
        assert_int_equal(scene.image.critical_factor, asked[k / 4]);
        assert_int_equal(frames > 0, k & 1);
    }
}

/* Frames of an earlier rung or ladder do not count as measurements, and neither do invalid times. */
static void what_measures_nothing_is_not_counted(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 60, .reused = 12, .pixels = 10 });
    change(&s, true);
    struct kd_frame_decision first = kd_governor_decide(&s.governor, s.now);
    run(&s, DRAG, 3e3);
    assert_true(s.changes >= 1);
    struct kd_pace pace = s.governor.paces[1];
    struct kd_frame_decision turn = kd_governor_decide(&s.governor, s.now);
    const struct kd_frame_cost fine = { .total_ms = 9e5 }, bad[] = { { .total_ms = NAN },
                                                                     { .total_ms = INFINITY },
                                                                     { .total_ms = -1 },
                                                                     { .rays_ms = NAN, .total_ms = 1 },
                                                                     { .pixels_ms = -1, .total_ms = 1 },
                                                                     { .fixed_ms = INFINITY, .total_ms = 1 } };
    kd_governor_frame(&s.governor, s.now, &first, &fine);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        kd_governor_frame(&s.governor, s.now, &turn, &bad[i]);
    assert_same_pace(&pace, &s.governor.paces[1]);
    /* Another ladder happens to start on the same rung. The ceiling that was found on the old ladder does not apply. */
    s.asked.image.width = 1300;
    change(&s, true);
    assert_int_equal(s.governor.paces[1].rung, turn.rung);
    kd_governor_frame(&s.governor, s.now, &turn, &fine);
    assert_int_equal(s.governor.paces[1].count, 0);
    s.load = 0.2;
    run(&s, DRAG, 3e3);
    assert_int_equal(s.governor.paces[1].rung, 0);
}

/* Random machines and scenes */

static void whatever_happens_the_answer_is_sound(void **state)
{
    (void)state;
    struct simulation s;
    struct kd_error error = { 0 };
    for (int i = 0; i < 60; i++) {
        struct kd_governor_params params = with_target(targets[i % 5]);
        begin(&s, &params, 640, 360, some_truth());
        change(&s, true);
        for (int k = 0; k < 3000; k++) {
            struct kd_frame_decision turn = kd_governor_decide(&s.governor, s.now);
            struct kd_scene scene;
            kd_quality_apply(&turn.quality, &s.asked, &scene);
            assert_int_equal(kd_scene_validate(&scene, &error), KD_OK);
            assert_true(turn.wait_ms >= 0);
            assert_true(turn.wait_ms == 0 || turn.wait_ms <= 150 || isinf(turn.wait_ms));
            assert_true(s.governor.paces[0].rung <= last_rung(&s) && s.governor.paces[1].rung <= last_rung(&s));
            struct kd_frame_cost cost = { .fixed_ms = 200 * uniform() * uniform() * uniform(),
                                          .rays_ms = 100 * uniform(),
                                          .pixels_ms = 100 * uniform(),
                                          .total_ms = 150 * uniform(),
                                          .lens_reused = uniform() < 0.5 };
            if (uniform() < 0.02)
                cost.total_ms = (double[]) { NAN, INFINITY, -1, 0 }[k % 4];
            s.now += 200 * uniform() * uniform();
            if (uniform() < 0.3)
                change(&s, uniform() < 0.3);
            if (uniform() < 0.01) {
                some_scene(&s.asked);
                change(&s, true);
            }
            if (turn.wait_ms == 0 && uniform() < 0.8)
                kd_governor_frame(&s.governor, s.now, &turn, &cost);
        }
    }
}

/* A starry view whose azimuth changes. In the frames of a recorded session 7.2 ms of the rays' time did not depend on
 * the picture's size; frames do not report this part separately. Other load slowed the view down for a while. When that
 * load ends, the view must regain the size that meets the target. */
static struct kd_frame_cost starry(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    const double pixels = 1e-3 * scene->image.width * scene->image.height,
                 noise = s->load * (1 + 0.1 * (2 * uniform() - 1));
    struct kd_frame_cost c = { .fixed_ms = 0.1 * noise,
                               .rays_ms = noise * ((reused ? 7.2 : 10) + (reused ? 0.16 : 0.3) * pixels),
                               .pixels_ms = noise * (0.8 + 0.012 * pixels) };
    c.total_ms = c.fixed_ms + c.rays_ms + c.pixels_ms;
    return c;
}

static void what_stays_at_any_size_is_learned(void **state)
{
    (void)state;
    static const enum pattern patterns[] = { PLAY, DRAG };
    static const double least[] = { 0.5, 0.375 }; /* ms of a frame of 640 x 360: 18, or 24 with a new lens map */
    for (int k = 0; k < 2; k++) {
        struct simulation s;
        begin(&s, kd_governor_params(), 640, 360, (struct truth) { 0 });
        s.cost = starry;
        s.load = 3;
        run(&s, patterns[k], 10e3);
        const double slow = s.last.scale;
        s.load = 1;
        run(&s, patterns[k], 30e3);
        const uint64_t changes = s.changes;
        const double mean = mean_over(&s, patterns[k], 60e3);
        print_message("from scale %g to %g: %.1f ms, %llu changes more\n", slow, s.last.scale, mean,
                      (unsigned long long)(s.changes - changes));
        assert_true(slow == 0.25 && s.last.scale >= least[k]);
        assert_true(mean <= 1.1 * 33 && s.changes - changes <= 2);
    }
}

/* A starry view in a session that started on the lowest rung, because kernels were compiled during its first frame. The
 * session has no frames of another rung, from which the fixed part could be inferred. */
static void who_began_low_finds_out(void **state)
{
    (void)state;
    static const enum pattern patterns[] = { PLAY, DRAG };
    static const double least[] = { 0.5, 0.375 };
    for (int k = 0; k < 2; k++) {
        const struct kd_frame_cost first = {
            .rays_ms = 1900, .pixels_ms = 90, .total_ms = 2000, .lens_reused = patterns[k] == PLAY
        };
        struct simulation s;
        begin(&s, kd_governor_params(), 640, 360, (struct truth) { 0 });
        s.cost = starry;
        change(&s, true);
        kd_governor_expect(&s.governor, &first);
        run(&s, patterns[k], 1e3);
        const double began = s.last.scale;
        run(&s, patterns[k], 20e3);
        const uint64_t changes = s.changes;
        const double mean = mean_over(&s, patterns[k], 60e3);
        print_message("from scale %g to %g: %.1f ms, %llu changes more\n", began, s.last.scale, mean,
                      (unsigned long long)(s.changes - changes));
        assert_true(began == 0.25 && s.last.scale >= least[k]);
        assert_true(mean <= 1.1 * 33 && s.changes - changes <= 2);
    }
}

/* Recorded */

static int recorded_scene;

static struct kd_frame_cost replay(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    static const double scales[] = { 1, 0.75, 0.625, 0.5, 0.375, 0.25 };
    int i = 0;
    while (i < 5 && scene->image.width < s->asked.image.width * scales[i] - 1)
        i++;
    int frame = (int)(s->frames % (sizeof recorded[0][0][0] / sizeof **recorded[0][0]));
    return (struct kd_frame_cost) { .fixed_ms = recorded[recorded_scene][!reused][i][frame].fixed,
                                    .rays_ms = recorded[recorded_scene][!reused][i][frame].rays,
                                    .pixels_ms = recorded[recorded_scene][!reused][i][frame].pixels,
                                    .total_ms = recorded[recorded_scene][!reused][i][frame].total };
}

/* For any times of the machine, no frame is narrower than the minimum. A lowered minimum is used. */
static void no_frame_is_less_than_the_least(void **state)
{
    (void)state;
    static const double least[] = { 1, 0.5, 0.3, 0.25 }, narrowest[] = { 1, 0.5, 0.375, 0.25 };
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 1600;
    scene.image.height = 900;
    scene.image.samples = 2;
    struct kd_governor governor;
    kd_governor_init(&governor, kd_governor_params(.target_ms = 33));
    double now = 0;
    for (size_t i = 0; i < 2 * sizeof least / sizeof *least; i++) {
        const size_t k = i % 4;
        double seen = 1;
        kd_governor_least(&governor, least[k], INFINITY);
        for (int frame = 0; frame < 60; frame++) { /* time far above the target at any size */
            kd_governor_changed(&governor, now, &scene, true);
            const struct kd_frame_decision turn = kd_governor_decide(&governor, now);
            assert_true(turn.quality.scale >= least[k]);
            assert_int_equal(turn.quality.width, (int)round(1600 * turn.quality.scale));
            seen = fmin(seen, turn.quality.scale);
            const double rays_ms = 400 * turn.quality.scale * turn.quality.scale;
            now += 1 + rays_ms;
            kd_governor_frame(&governor, now, &turn,
                              &(struct kd_frame_cost) { .rays_ms = rays_ms, .total_ms = 1 + rays_ms });
        }
        assert_true(seen == narrowest[k]);
    }
}

/* Simulates frames whose rays take `stays_ms` at any size, and `full_ms` more at full size. Returns the width of the
 * last frame divided by the requested width. */
static double after_frames_of(struct kd_governor *governor, const struct kd_scene *scene, double *now, double stays_ms,
                              double full_ms, int frames)
{
    double scale = 1;
    for (int frame = 0; frame < frames; frame++) {
        kd_governor_changed(governor, *now, scene, true);
        const struct kd_frame_decision turn = kd_governor_decide(governor, *now);
        scale = turn.quality.scale;
        const double rays_ms = stays_ms + full_ms * scale * scale;
        *now += 1 + rays_ms;
        kd_governor_frame(governor, *now, &turn,
                          &(struct kd_frame_cost) { .rays_ms = rays_ms, .total_ms = 1 + rays_ms });
    }
    return scale;
}

static double after_frames(struct kd_governor *governor, const struct kd_scene *scene, double *now, double full_ms,
                           int frames)
{
    return after_frames_of(governor, scene, now, 0, full_ms, frames);
}

/* If much of a frame's time is independent of its size, half the width returns as soon as there is time for it, and not
 * before. */
static void wide_frames_come_back_where_much_stays(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 1600;
    scene.image.height = 900;
    scene.accuracy.orders = 2;
    scene.accuracy.profile = KD_PROFILE_DRAFT; /* only the width can be reduced */
    struct kd_governor governor;
    kd_governor_init(&governor, kd_governor_params(.target_ms = 33));
    kd_governor_least(&governor, 0.5, 100);
    double now = 0;
    assert_true(after_frames_of(&governor, &scene, &now, 20, 140, 300) == 0.5); /* 56 ms */
    /* 111 ms; 59 ms with a quarter of the width */
    assert_true(after_frames_of(&governor, &scene, &now, 40, 280, 50) == 0.25);
    for (int i = 0; i < 300; i++)
        assert_true(after_frames_of(&governor, &scene, &now, 40, 280, 1) < 0.5);
    assert_true(after_frames_of(&governor, &scene, &now, 20, 140, 60) == 0.5);
    assert_true(after_frames_of(&governor, &scene, &now, 20, 140, 300) == 0.5);
}

/* Half the width is kept while such a frame takes no longer than the patience, and given up when it takes longer. The
 * width returns when such a frame would meet the patience again, or when the scene changes its kind. */
static void wide_frames_give_way_to_slowness(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 1600;
    scene.image.height = 900;
    struct kd_governor governor;
    kd_governor_init(&governor, kd_governor_params(.target_ms = 33));
    kd_governor_least(&governor, 0.5, 100);
    double now = 0;
    assert_true(after_frames(&governor, &scene, &now, 360, 300) == 0.5); /* 90 ms */
    assert_true(after_frames(&governor, &scene, &now, 800, 300) == 0.25);
    /* the time of such a frame is too close to the patience */
    assert_true(after_frames(&governor, &scene, &now, 360, 300) == 0.25);
    assert_true(after_frames(&governor, &scene, &now, 200, 300) == 0.5);
    assert_true(after_frames(&governor, &scene, &now, 800, 300) == 0.25);
    scene.sky.model = KD_SKY_GRID;
    assert_true(after_frames(&governor, &scene, &now, 800, 1) == 0.5);
    assert_true(after_frames(&governor, &scene, &now, 800, 300) == 0.25);
    kd_governor_least(&governor, 0.5, INFINITY);
    assert_true(after_frames(&governor, &scene, &now, 800, 300) == 0.5);
}

static void recorded_frames_settle(void **state)
{
    (void)state;
    struct simulation s;
    for (recorded_scene = 0; recorded_scene < 3; recorded_scene++)
        for (size_t k = 0; k < sizeof targets / sizeof *targets; k++)
            for (enum pattern pattern = PLAY; pattern <= DRAG; pattern++) {
                struct kd_governor_params params = with_target(targets[k]);
                begin(&s, &params, 640, 360, (struct truth) { 0 });
                s.cost = replay;
                run(&s, pattern, 30e3);
                uint64_t changes = s.changes;
                double mean = mean_over(&s, pattern, 120e3);
                print_message("%s, %s, target %.0f ms: %.1f ms at scale %g, %llu changes, then %llu\n",
                              (const char *[]) { "default", "sky", "particles" }[recorded_scene],
                              pattern == DRAG ? "dragged" : "played", targets[k], mean, s.last.scale,
                              (unsigned long long)changes, (unsigned long long)(s.changes - changes));
                assert_true(s.changes - changes <= 4);
                assert_true(mean <= 1.25 * targets[k] || s.governor.paces[pattern].rung == last_rung(&s));
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ladders_go_down_in_order_and_up_to_what_is_asked),
        cmocka_unit_test(adaptive_pictures_move_with_one_ray),
        cmocka_unit_test(settles_on_a_steady_machine),
        cmocka_unit_test(settles_when_told_only_totals),
        cmocka_unit_test(begins_where_it_is_told_to_expect),
        cmocka_unit_test(two_slow_frames_are_enough),
        cmocka_unit_test(what_cannot_be_mended_costs_no_resolution),
        cmocka_unit_test(what_can_be_mended_is),
        cmocka_unit_test(recovers_from_a_slow_beginning),
        cmocka_unit_test(a_drag_is_soon_forgotten),
        cmocka_unit_test(another_kind_of_scene_begins_anew),
        cmocka_unit_test(drags_across_an_octave_go_on),
        cmocka_unit_test(bodies_of_a_playground_count),
        cmocka_unit_test(what_only_rings_keeps_its_size),
        cmocka_unit_test(time_keeps_the_rays_at_the_curve),
        cmocka_unit_test(what_refinement_measured_is_believed),
        cmocka_unit_test(noise_and_spikes_change_little),
        cmocka_unit_test(load_that_comes_and_goes_is_followed),
        cmocka_unit_test(adversaries_are_outwaited),
        cmocka_unit_test(no_climb_back_before_the_wait_is_over),
        cmocka_unit_test(slow_traced_frames_leave_cheap_ones_alone),
        cmocka_unit_test(the_end_of_a_drag_is_no_stall),
        cmocka_unit_test(mixed_changes_do_not_flicker),
        cmocka_unit_test(lens_maps_that_are_never_kept),
        cmocka_unit_test(rest_refines_to_what_is_asked_and_then_costs_nothing),
        cmocka_unit_test(a_change_breaks_into_refinement),
        cmocka_unit_test(a_drag_has_fewer_rays_at_the_curve),
        cmocka_unit_test(what_measures_nothing_is_not_counted),
        cmocka_unit_test(whatever_happens_the_answer_is_sound),
        cmocka_unit_test(what_stays_at_any_size_is_learned),
        cmocka_unit_test(who_began_low_finds_out),
        cmocka_unit_test(no_frame_is_less_than_the_least),
        cmocka_unit_test(wide_frames_give_way_to_slowness),
        cmocka_unit_test(wide_frames_come_back_where_much_stays),
        cmocka_unit_test(recorded_frames_settle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
