/* Tests of scenes between keyframes, independent of jobs and sessions: paths of observers, interpolation of
 * distances by ratios, refusals. */
#include "scene_support.h"

#include "scene/timeline.h"

#include <time.h>

static const struct kd_timeline_form seconds = { "at", 100, false };

static enum kd_status read(const char *scene, const char *keyframes, const char *how, struct kd_timeline *out,
                           struct kd_error *error)
{
    struct kd_scene first;
    cJSON *keys = cJSON_Parse(keyframes), *word = how ? cJSON_CreateString(how) : NULL;
    const bool geometric = how && !strcmp(how, "geometric");
    kd_scene_smooth(&first);
    assert_int_equal(support_parse(&first, scene, NULL), KD_OK);
    assert_non_null(keys);
    const struct kd_timeline_items items = { keys, geometric ? NULL : word, geometric ? word : NULL };
    enum kd_status status = kd_timeline_read(&items, &seconds, NULL, &first, out, error);
    cJSON_Delete(keys);
    cJSON_Delete(word);
    return status;
}

static struct kd_timeline made(const char *scene, const char *keyframes, const char *how)
{
    struct kd_timeline t;
    struct kd_error error = { 0 };
    if (read(scene, keyframes, how, &t, &error))
        fail_msg("%s: %s %s", keyframes, error.pointer, error.message);
    return t;
}

static struct kd_scene at(const struct kd_timeline *t, double where)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    if (kd_timeline_scene(t, where, &scene, &error))
        fail_msg("at %g: %s %s", where, error.pointer, error.message);
    return scene;
}

/* Rain in Schwarzschild: r^(3/2) falls evenly with proper time, from 8 M; from the horizon to the end it takes 4/3
 * M. */
#define RAIN "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":8,\"observer\":\"infall\"}}"

static void free_fall_by_proper_time(void **state)
{
    (void)state;
    struct kd_timeline t = made(
        RAIN,
        "[{\"at\":4,\"proper_time\":2},{\"at\":6,\"proper_time\":\"horizon\"},{\"at\":16.5,\"proper_time\":\"end\"}]",
        NULL);
    const double whole = sqrt(2) / 3 * pow(8, 1.5), horizon = whole - 4. / 3;
    for (double s = 0; s <= 20; s += 0.25) {
        const struct kd_scene scene = at(&t, s);
        const double last = whole - sqrt(2) / 3 * 1e-3; /* at 0.01 M */
        const double tau = s < 4      ? s / 2
                           : s < 6    ? 2 + (horizon - 2) * (s - 4) / 2
                           : s < 16.5 ? horizon + (last - horizon) * (s - 6) / 10.5
                                      : last;
        const double r = pow(3 / sqrt(2) * (whole - tau), 2. / 3);
        if (!(fabs(scene.camera.r / r - 1) < 1e-10))
            fail_msg("after %g s: r %.15g, wanted %.15g", s, scene.camera.r, r);
        assert_true(scene.camera.azimuth_deg == 0);
        assert_true(s == 0 ? scene.top.time == 0 : scene.top.time > tau);
        assert_int_equal(kd_scene_validate(&scene, NULL), KD_OK);
    }
    assert_true(at(&t, 6).camera.r == 2 || fabs(at(&t, 6).camera.r - 2) < 1e-13);
    kd_timeline_finish(&t);
}

/* An orbit at 10 M, where d(phi)/dtau = 1/(r^(3/2) sqrt(1 - 3/r)) without spin. With easing the observer is halfway at
 * half of the time. */
static void an_orbit_by_proper_time(void **state)
{
    (void)state;
    const char *scene =
        "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":10,\"observer\":\"keplerian\",\"inclination_deg\":90}}";
    struct kd_timeline t = made(scene, "[{\"at\":10,\"proper_time\":80}]", "smooth");
    const double root = sqrt(0.7), turned = 80 / (pow(10, 1.5) * root) * (180 / M_PI);
    assert_true(fabs(at(&t, 10).camera.azimuth_deg - remainder(turned, 360)) < 1e-10);
    assert_true(fabs(at(&t, 5).camera.azimuth_deg - remainder(turned / 2, 360)) < 1e-10);
    assert_true(fabs(at(&t, 2).camera.azimuth_deg - turned * (3 * 0.04 - 2 * 0.008)) < 1e-10);
    assert_true(fabs(at(&t, 10).top.time - 80 / root) < 1e-10);
    kd_timeline_finish(&t);
}

