/* Tests of quantities by name: every table is consistent, requests are read or refused with the reason, ranges may be
 * nested, and all formats of an answer agree. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "quantity/quantity.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct kd_quantity_answer ask(const char *name, const char *const pairs[])
{
    struct kd_quantity_request request;
    struct kd_quantity_answer answer;
    struct kd_error error = { 0 };
    const struct kd_quantity *quantity = kd_quantity_find(name);
    assert_non_null(quantity);
    kd_quantity_request_init(&request, quantity);
    for (; *pairs; pairs += 2)
        if (kd_quantity_request_set(&request, pairs[0], pairs[1], &error))
            fail_msg("%s=%s: %s", pairs[0], pairs[1], error.message);
    if (kd_quantity_evaluate(&request, &answer, &error))
        fail_msg("%s: %s", name, error.message);
    return answer;
}

#define ASK(name, ...) ask(name, (const char *const[]) { __VA_ARGS__, NULL })

static size_t output_index(const struct kd_quantity *quantity, const char *name)
{
    for (size_t i = 0; i < quantity->n_outputs; i++)
        if (!strcmp(quantity->outputs[i].name, name))
            return i;
    fail_msg("%s has no %s", quantity->name, name);
    return 0;
}

static double value(const struct kd_quantity_answer *answer, size_t point, const char *name)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    return answer->values[point * quantity->n_outputs + output_index(quantity, name)];
}

static cJSON *parsed(const struct kd_quantity_answer *answer)
{
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_quantity_json(answer, &text), KD_OK);
    cJSON *json = cJSON_ParseWithLength((const char *)text.data, text.size);
    assert_non_null(json);
    kd_buffer_finish(&text);
    return json;
}

/* Properties of the tables that the other code relies on. */
static void tables_are_sound(void **state)
{
    (void)state;
    assert_true(kd_quantity_count > 0);
    for (size_t q = 0; q < kd_quantity_count; q++) {
        const struct kd_quantity *quantity = kd_quantities[q];
        assert_ptr_equal(kd_quantity_find(quantity->name), quantity);
        assert_true(quantity->sources[0] && quantity->approximations);
        assert_true(quantity->point_us > 0 && quantity->summary[0] >= 'a' && quantity->summary[0] <= 'z');
        for (size_t i = 0; i < quantity->n_parameters; i++) {
            const struct kd_row *p = &quantity->parameters[i];
            struct kd_quantity_request request;
            kd_quantity_request_init(&request, quantity);
            assert_int_equal(kd_quantity_request_set(&request, p->name, p->typed, NULL), KD_OK);
            assert_true(p->help && (p->kind == KD_KIND_WORD || (p->unit && p->least < p->most)));
        }
        for (size_t i = 0; i < quantity->n_outputs; i++)
            assert_true(quantity->outputs[i].unit && quantity->outputs[i].help);
    }
    assert_null(kd_quantity_find("nothing"));
}

static void defaults_answer(void **state)
{
    (void)state;
    for (size_t q = 0; q < kd_quantity_count; q++) {
        struct kd_quantity_answer answer = ask(kd_quantities[q]->name, (const char *const[]) { NULL });
        size_t finite = 0;
        for (size_t i = 0; i < answer.points * kd_quantities[q]->n_outputs; i++)
            finite += isfinite(answer.values[i]);
        assert_true(2 * finite > answer.points * kd_quantities[q]->n_outputs);
        /* A request with default values takes at most some 50 ms, except for the kernel of returning light. */
        assert_true(kd_quantity_cost_ms(&answer.request) < 400);
        cJSON_Delete(parsed(&answer));
        kd_quantity_answer_finish(&answer);
    }
}

