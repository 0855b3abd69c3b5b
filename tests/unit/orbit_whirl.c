/* Tests of bodies that whirl round an unstable circular orbit, for E about 1 and L on both sides of the circle's L.
 * Either the answer is right within the error that it states, or the request is refused. Reference: quadrature with 30
 * digits, tests/oracle/whirl_reference.py. */
#include "orbit/run.h"
#include "whirl_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))
#define SAMPLES 9

static const enum kd_orbit_fate fates[] = { [WHIRL_BOUND] = KD_ORBIT_BOUND,
                                            [WHIRL_PLUNGE] = KD_ORBIT_PLUNGE,
                                            [WHIRL_ESCAPE] = KD_ORBIT_ESCAPE };

struct answer {
    enum kd_orbit_fate fate;
    enum kd_orbit_end end;
    double from, mino, proper, t, phi, r, stated, drift;
};

static enum kd_status ask(const char *text, struct answer *out, struct kd_error *error)
{
    struct kd_orbit_request request;
    struct kd_orbit_run run, *runs[] = { &run };
    struct kd_orbit_sample samples[SAMPLES];
    size_t n = 0;
    kd_orbit_request_init(&request);
    *error = (struct kd_error) { 0 };
    enum kd_status status = kd_orbit_request_json(&request, text, strlen(text), error);
    status = status ? status : kd_orbit_run_init(&run, &request, 0, error);
    status = status ? status : kd_orbit_run_prepare(runs, 1, error);
    while (!status && !kd_orbit_run_done(&run))
        n += kd_orbit_run_advance(&run, 1000000, samples + n, SAMPLES - n);
    if (!status) {
        const struct kd_orbit_place *last = &samples[n - 1].place;
        assert_int_equal(n, SAMPLES);
        for (size_t i = 0; i < n && run.end != KD_END_HORIZON; i++)
            assert_true(isfinite(samples[i].place.t) && isfinite(samples[i].place.phi) && samples[i].place.r > 0);
        *out = (struct answer) { run.orbit.fate, run.end, samples[0].place.r, last->mino,      last->proper, last->t,
                                 last->phi,      last->r, run.error_estimate, run.worst.energy };
        if (run.orbit.fate == KD_ORBIT_BOUND) {
            const struct kd_orbit_frequencies *f = &run.frequencies;
            out->mino = run.period, out->phi = f->mino_phi * run.period, out->t = f->mino_t * run.period;
            out->proper = f->mino_proper * run.period;
        }
    }
    kd_orbit_request_finish(&request);
    return status;
}

static void right_or_refused(void **state)
{
    (void)state;
    unsigned refused = 0;
    double worst = 0;
    for (size_t i = 0; i < COUNT(whirl_reference); i++) {
        const struct whirl_reference *row = &whirl_reference[i];
        struct kd_error error;
        struct answer a;
        char text[300], r[40] = "";
        if (row->from == 100)
            snprintf(r, sizeof r, ",\"r\":100");
        snprintf(text, sizeof text,
                 "{\"spin\":%.17g,\"orbit\":{\"energy\":%.17g,\"angular_momentum\":%.17g%s},\"samples\":%d,"
                 "\"tolerance\":1e-10%s}",
                 row->spin, row->energy, row->momentum, r, SAMPLES,
                 row->fate == WHIRL_BOUND ? ",\"method\":\"closed\",\"duration\":{\"periods\":1}" : "");
        if (ask(text, &a, &error)) {
            if (fabs(row->beside) > 1.1e-12 || !strstr(error.message, "whirls") ||
                strcmp(error.pointer, "/orbit/angular_momentum"))
                fail_msg("%s: %s at %s", text, error.message, error.pointer);
            refused++;
            continue;
        }
        double off = fmax(fabs(a.mino / row->mino - 1), fabs(a.proper / row->proper - 1));
        if (row->fate != WHIRL_PLUNGE)
            off = fmax(off, fmax(fabs(a.t / row->t - 1), fabs(a.phi / row->phi - 1)));
        double bound = fmax(isnan(a.stated) ? 0 : a.stated, 1e-9);
        worst = fmax(worst, off / bound);
        bool ended = a.end == (row->fate == WHIRL_PLUNGE  ? KD_END_HORIZON
                               : row->fate == WHIRL_BOUND ? KD_END_DURATION
                                                          : KD_END_FAR);
        if (a.fate != fates[row->fate] || !ended || !(off <= bound) || !(a.drift < 1e-9))
            fail_msg("%s: %s, ends at r = %.9g; off by %.2g, stated %.2g; drift of E %.2g", text,
                     kd_orbit_fate_name(a.fate), a.r, off, a.stated, a.drift);
    }
    print_message("%u of %zu refused; the worst error is %.2g of what is stated\n", refused, COUNT(whirl_reference),
                  worst);
    assert_true(refused > 10 && refused <= COUNT(whirl_reference) / 4);
}