static void an_approach_by_ratios(void **state)
{
    (void)state;
    const char *keys =
        "[{\"at\":2,\"scene\":{\"camera\":{\"r\":10,\"fov_deg\":90}}},{\"at\":4,\"scene\":{\"camera\":{\"r\":40}}}]";
    struct kd_timeline t = made("{\"camera\":{\"r\":1000,\"fov_deg\":30}}", keys, "geometric");
    assert_true(fabs(at(&t, 0).camera.r - 1000) < 1e-9 && fabs(at(&t, 1).camera.r - 100) < 1e-11 &&
                fabs(at(&t, 3).camera.r - 20) < 1e-11);
    assert_true(at(&t, 2).camera.r == 10 && at(&t, 4).camera.r == 40 && at(&t, 9).camera.r == 40);
    assert_true(fabs(at(&t, 1).camera.fov_deg - 60) < 1e-12); /* an angle is not interpolated by ratios */
    kd_timeline_finish(&t);
    t = made("{\"camera\":{\"field_m\":10}}", "[{\"at\":2,\"scene\":{\"camera\":{\"field_m\":40}}}]", "geometric");
    assert_true(fabs(at(&t, 1).camera.field_m - 20) < 1e-12 && isinf(at(&t, 1).camera.r));
    kd_timeline_finish(&t);
    t = made("{\"camera\":{\"field_uas\":50}}", "[{\"at\":2,\"scene\":{\"camera\":{\"field_uas\":200}}}]", "geometric");
    assert_true(fabs(at(&t, 1).camera.field_uas - 100) < 1e-11 &&
                fabs(at(&t, 1).camera.field_m / at(&t, 0).camera.field_m - 2) < 1e-12);
    kd_timeline_finish(&t);
    t = made("{\"camera\":{\"r\":1000}}", "[{\"at\":2,\"scene\":{\"camera\":{\"r\":10}}}]", NULL);
    assert_true(fabs(at(&t, 1).camera.r - 505) < 1e-10);
    kd_timeline_finish(&t);
}

/* If the unit of the width changes, it is interpolated in M; if only the hole changes, the width stays the same on
 * the sky. */
static void a_field_in_microarcseconds(void **state)
{
    (void)state;
    struct kd_timeline t = made("{\"camera\":{\"field_uas\":50}}",
                                "[{\"at\":2,\"scene\":{\"camera\":{\"field_m\":40}}},"
                                "{\"at\":4,\"scene\":{\"camera\":{\"field_uas\":50}}}]",
                                NULL);
    const double from = at(&t, 0).camera.field_m;
    assert_true(at(&t, 0).camera.field_uas == 50 && fabs(at(&t, 1).camera.field_m - 0.5 * (from + 40)) < 1e-12);
    assert_true(isinf(at(&t, 1).camera.field_uas) && at(&t, 2).camera.field_m == 40);
    assert_true(fabs(at(&t, 3).camera.field_m - 0.5 * (from + 40)) < 1e-12 && at(&t, 4).camera.field_uas == 50);
    kd_timeline_finish(&t);
    t = made("{\"camera\":{\"field_uas\":50},\"spacetime\":{\"mass_msun\":1e8}}",
             "[{\"at\":2,\"scene\":{\"spacetime\":{\"mass_msun\":3e8}}}]", NULL);
    assert_true(fabs(at(&t, 1).camera.field_m / at(&t, 0).camera.field_m - 0.5) < 1e-14);
    kd_timeline_finish(&t);
}