/* Each point of a range over parameter i equals the answer for that value alone. */
static void points_of(struct kd_quantity_request request, size_t i)
{
    struct kd_quantity_answer curve, point;
    const struct kd_row *p = &request.quantity->parameters[i];
    size_t outputs = request.quantity->n_outputs, inner = 1;
    double at = request.axes[i].first;
    request.axes[i] = (struct kd_range) { at, at + 0.04 * (p->most < 2 * at + 1 ? p->most - at : at + 1), 3 };
    assert_int_equal(kd_quantity_evaluate(&request, &curve, NULL), KD_OK);
    for (size_t k = i + 1; k < request.quantity->n_parameters; k++)
        inner *= request.axes[k].count;
    for (size_t k = 0; k < 3; k++) {
        struct kd_quantity_request single = request;
        single.axes[i].first = single.axes[i].last = kd_range_at(&request.axes[i], k);
        single.axes[i].count = 1;
        assert_int_equal(kd_quantity_evaluate(&single, &point, NULL), KD_OK);
        for (size_t o = 0; o < point.points / inner; o++)
            assert_memory_equal(point.values + o * inner * outputs, curve.values + (o * 3 + k) * inner * outputs,
                                inner * outputs * sizeof *point.values);
        kd_quantity_answer_finish(&point);
    }
    kd_quantity_answer_finish(&curve);
}

/* Values that are cached from point to point do not change the results, whether or not other parameters are ranges. */
static void points_stand_alone(void **state)
{
    (void)state;
    for (size_t q = 0; q < kd_quantity_count; q++)
        for (size_t i = 0; i < kd_quantities[q]->n_parameters; i++) {
            const struct kd_row *p = &kd_quantities[q]->parameters[i];
            struct kd_quantity_request request;
            kd_quantity_request_init(&request, kd_quantities[q]);
            if (p->kind != KD_KIND_REAL || isinf(request.axes[i].first))
                continue;
            points_of(request, i);
            for (size_t k = 0; k < kd_quantities[q]->n_parameters; k++)
                request.axes[k] = (struct kd_range) { request.axes[k].last, request.axes[k].last, 1 };
            points_of(request, i);
        }
}

static void bad_requests(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *pointer, *words;
    } cases[] = {
        { "spin", "1", "/spin", "above -1 and below 1" },
        { "spin", "-1", "/spin", "spin is -1; it must be a number above -1" },
        { "spin", "", "/spin", "spin" },
        { "spin", "nan", "/spin", "\"nan\"" },
        { "spin", "1e999", "/spin", "a number beyond 1e308" },
        { "spin", " 0.5", "/spin", "spin" },
        { "spin", "0.5x", "/spin", "0.5x" },
        { "spin", "0:0.5", "/spin", "first:last:count" },
        { "spin", "0:0.5:1", "/spin", "2" },
        { "spin", "0:0.5:2.5", "/spin", "2.5" },
        { "spin", "0:0.5:100001", "/spin", "100000" },
        { "spin", "0:1:5", "/spin", "0:1:5" },
        { "spin", "0:0.5:2:2", "/spin", "spin" },
        { "spin", "isco", "/spin", "isco" },
        { "r", "0.5", "/r", "\"isco\"" },
        { "r", "isco:10:2", "/r", "isco" },
        { "mass", "1", "/mass", "parameters are spin, charge, theta_deg, r" },
        { "a/b~", "1", "/a~1b~0", "a/b~" },
        { "digits", "0", "/digits", "1 to 17" },
        { "digits", "2.5", "/digits", "digits is 2.5; it must be a whole number" },
        { "digits", "2:6:3", "/digits", "a whole number" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_quantity_request request, before;
        struct kd_error error = { 0 };
        kd_quantity_request_init(&request, kd_quantity_find("kerr"));
        before = request;
        assert_int_equal(kd_quantity_request_set(&request, cases[i].name, cases[i].text, &error), KD_EINVAL);
        assert_string_equal(error.pointer, cases[i].pointer);
        if (!strstr(error.message, cases[i].words))
            fail_msg("%s=%s: no \"%s\" in \"%s\"", cases[i].name, cases[i].text, cases[i].words, error.message);
        assert_memory_equal(&request, &before, sizeof request);
    }
}

