/* Tests of requests for orbits: how they are read and refused, and the results of following the orbits. */
#include "orbit/feed.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

/* Copies the text to memory of exactly its size, so that a sanitizer detects a read beyond the end. */
static enum kd_status read_exact(const char *text, size_t length, struct kd_orbit_request *request,
                                 struct kd_error *error)
{
    char *copy = malloc(length ? length : 1);
    assert_non_null(copy);
    memcpy(copy, text, length);
    kd_orbit_request_init(request);
    enum kd_status status = kd_orbit_request_json(request, copy, length, error);
    free(copy);
    return status;
}

/* Reads, solves and prepares a request. */
static enum kd_status try (const char *text, struct kd_error *error) {
    struct kd_orbit_request request; struct kd_buffer out = { 0 }; struct kd_orbit_feed *feed = calloc(1, sizeof *feed);
    assert_non_null(feed);
    *error = (struct kd_error) { 0 };
    enum kd_status status = read_exact(text, strlen(text), &request, error);
    if (!status) status = kd_orbit_feed_init(feed, &request, KD_ORBIT_JSON, error);
    while (!status && !kd_orbit_feed_done(feed)) status = kd_orbit_feed_more(feed, &out, error);
    kd_orbit_feed_finish(feed);
    kd_buffer_finish(&out);
    kd_orbit_request_finish(&request);
    free(feed);
    return status;
}