static void what_is_no_path_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *keys, *pointer, *says;
    } wrong[] = {
        { "{}", "[{\"at\":1,\"proper_time\":1}]", "/keyframes/0/proper_time",
          "is 1; it must be 0 unless the observer stays" },
        { "{\"camera\":{\"r\":9}}", "[{\"at\":1,\"proper_time\":\"end\"}]", "/keyframes/0/proper_time",
          "for an observer that falls" },
        { RAIN, "[{\"at\":1,\"proper_time\":\"soon\"}]", "/keyframes/0/proper_time", "\"horizon\" or \"end\"" },
        { RAIN, "[{\"at\":1,\"proper_time\":-1}]", "/keyframes/0/proper_time", "is -1; it must be 0 to" },
        { RAIN, "[{\"at\":1,\"scene\":{\"camera\":{\"r\":1}},\"proper_time\":\"horizon\"}]", "/keyframes/0/proper_time",
          "from further out" },
        { RAIN, "[{\"at\":1,\"scene\":{\"motion\":{\"proper_time_rate\":1}},\"proper_time\":1}]",
          "/keyframes/0/proper_time", "cannot be used with motion.proper_time_rate" },
        { RAIN, "[{\"at\":1,\"scene\":{}},{\"at\":1,\"scene\":{}}]", "/keyframes/1/at", "a number above 1 to 100" },
        { RAIN, "[{\"at\":100,\"scene\":{}},{\"at\":100,\"scene\":{}}]", "/keyframes/1/at",
          "cannot be used, because the keyframe before it is at 100, the latest place" },
        { RAIN, "[{\"at\":101,\"scene\":{}}]", "/keyframes/0/at", "0 to 100" },
        { RAIN, "[{\"at\":1,\"frame\":2,\"scene\":{}}]", "/keyframes/0/frame",
          "the fields are at, scene, proper_time, ease, look_at" },
        { RAIN, "[{\"at\":1,\"scen\":{}}]", "/keyframes/0/scen", "there is no field scen here; did you mean scene?" },
        { RAIN, "[{\"at\":1,\"ease\":\"in\",\"ease\":\"in\"}]", "/keyframes/0/ease", "ease is given twice" },
        { RAIN, "[{\"at\":1,\"look_at\":{\"theta_deg\":181}}]", "/keyframes/0/look_at/theta_deg",
          "theta_deg is 181; it must be 0 to 180 degrees" },
        { RAIN, "[{\"at\":1,\"look_at\":{\"r\":null}}]", "/keyframes/0/look_at/r",
          "r is null where a number is needed; it must be 0 to" },
        { RAIN, "[{\"at\":1,\"look_at\":{\"theta\":1}}]", "/keyframes/0/look_at/theta", "did you mean theta_deg?" },
        { RAIN, "[{\"at\":1}]", "/keyframes/0", "a scene, a proper_time or a look_at" },
        { RAIN, "[{\"at\":1,\"scene\":{\"camera\":{\"r\":0}}}]", "/keyframes/0/scene/camera/r", "it must be" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct kd_timeline t = { 0 };
        struct kd_error error = { 0 };
        assert_int_equal(read(wrong[i].scene, wrong[i].keys, NULL, &t, &error), KD_EINVAL);
        if (strcmp(error.pointer, wrong[i].pointer) || !strstr(error.message, wrong[i].says))
            fail_msg("%s: %s %s", wrong[i].keys, error.pointer, error.message);
        assert_null(t.keys);
    }
    /* Between two valid keyframes there may be an error: on the way from a fall to an orbit, the scene has no valid
     * observer. */
    struct kd_timeline t = made(RAIN,
                                "[{\"at\":1,\"proper_time\":2},{\"at\":2,\"scene\":{\"camera\":{\"observer\":"
                                "\"velocity\"}},\"proper_time\":0}]",
                                NULL);
    struct kd_scene scene;
    struct kd_error error = { 0 };
    assert_int_equal(kd_timeline_scene(&t, 1.5, &scene, &error), KD_OK);
    t.keys[1].scene.camera.observer = KD_OBSERVER_VELOCITY;
    assert_int_equal(kd_timeline_scene(&t, 1.5, &scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/keyframes");
    kd_timeline_finish(&t);
}

enum { MANY = 10000, SOME = 1000, FEW = 20 };

/* A turn of the camera in uneven steps, of up to 170 degrees each; turned[k]: its azimuth at key k, with all turns
 * counted. */
static struct kd_timeline turning(size_t n, enum kd_interpolation by, double *turned)
{
    struct kd_timeline t = { .keys = calloc(n, sizeof *t.keys), .n_keys = n, .interpolation = by, .shorter = true };
    uint64_t seed = 7;
    double azimuth = 0;
    assert_non_null(t.keys);
    for (size_t k = 0; k < n; k++) {
        kd_scene_smooth(&t.keys[k].scene);
        t.keys[k].at = (double)k + (k % 3 == 1 ? 0.25 : 0);
        t.keys[k].scene.camera.azimuth_deg = remainder(azimuth, 360);
        turned[k] = azimuth;
        azimuth += (double)(support_random(&seed) % 341) - 170;
    }
    return t;
}

/* The shortest of nine measurements of this thread's time is taken, because other processes may be running. */
static double seconds_of(const struct kd_timeline *t, int frames)
{
    double least = INFINITY;
    for (int repeat = 0; repeat < 9; repeat++) {
        struct timespec begun, ended;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begun);
        for (int i = 0; i < frames; i++)
            at(t, kd_timeline_end(t) * ((i * 7 % frames) + 0.5) / frames);
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &ended);
        least = fmin(least, (double)(ended.tv_sec - begun.tv_sec) + 1e-9 * (double)(ended.tv_nsec - begun.tv_nsec));
    }
    return least;
}