static void outside_the_domain(void **state)
{
    (void)state;
    struct kd_quantity_request request;
    struct kd_quantity_answer answer;
    struct kd_error error = { 0 };
    kd_quantity_request_init(&request, kd_quantity_find("kerr"));
    kd_quantity_request_set(&request, "r", "1.25", NULL);
    assert_int_equal(kd_quantity_evaluate(&request, &answer, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/r");
    assert_non_null(strstr(error.message, "at least 1.43588989 M, the horizon"));
    kd_quantity_request_set(&request, "spin", "0.5:0.999:7", NULL); /* enough samples for the first point only */
    assert_int_equal(kd_quantity_evaluate(&request, &answer, &error), KD_EINVAL);
    kd_quantity_request_set(&request, "r", "2", NULL);
    kd_quantity_request_set(&request, "spin", "0.5:0.999:501", NULL);
    kd_quantity_request_set(&request, "theta_deg", "0:90:500", NULL);
    assert_int_equal(kd_quantity_evaluate(&request, &answer, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "100000 points"));
}

static void ranges_nest(void **state)
{
    (void)state;
    struct kd_quantity_answer answer = ASK("kerr", "spin", "0:0.9:2", "theta_deg", "0:90:3", "r", "10:20:2");
    assert_int_equal(answer.points, 12);
    assert_true(value(&answer, 0, "horizon") == 2 && value(&answer, 5, "horizon") == 2);
    assert_true(value(&answer, 6, "horizon") < 1.5 && value(&answer, 11, "ergosphere") == 2);
    assert_true(value(&answer, 6, "ergosphere") < value(&answer, 8, "ergosphere"));
    assert_true(value(&answer, 10, "omega_phi") > 2 * value(&answer, 11, "omega_phi"));
    cJSON *json = parsed(&answer), *shape = cJSON_GetObjectItem(json, "shape"),
          *ranges = cJSON_GetObjectItem(json, "ranges");
    assert_int_equal(cJSON_GetArraySize(shape), 3);
    assert_int_equal(cJSON_GetArrayItem(shape, 1)->valueint, 3);
    assert_string_equal(cJSON_GetArrayItem(ranges, 0)->valuestring, "spin");
    assert_string_equal(cJSON_GetArrayItem(ranges, 2)->valuestring, "r");
    cJSON *values = cJSON_GetObjectItem(json, "values");
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(values, "horizon")), 12);
    cJSON_Delete(json);
    kd_quantity_answer_finish(&answer);
}

/* If r is a range, the answer gives a property of the hole as a single number. */
static void json_of_a_curve(void **state)
{
    (void)state;
    struct kd_quantity_answer answer = ASK("kerr", "r", "2.:.1e2:5", "spin", ".0");
    cJSON *json = parsed(&answer), *values = cJSON_GetObjectItem(json, "values");
    cJSON *r = cJSON_GetObjectItem(cJSON_GetObjectItem(json, "parameters"), "r");
    assert_true(cJSON_IsNumber(cJSON_GetObjectItem(values, "isco")));
    assert_int_equal(cJSON_GetArraySize(r), 5);
    assert_true(cJSON_GetArrayItem(r, 1)->valuedouble == 4 && cJSON_GetArrayItem(r, 4)->valuedouble == 10);
    cJSON *kappa = cJSON_GetObjectItem(values, "kappa"), *omega = cJSON_GetObjectItem(values, "omega_phi");
    assert_true(cJSON_IsNull(cJSON_GetArrayItem(kappa, 1)) && cJSON_IsNull(cJSON_GetArrayItem(omega, 0)));
    assert_true(cJSON_GetArrayItem(omega, 1)->valuedouble == 0.125);
    assert_true(cJSON_GetArrayItem(kappa, 4)->valuedouble == value(&answer, 4, "kappa"));
    assert_null(cJSON_GetObjectItem(json, "shape"));
    assert_string_equal(cJSON_GetObjectItem(cJSON_GetObjectItem(json, "units"), "kappa")->valuestring, "1/M");
    cJSON_Delete(json);
    kd_quantity_answer_finish(&answer);
}

/* For a hole without spin the separatrix is 6 + 2e, whatever the inclination; for a spinning one it is the ISCO at e
 * = 0. */