static void refusals(void **state)
{
    (void)state;
    static const struct {
        const char *text, *pointer, *words;
    } rows[] = {
        { "{}", "/orbit", "missing" },
        { "{\"orbit\":7}", "/orbit", "an object" },
        { "{\"orbit\":{}}", "/orbit", "position and velocity" },
        { "{\"orbits\":[]}", "/orbits", "1 to 10000" },
        { "{\"orbits\":{}}", "/orbits", "an array" },
        { "{\"orbits\":[{\"p\":9,\"e\":0},{\"p\":9,\"e\":\"x\"}]}", "/orbits/1/e", "\"x\"" },
        { "{\"orbits\":[{\"p\":9,\"e\":0},{\"p\":5,\"e\":0.5}]}", "/orbits/1/p", "separatrix" },
        { "{\"orbit\":{\"p\":9,\"e\":0},\"orbits\":[]}", "/orbits", "twice" },
        { "{\"orbit\":{\"p\":9,\"e\":0,\"p\":8}}", "/orbit/p", "twice" },
        { "{\"orbit\":{\"p\":9}}", "/orbit/e", "missing" },
        { "{\"orbit\":{\"p\":9,\"e\":1}}", "/orbit/e", "not including" },
        { "{\"orbit\":{\"p\":9,\"e\":1.5}}", "/orbit/e", "not including" },
        { "{\"orbit\":{\"p\":9,\"e\":\"0.5\"}}", "/orbit/e", "\"0.5\", a string where a number is needed" },
        { "{\"orbit\":{\"p\":9,\"e\":.5}}", "", "not valid JSON" },
        { "{\"orbit\":{\"p\":9,\"e\":0,\"energy\":0.9}}", "/orbit",
          "energy cannot be used with p; an orbit must be defined by" },
        { "{\"orbit\":{\"case\":\"mercury\",\"p\":6}}", "/orbit",
          "case cannot be used with p; an orbit must be defined by p, e and" },
        { "{\"orbit\":{\"p\":9,\"e\":0,\"E\":0.9}}", "/orbit/E", "did you mean e?" },
        { "{\"orbit\":{\"p\":9,\"e\":0,\"spin\":-1}}", "/orbit/spin", "above -1" },
        { "{\"spin\":1,\"orbit\":{\"p\":9,\"e\":0}}", "/spin", "below 1" },
        { "{\"spin\":1.5,\"orbit\":{\"p\":9,\"e\":0}}", "/spin", "below 1" },
        { "{\"orbit\":{\"energy\":0.9,\"angular_momentum\":4,\"r\":1.5}}", "/orbit/r", "horizon" },
        { "{\"orbit\":{\"energy\":0.9,\"angular_momentum\":4,\"carter\":-1}}", "/orbit/carter", "at least 0" },
        { "{\"orbit\":{\"energy\":0.95,\"angular_momentum\":4,\"r\":1000}}", "/orbit/r",
          "no particle with these constants" },
        { "{\"orbit\":{\"position\":{\"r\":1.5}}}", "/orbit/position/r", "horizon" },
        { "{\"orbit\":{\"position\":{\"r\":5},\"velocity\":{\"v_r\":0.9,\"v_phi\":0.9}}}", "/orbit/velocity",
          "below 1" },
        { "{\"orbit\":{\"position\":{\"r\":5},\"velocity\":{\"frame\":\"free\"}}}", "/orbit/velocity/frame", "static" },
        { "{\"spin\":0.9,\"orbit\":{\"position\":{\"r\":1.8},\"velocity\":{\"frame\":\"static\"}}}",
          "/orbit/velocity/frame", "ergosphere" },
        { "{\"orbit\":{\"position\":{\"theta\":5}}}", "/orbit/position/theta", "did you mean position.theta_deg?" },
        { "{\"orbit\":{\"case\":\"venus\"}}", "/orbit/case", "mercury" },
        { "{\"orbit\":{\"case\":\"isco\"},\"samples\":1}", "/samples", "at least 2" },
        { "{\"orbit\":{\"case\":\"isco\"},\"samples\":2.5}", "/samples", "whole" },
        { "{\"orbit\":{\"case\":\"isco\"},\"samples\":null}", "/samples", "null" },
        { "{\"orbit\":{\"case\":\"isco\"},\"method\":\"euler\"}", "/method", "rkn6" },
        { "{\"orbit\":{\"case\":\"isco\"},\"duration\":5}", "/duration", "an object" },
        { "{\"orbit\":{\"case\":\"isco\"},\"duration\":{\"periods\":1,\"time\":5}}", "/duration",
          "periods cannot be used with time" },
        { "{\"orbit\":{\"case\":\"isco\"},\"duration\":{\"periods\":1e9}}", "/duration", "steps" },
        { "{\"orbit\":{\"case\":\"plunge\"},\"duration\":{\"periods\":3}}", "/duration/periods", "plunge" },
        { "{\"orbit\":{\"case\":\"plunge\"},\"method\":\"closed\"}", "/method", "plunge" },
        { "{\"orbits\":[{\"case\":\"isco\"},{\"case\":\"plunge\"}],\"method\":\"closed\"}", "/method", "plunge" },
        { "{\"orbits\":[{\"case\":\"isco\"},{\"case\":\"isco\"}],\"series\":true,\"samples\":200000}", "/samples",
          "in all" },
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct kd_error error;
        enum kd_status status =
        try
            (rows[i].text, &error);
        if (status != KD_EINVAL || strcmp(error.pointer, rows[i].pointer) || !strstr(error.message, rows[i].words))
            fail_msg("%s: status %d at %s: %s", rows[i].text, status, error.pointer, error.message);
    }
}

static void every_cut(void **state)
{
    (void)state;
    static const char text[] =
        "{\"spin\":0.5,\"orbit\":{\"position\":{\"r\":9,\"phi_deg\":5},\"velocity\":{\"v_phi\":0.4}},\"samples\":3}";
    struct kd_orbit_request request;
    struct kd_error error;
    for (size_t i = 0; i < sizeof text; i++) {
        enum kd_status status = read_exact(text, i, &request, &error);
        assert_int_equal(status, i + 1 < sizeof text ? KD_EINVAL : KD_OK);
        kd_orbit_request_finish(&request);
    }
}