/* Angles go the shorter way from key to key, and their turns add up from the first key on. Even so, the time of a frame
 * depends only on the neighbouring keys. */
static void a_great_many_keys(void **state)
{
    (void)state;
    double *turned = calloc(MANY, sizeof *turned), first[SOME];
    assert_non_null(turned);
    struct kd_timeline t = turning(MANY, KD_LINEAR, turned), few = turning(SOME, KD_LINEAR, first);
    assert_true(fabs(turned[MANY - 1]) > 720 || fabs(turned[MANY / 2]) > 720);
    for (size_t k = 0; k + 1 < MANY; k += k % 5 + 1)
        for (int i = 0; i < 4; i++) {
            const double s = 0.25 * i, place = t.keys[k].at + s * (t.keys[k + 1].at - t.keys[k].at),
                         found = at(&t, place).camera.azimuth_deg;
            const double wanted = turned[k] + s * (turned[k + 1] - turned[k]);
            if (!(fabs(remainder(found - wanted, 360)) < 1e-9 && fabs(found) <= 360))
                fail_msg("at %g: %.15g, wanted %.15g", place, found, wanted);
        }
    const double slow = seconds_of(&t, 1000), quick = seconds_of(&few, 1000);
    print_message("a frame: %.1f us of %d keys, %.1f us of %d\n", slow * 1e3, MANY, quick * 1e3, SOME);
    /* neither timeline fits in a cache; if the time were proportional to the number of keys, the ratio would be ten */
    assert_true(slow < 5 * quick);
    kd_timeline_finish(&t);
    kd_timeline_finish(&few);
    free(turned);
}

/* A curve depends only on the nearest keys: two before, two after. */
static void curves_are_local(void **state)
{
    (void)state;
    double turned[FEW];
    for (enum kd_interpolation by = KD_SMOOTH; by <= KD_CATMULL_ROM; by++) {
        struct kd_timeline t = turning(FEW, by, turned);
        for (size_t k = 1; k + 2 < FEW; k++) {
            struct kd_timeline part = { .keys = &t.keys[k - 1], .n_keys = 4, .interpolation = by, .shorter = true };
            for (double s = 0; s < 1; s += 0.125) {
                const double place = t.keys[k].at + s * (t.keys[k + 1].at - t.keys[k].at);
                const double whole = at(&t, place).camera.azimuth_deg, alone = at(&part, place).camera.azimuth_deg;
                assert_true(fabs(remainder(whole - alone, 360)) < 1e-12);
            }
        }
        kd_timeline_finish(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_fall_by_proper_time),   cmocka_unit_test(an_orbit_by_proper_time),
        cmocka_unit_test(an_approach_by_ratios),      cmocka_unit_test(a_field_in_microarcseconds),
        cmocka_unit_test(a_great_many_keys),          cmocka_unit_test(curves_are_local),
        cmocka_unit_test(what_is_no_path_is_refused),
    };
    return cmocka_run_group_tests_name("timeline", tests, NULL, NULL);
}