static void next_to_the_whirl_itself(void **state)
{
    (void)state;
    static const char *const refused[] = {
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":4},\"samples\":9}",
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":4.000000000000001},\"samples\":9}",
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":3.999999999999999},\"samples\":9}",
        "{\"spin\":0.9,\"orbit\":{\"energy\":1,\"angular_momentum\":2.632455532033676},\"samples\":9}",
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":4,\"r\":3,\"outward\":true},\"samples\":9}",
    };
    static const char *const answered[] = {
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":4,\"r\":4},\"samples\":9}", /* the unstable circle */
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":4,\"r\":3},\"samples\":9}", /* beside the circle, on
                                                                                                 either side */
        "{\"spin\":0,\"orbit\":{\"energy\":1,\"angular_momentum\":4,\"r\":20,\"outward\":true},\"samples\":9}",
    };
    struct kd_error error;
    struct answer a;
    for (size_t i = 0; i < COUNT(refused); i++)
        if (ask(refused[i], &a, &error) != KD_EINVAL || !strstr(error.message, "whirls"))
            fail_msg("%s: %s, ends at r = %.9g %s", refused[i], kd_orbit_fate_name(a.fate), a.r, error.message);
    for (size_t i = 0; i < COUNT(answered); i++)
        if (ask(answered[i], &a, &error) || !(a.drift < 1e-9))
            fail_msg("%s: %s, drift of E %.2g", answered[i], error.message, a.drift);
}

/* With E = 1 infinity is a turning point, and a long step near it could go out and come back. To leading order t
 * from the middle to r_max is that of a radial fall; quadrature gives 942840164.003769 (in both directions, L = 6). */
static void lets_go_before_infinity(void **state)
{
    (void)state;
    struct kd_error error;
    struct answer a;
    assert_int_equal(ask("{\"orbit\":{\"energy\":1,\"angular_momentum\":6},\"r_max\":1e6,\"samples\":9}", &a, &error),
                     KD_OK);
    assert_int_equal(a.end, KD_END_FAR);
    if (!(fabs(a.t / 942840164.003769 - 1) < 1e-10 && fabs(a.mino / 1.16278738302296 - 1) < 1e-12 &&
          fabs(a.r / 1e6 - 1) < 1e-12))
        fail_msg("t %.15g, Mino time %.15g, r %.15g, stated %.2g", a.t, a.mino, a.r, a.stated);
}

/* If r_max is far away, the first search for the end takes steps that are too long for the whirl. With these values, in
 * an earlier version, the body fell through the circle instead of whirling. Expected values are from the quadrature of
 * tests/oracle/whirl_reference.py, from r_max to the whirl and back. Its nodes are also dense towards infinity. */
static void ends_where_r_max_is_far(void **state)
{
    (void)state;
    static const struct far_body {
        double energy, momentum, r_max, mino, proper, t, phi;
    } bodies[] = {
        { 1.05, 2.7899008057571306, 100, 13.819239107740556, 544.28593034082844, 797.59749491946985,
          74.593215313465602 },
        { 1.05, 2.7899008057571306, 1000, 13.87277346284209, 6035.4045928601301, 6592.6567072541177,
          74.743124535485341 },
        { 1.05, 2.7899008057571306, 1e6, 13.878984063675475, 6246319.0453624045, 6558980.9989707309,
          74.760457364390329 },
        { 1.0000001, 2.632455850090601, 100, 15.578110807984626, 1029.9638011160692, 1282.2143855388984,
          77.157602792665936 },
        { 1.0000001, 2.632455850090601, 1000, 15.773106553413602, 30007.034935584463, 30383.061072413272,
          77.672590103787784 },
        { 1.0000001, 2.632455850090601, 1e6, 15.859638946666418, 915953034.45390934, 915958890.41503689,
          77.900436546934602 },
    };
    double worst = 0;
    for (size_t i = 0; i < COUNT(bodies); i++) {
        const struct far_body *b = &bodies[i];
        struct kd_error error;
        struct answer a;
        char text[200];
        snprintf(text, sizeof text,
                 "{\"spin\":0.9,\"orbit\":{\"energy\":%.17g,\"angular_momentum\":%.17g},\"r_max\":%g,\"samples\":%d}",
                 b->energy, b->momentum, b->r_max, SAMPLES);
        if (ask(text, &a, &error)) {
            if (b->r_max < 1e6 || strcmp(error.pointer, "/r_max"))
                fail_msg("%s: %s at %s", text, error.message, error.pointer);
            continue;
        }
        double off = fmax(fmax(fabs(a.mino / b->mino - 1), fabs(a.proper / b->proper - 1)),
                          fmax(fabs(a.t / b->t - 1), fabs(a.phi / b->phi - 1)));
        worst = fmax(worst, off);
        if (a.fate != KD_ORBIT_ESCAPE || a.end != KD_END_FAR || !(off < 1e-3) || !(off <= a.stated) ||
            !(fabs(a.r / b->r_max - 1) < 1e-9))
            fail_msg("%s: end %s at r = %.9g, Mino time %.9g; off by %.2g, stated %.2g", text, kd_orbit_end_name(a.end),
                     a.r, a.mino, off, a.stated);
    }
    print_message("r_max far away: the worst error is %.2g\n", worst);
}

/* The message must show enough digits to distinguish the given value from that of the whirl. */
static void refusal_shows_every_digit(void **state)
{
    (void)state;
    struct kd_error error;
    struct answer a;
    assert_int_equal(ask("{\"orbit\":{\"energy\":1,\"angular_momentum\":4.000000000000001},\"samples\":9}", &a, &error),
                     KD_EINVAL);
    assert_non_null(strstr(error.message, "energy 1 and angular_momentum 4.000000000000001 are too close"));
    assert_int_equal(ask("{\"orbit\":{\"energy\":1,\"angular_momentum\":4},\"samples\":9}", &a, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "energy 1 and angular_momentum 4 are too close"));
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(right_or_refused), cmocka_unit_test(next_to_the_whirl_itself),
                                        cmocka_unit_test(lets_go_before_infinity),
                                        cmocka_unit_test(ends_where_r_max_is_far),
                                        cmocka_unit_test(refusal_shows_every_digit) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