/* Follows the orbit to its end, in pieces of `steps` steps. Returns the samples. */
static struct kd_orbit_sample *follow(const char *text, uint64_t steps, struct kd_orbit_request *request,
                                      struct kd_orbit_run *run)
{
    struct kd_error error = { 0 };
    if (read_exact(text, strlen(text), request, &error) || kd_orbit_run_init(run, request, 0, &error) ||
        kd_orbit_run_prepare(&run, 1, &error))
        fail_msg("%s: %s at %s", text, error.message, error.pointer);
    struct kd_orbit_sample *samples = calloc(run->samples, sizeof *samples);
    size_t n = 0;
    assert_non_null(samples);
    while (!kd_orbit_run_done(run))
        n += kd_orbit_run_advance(run, steps, samples + n, run->samples - n);
    assert_int_equal(n, run->samples);
    return samples;
}

/* Compares to the bit, except for padding, whose content is undefined. */
static void assert_same_samples(const struct kd_orbit_sample *a, const struct kd_orbit_sample *b, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        assert_memory_equal(&a[i], &b[i], offsetof(struct kd_orbit_sample, image.outward));
        assert_true(a[i].image.outward == b[i].image.outward);
        assert_memory_equal(&a[i].image.look, &b[i].image.look, sizeof a[i].image.look);
        assert_memory_equal(&a[i].image.delay, &b[i].image.delay,
                            sizeof *a - offsetof(struct kd_orbit_sample, image.delay));
    }
}

static void pieces_change_nothing(void **state)
{
    (void)state;
    static const char *const ways[] = { "yoshida6", "rkn6", "closed" };
    for (size_t i = 0; i < COUNT(ways); i++) {
        struct kd_orbit_request request[2];
        struct kd_orbit_run run[2];
        char text[200];
        snprintf(text, sizeof text,
                 "{\"spin\":0.9,\"orbit\":{\"p\":6,\"e\":0.5,\"inclination_deg\":30},\"samples\":50,\"method\":\"%s\"}",
                 ways[i]);
        struct kd_orbit_sample *whole = follow(text, UINT64_MAX, &request[0], &run[0]),
                               *cut = follow(text, 7, &request[1], &run[1]);
        assert_same_samples(whole, cut, 50);
        for (int k = 0; k < 2; k++)
            kd_orbit_request_finish(&request[k]);
        free(whole);
        free(cut);
    }
}

/* Tests a duration in periods with "or_end". An orbit without periods is followed to its end, as it is without a
 * duration. For a bound orbit, periods count as usual. */
static void to_its_end_instead(void **state)
{
    (void)state;
#define PLUNGE "{\"samples\":20,\"orbit\":{\"case\":\"plunge\"}"
#define ESCAPE "{\"samples\":20,\"orbit\":{\"position\":{\"r\":10},\"velocity\":{\"v_r\":0.9}}"
/* the body makes more than two turns; with L = 4 it would never fall in */
#define WHIRL "{\"samples\":20,\"method\":\"rkn6\",\"orbit\":{\"energy\":1,\"angular_momentum\":3.9999999}"
#define PERIODS ",\"duration\":{\"periods\":1,\"or_end\":true}}"
    static const char *const bodies[][2] = { { PLUNGE "}", PLUNGE PERIODS },
                                             { ESCAPE "}", ESCAPE PERIODS },
                                             { WHIRL "}", WHIRL PERIODS } };
    for (size_t i = 0; i < COUNT(bodies); i++) {
        struct kd_orbit_request request[2];
        struct kd_orbit_run run[2];
        struct kd_orbit_sample *samples[2];
        for (int k = 0; k < 2; k++)
            samples[k] = follow(bodies[i][k], UINT64_MAX, &request[k], &run[k]);
        assert_same_samples(samples[0], samples[1], 20);
        for (int k = 0; k < 2; k++) {
            kd_orbit_request_finish(&request[k]);
            free(samples[k]);
        }
    }
    struct kd_orbit_request request;
    struct kd_orbit_run run;
    struct kd_orbit_sample *samples =
        follow("{\"samples\":3,\"orbit\":{\"p\":8,\"e\":0.5},\"duration\":{\"periods\":2,\"or_end\":true}}", UINT64_MAX,
               &request, &run);
    assert_float_equal(samples[0].place.r, 16. / 3, 1e-6); /* 16/3 is the radius of the periapsis */
    /* the samples are one period and two periods after the start */
    assert_float_equal(samples[1].place.r, samples[2].place.r, 1e-6);
    kd_orbit_request_finish(&request);
    free(samples);
}