static void separatrix_by_known_ones(void **state)
{
    (void)state;
    struct kd_quantity_answer still = ASK("separatrix", "spin", "0", "inclination_deg", "0:180:3", "e", "0:0.9:4"),
                              turns = ASK("separatrix", "spin", "0.9");
    struct kd_buffer text = { 0 };
    double spin, inclination, e, p, r_min, r_max;
    assert_int_equal(kd_quantity_csv(&still, &text), KD_OK);
    char *rest, *line = strtok_r((char *)text.data, "\n", &rest);
    for (int i = 0; i < 12; i++) {
        line = strtok_r(NULL, "\n", &rest);
        assert_int_equal(sscanf(line, "%lf,%*f,%lf,%lf,%lf,%lf,%lf", &spin, &inclination, &e, &p, &r_min, &r_max), 6);
        assert_float_equal(p, 6 + 2 * e, 1e-12);
        assert_float_equal(r_min * (1 + e), p, 1e-12);
        assert_float_equal(r_max * (1 - e), p, 1e-12);
    }
    kd_buffer_finish(&text);
    assert_int_equal(kd_quantity_csv(&turns, &text), KD_OK);
    line = strtok_r((char *)text.data, "\n", &rest);
    line = strtok_r(NULL, "\n", &rest);
    assert_int_equal(sscanf(line, "%lf,%*f,%lf,%lf,%lf", &spin, &inclination, &e, &p), 4);
    assert_float_equal(p, 2.3208830417618866, 1e-12);
    kd_buffer_finish(&text);
    kd_quantity_answer_finish(&still);
    kd_quantity_answer_finish(&turns);
}

/* Separatrices and photon orbits are compared with closed forms for spin 0.9. These are the retrograde ISCO; a
 * parabola, whose p is twice the marginally bound radius 2 - a + 2 sqrt(1 - a) (Bardeen, Press & Teukolsky 1972; a < 0
 * for the retrograde one); the photon orbits in the equator (same paper) and over the poles (Teo 2003, Gen. Rel. Grav.
 * 35, 1909). */
static void separatrix_of_a_spinning_hole(void **state)
{
    (void)state;
    const double a = 0.9, pole = 1 + 2 * sqrt(1 - a * a / 3) * cos(acos((1 - a * a) / pow(1 - a * a / 3, 1.5)) / 3);
    const struct {
        const char *inclination, *e;
        double p, circle, off;
    } all[] = {
        { "180", "0", 8.717352279606489, 2 * (1 + cos(2. / 3 * acos(a))), 1e-12 },
        { "0", "0.999999", 2 * (2 - a + 2 * sqrt(1 - a)), 2 * (1 + cos(2. / 3 * acos(-a))), 1e-5 },
        { "180", "0.999999", 2 * (2 + a + 2 * sqrt(1 + a)), 2 * (1 + cos(2. / 3 * acos(a))), 1e-5 },
        { "90", "0", NAN, pole, NAN },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        struct kd_quantity_answer answer =
            ASK("separatrix", "spin", "0.9", "inclination_deg", all[i].inclination, "e", all[i].e);
        struct kd_buffer text = { 0 };
        double in[3], p, r_min, r_max, circle;
        assert_int_equal(kd_quantity_csv(&answer, &text), KD_OK);
        assert_int_equal(sscanf(strchr((char *)text.data, '\n') + 1, "%lf,%*f,%lf,%lf,%lf,%lf,%lf,%lf", &in[0], &in[1],
                                &in[2], &p, &r_min, &r_max, &circle),
                         7);
        if (!isnan(all[i].p))
            assert_float_equal(p, all[i].p, all[i].off);
        assert_float_equal(circle, all[i].circle, 1e-9);
        kd_buffer_finish(&text);
        kd_quantity_answer_finish(&answer);
    }
}

static void csv_has_a_line_a_point(void **state)
{
    (void)state;
    struct kd_quantity_answer answer =
        ASK("frame-dragging", "spin", "0.5:0.75:2", "r", "2:10:3", "theta_deg", "0:90:2");
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_quantity_csv(&answer, &text), KD_OK);
    char *line = strtok((char *)text.data, "\n");
    assert_string_equal(line,
                        "spin,charge,theta_deg,r,omega,far_field,omega_least,omega_most,horizon_omega,ergosphere");
    for (size_t point = 0; point < 12; point++) {
        double spin, theta, r, omega;
        line = strtok(NULL, "\n");
        assert_int_equal(sscanf(line, "%lf,%*f,%lf,%lf,%lf", &spin, &theta, &r, &omega), 4);
        assert_true(spin == (point < 6 ? 0.5 : 0.75) && theta == (point % 6 < 3 ? 0 : 90) &&
                    r == 2 + 4 * (double)(point % 3));
        assert_true(omega == value(&answer, point, "omega"));
        assert_int_equal(strstr(line, ",,,") != NULL, point % 6 < 3); /* on the axis there is no cone */
    }
    assert_null(strtok(NULL, "\n"));
    kd_buffer_finish(&text);
    kd_quantity_answer_finish(&answer);
}