/* The tolerance is per period. After ten periods the error of r is at most ten tolerances, and the error of t at most a
 * hundred. */
static void methods_agree(void **state)
{
    (void)state;
    static const char *const orbits[] = {
        "\"spin\":0.9,\"orbit\":{\"p\":6,\"e\":0.5,\"inclination_deg\":30}",
        "\"orbit\":{\"p\":8,\"e\":0.5}",
        "\"orbit\":{\"case\":\"spherical\"}",
        "\"orbit\":{\"p\":50,\"e\":0.9,\"inclination_deg\":120}",
        "\"orbit\":{\"case\":\"mercury\"}",
        ("\"spin\":-0.5,\"orbit\":{\"position\":{\"r\":12,\"theta_deg\":70,\"phi_deg\":40},"
         "\"velocity\":{\"v_r\":0.1,\"v_theta\":0.1,\"v_phi\":0.35}}"),
    };
    for (size_t i = 0; i < COUNT(orbits); i++) {
        struct kd_orbit_request request[3];
        struct kd_orbit_run run[3];
        struct kd_orbit_sample *samples[3];
        for (int k = 0; k < 3; k++) {
            char text[300];
            snprintf(text, sizeof text, "{%s,\"samples\":101,\"method\":\"%s\"}", orbits[i],
                     kd_orbit_way_name((enum kd_orbit_way)k));
            samples[k] = follow(text, 100000, &request[k], &run[k]);
        }
        for (int k = 0; k < 2; k++)
            for (int n = 0; n < 101; n++) {
                const struct kd_orbit_place *a = &samples[k][n].place, *b = &samples[2][n].place;
                double off = fmax(fabs(a->r / b->r - 1), fmax(fabs(a->theta - b->theta), fabs(a->phi - b->phi)));
                off = fmax(off, fmax(fabs(a->t - b->t) / (1 + b->t), fabs(a->proper - b->proper) / (1 + b->proper)));
                if (!(off < (k == KD_WAY_RKN6 ? 1e-9 : 1e-10))) /* the errors of RKN6 grow with the square of time */
                    fail_msg("%s by %s, sample %d: off by %.2g", orbits[i], kd_orbit_way_name((enum kd_orbit_way)k), n,
                             off);
            }
        double measured = kd_orbit_run_advance_measured(&run[0]), exact = kd_orbit_periastron_advance(&run[2].bound);
        if (!run[0].orbit.circular && run[0].orbit.carter == 0 && !(fabs(measured / exact - 1) < 1e-6))
            fail_msg("%s: advance %.17g, not %.17g", orbits[i], measured, exact);
        for (int k = 0; k < 3; k++) {
            kd_orbit_request_finish(&request[k]);
            free(samples[k]);
        }
    }
}

static void ends(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        enum kd_orbit_fate fate;
        enum kd_orbit_end end;
    } rows[] = {
        { "{\"orbit\":{\"case\":\"plunge\"}}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"spin\":0.998,\"orbit\":{\"case\":\"plunge\"}}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"spin\":-0.998,\"orbit\":{\"case\":\"plunge\"}}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"orbit\":{\"case\":\"plunge\"},\"duration\":{\"time\":5}}", KD_ORBIT_PLUNGE, KD_END_DURATION },
        { "{\"orbit\":{\"case\":\"isco\"},\"duration\":{\"time\":500}}", KD_ORBIT_BOUND, KD_END_DURATION },
        { "{\"orbit\":{\"case\":\"zoom-whirl\"},\"duration\":{\"time\":77}}", KD_ORBIT_BOUND, KD_END_DURATION },
        { "{\"orbit\":{\"energy\":1.1,\"angular_momentum\":6}}", KD_ORBIT_ESCAPE, KD_END_FAR },
        { "{\"orbit\":{\"energy\":1,\"angular_momentum\":5}}", KD_ORBIT_ESCAPE, KD_END_FAR },
        { "{\"orbit\":{\"energy\":1.1,\"angular_momentum\":3}}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"orbit\":{\"energy\":1.1,\"angular_momentum\":0,\"r\":3,\"outward\":true}}", KD_ORBIT_ESCAPE, KD_END_FAR },
        { "{\"orbit\":{\"energy\":1.1,\"angular_momentum\":0,\"r\":300,\"outward\":true}}", KD_ORBIT_ESCAPE,
          KD_END_FAR },
        { "{\"orbit\":{\"position\":{\"r\":10}}}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"orbit\":{\"position\":{\"r\":10,\"theta_deg\":0}},\"spin\":0.9}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"orbit\":{\"p\":5.9,\"e\":0}}", KD_ORBIT_PLUNGE, KD_END_HORIZON },
        { "{\"orbit\":{\"p\":5.9999999999999991,\"e\":0}}", KD_ORBIT_PLUNGE,
          KD_END_DURATION }, /* starts as a circle, but it is unstable: a deviation grows by a factor of e in some
                              * 1e7 turns */
        { "{\"orbit\":{\"p\":6,\"e\":0}}", KD_ORBIT_BOUND, KD_END_DURATION },
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct kd_orbit_request request;
        struct kd_orbit_run run;
        struct kd_orbit_sample *samples = follow(rows[i].text, 100000, &request, &run),
                               *last = &samples[run.samples - 1];
        if (run.orbit.fate != rows[i].fate || run.end != rows[i].end)
            fail_msg("%s: %s, %s", rows[i].text, kd_orbit_fate_name(run.orbit.fate), kd_orbit_end_name(run.end));
        if (!isnan(request.params.time))
            assert_true(fabs(last->place.t / request.params.time - 1) < 1e-9);
        if (run.end == KD_END_HORIZON)
            assert_true(fabs(last->place.r / run.orbit.hole.outer - 1) < 1e-13 && isfinite(last->place.proper) &&
                        !(last->place.t < last[-1].place.t));
        if (run.end == KD_END_FAR)
            assert_true(last->place.r >= 99.9999 && last[-1].place.r < last->place.r);
        if (!(run.worst.energy < 1e-10 && run.worst.carter < 1e-10))
            fail_msg("%s: drift of E %.2g, of Q %.2g", rows[i].text, run.worst.energy, run.worst.carter);
        kd_orbit_request_finish(&request);
        free(samples);
    }
}

/* A fall from rest at r0 to the horizon of Schwarzschild's hole is a cycloid: tau = sqrt(r0^3/8) (eta + sin eta), r
 * = r0 (1 + cos eta)/2 (Misner, Thorne & Wheeler 1973, eq. 25.28). */
static void a_stone_falls(void **state)
{
    (void)state;
    struct kd_orbit_request request;
    struct kd_orbit_run run;
    struct kd_orbit_sample *samples =
        follow("{\"orbit\":{\"position\":{\"r\":10},\"velocity\":{\"frame\":\"static\"}}}", 1000, &request, &run);
    for (uint32_t i = 0; i < run.samples; i++) {
        double eta = acos(fmax(fmin(2 * samples[i].place.r / 10 - 1, 1), -1));
        assert_true(fabs(samples[i].place.proper - sqrt(125) * (eta + sin(eta))) < (i < 20 ? 1e-6 : 1e-10));
    }
    kd_orbit_request_finish(&request);
    free(samples);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refusals),           cmocka_unit_test(every_cut),     cmocka_unit_test(pieces_change_nothing),
        cmocka_unit_test(to_its_end_instead), cmocka_unit_test(methods_agree), cmocka_unit_test(ends),
        cmocka_unit_test(a_stone_falls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