/* Numbers in lists have a limited number of digits and are correctly rounded; a single number has all of its digits. */
static void digits_of_lists(void **state)
{
    (void)state;
    struct kd_quantity_answer all = ASK("frame-dragging", "spin", "0.7", "r", "2:10:7"),
                              few = ASK("frame-dragging", "spin", "0.7", "r", "2:10:7", "digits", "4");
    cJSON *whole = parsed(&all), *cut = parsed(&few);
    const cJSON *omega = cJSON_GetObjectItem(cJSON_GetObjectItem(cut, "values"), "omega"),
                *r = cJSON_GetObjectItem(cJSON_GetObjectItem(cut, "parameters"), "r");
    for (int i = 0; i < 7; i++) {
        char want[32];
        snprintf(want, sizeof want, "%.3e", value(&all, (size_t)i, "omega"));
        assert_true(cJSON_GetArrayItem(omega, i)->valuedouble == strtod(want, NULL));
    }
    assert_true(cJSON_GetArrayItem(r, 1)->valuedouble == 3.333);
    const char *alone = "horizon_omega";
    assert_true(cJSON_GetObjectItem(cJSON_GetObjectItem(cut, "values"), alone)->valuedouble ==
                cJSON_GetObjectItem(cJSON_GetObjectItem(whole, "values"), alone)->valuedouble);
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_quantity_csv(&few, &text), KD_OK);
    assert_non_null(strstr((const char *)text.data, "\n0.7,0,90,3.333,"));
    kd_buffer_finish(&text);
    cJSON_Delete(whole);
    cJSON_Delete(cut);
    kd_quantity_answer_finish(&all);
    kd_quantity_answer_finish(&few);
}

static void words_are_kept(void **state)
{
    (void)state;
    struct kd_quantity_answer answer = ASK("kerr", "r", "isco");
    cJSON *json = parsed(&answer), *parameters = cJSON_GetObjectItem(json, "parameters");
    assert_string_equal(cJSON_GetObjectItem(parameters, "r")->valuestring, "isco");
    assert_true(value(&answer, 0, "kappa") == 0 && value(&answer, 0, "energy") == value(&answer, 0, "isco_energy"));
    cJSON_Delete(json);
    kd_quantity_answer_finish(&answer);
}

static void the_list_parses(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_quantity_list_json(&text), KD_OK);
    cJSON *json = cJSON_ParseWithLength((const char *)text.data, text.size);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(json, "quantities")), (int)kd_quantity_count);
    cJSON_Delete(json);
    kd_buffer_finish(&text);
}

static void the_page_is_up_to_date(void **state)
{
    (void)state;
    struct kd_buffer page = { 0 };
    assert_int_equal(kd_quantity_reference(&page), KD_OK);
    char *kept = calloc(1, page.size + 2);
    FILE *file = fopen(KD_REFERENCE, "r");
    assert_non_null(file);
    size_t n = fread(kept, 1, page.size + 1, file);
    fclose(file);
    if (n != page.size || memcmp(kept, page.data, n))
        fail_msg("%s is old: build/src/quantity/kd_quantity_reference > docs/physics-quantities.md", KD_REFERENCE);
    free(kept);
    kd_buffer_finish(&page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_sound),         cmocka_unit_test(defaults_answer),
        cmocka_unit_test(points_stand_alone),       cmocka_unit_test(bad_requests),
        cmocka_unit_test(outside_the_domain),       cmocka_unit_test(ranges_nest),
        cmocka_unit_test(json_of_a_curve),          cmocka_unit_test(csv_has_a_line_a_point),
        cmocka_unit_test(separatrix_by_known_ones), cmocka_unit_test(separatrix_of_a_spinning_hole),
        cmocka_unit_test(digits_of_lists),          cmocka_unit_test(words_are_kept),
        cmocka_unit_test(the_list_parses),          cmocka_unit_test(the_page_is_up_to_date),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
