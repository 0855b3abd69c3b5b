/* Tests of the requests and answers for rays, as text and bytes: cut at every place, and in pieces of every size. */
#include "render/rays/answer.h"
#include "render/rays/request.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char document[] = " { \"spin\" : -0.5 , \"note\\u0041\":1, "
                               "\"observer\":{\"r\":40,\"inclination_deg\":3e1},\"rays\":[[1,2],\n[-3.5,4e-1] , [0,0]],"
                               "\"orders\":5,\"accuracy\":{\"engine\":\"ks-rk4\",\"precision\":\"f32\",\"steps\":16}}";

/* The copy has exactly that size, so that a sanitizer notices a byte read beyond the end. */
static enum kd_status read_exact(const char *text, size_t length, struct kd_rays_request *request,
                                 struct kd_error *error)
{
    char *copy = malloc(length + 1);
    assert_non_null(copy);
    memcpy(copy, text, length);
    copy[length] = 0;
    kd_rays_request_init(request);
    enum kd_status status = kd_rays_request_json(request, copy, length, error);
    free(copy);
    return status;
}

static void a_document(void **state)
{
    (void)state;
    struct kd_rays_request request;
    struct kd_error error = { 0 };
    char text[sizeof document];
    memcpy(text, document, sizeof document);
    assert_int_equal(read_exact(text, strlen(text), &request, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/noteA");
    kd_rays_request_finish(&request);

    char *note = strstr(text, "\"note");
    memset(note, ' ', strlen("\"note\\u0041\":1,"));
    if (read_exact(text, strlen(text), &request, &error))
        fail_msg("%s", error.message);
    const struct kd_capacity capacity = { .float64 = true };
    assert_int_equal(kd_rays_request_settle(&request, &capacity, &error), KD_OK);
    const struct kd_rays_params want = { -0.5, 40, 30, 5, KD_ENGINE_KS_RK4, KD_PRECISION_F32, 16 };
    assert_true(request.params.spin == want.spin && request.params.r == want.r);
    assert_true(request.params.inclination_deg == want.inclination_deg && request.params.orders == want.orders);
    assert_true(request.params.engine == want.engine && request.params.precision == want.precision);
    assert_int_equal(request.params.steps, want.steps);
    const double rays[] = { 1, 2, -3.5, 0.4, 0, 0 };
    assert_int_equal(request.n, 3);
    assert_memory_equal(request.alpha_beta, rays, sizeof rays);
    kd_rays_request_finish(&request);
}

static void every_cut_and_change(void **state)
{
    (void)state;
    struct kd_rays_request request;
    struct kd_error error;
    for (size_t n = 0; n < sizeof document - 1; n++) {
        assert_int_equal(read_exact(document, n, &request, &error), KD_EINVAL);
        kd_rays_request_finish(&request);
    }
    static const char bytes[] = "\0\"\\[]{},:0-9.eE+ \nxn\x80\xff";
    for (size_t i = 0; i < sizeof document - 1; i++)
        for (size_t k = 0; k < sizeof bytes - 1; k++) {
            char text[sizeof document];
            memcpy(text, document, sizeof document);
            text[i] = bytes[k];
            read_exact(text, sizeof document - 1, &request, &error);
            kd_rays_request_finish(&request);
        }
}

static void fields_by_name(void **state)
{
    (void)state;
    struct kd_rays_request request;
    struct kd_error error;
    kd_rays_request_init(&request);
    assert_true(isinf(request.params.r) && request.n == 0);
    assert_int_equal(kd_rays_request_set(&request, "r", "12.5", &error), KD_OK);
    assert_true(request.params.r == 12.5);
    assert_int_equal(kd_rays_request_set(&request, "r", "infinity", &error), KD_OK);
    assert_true(isinf(request.params.r));
    assert_int_equal(kd_rays_request_set(&request, "engine", "mino-rkn6", &error), KD_OK);
    assert_int_equal(request.asked_accuracy.engine, KD_ENGINE_MINO_RKN6);
    assert_int_equal(kd_rays_request_set(&request, "orders", "3.5", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/orders");
    assert_int_equal(kd_rays_request_set(&request, "a/b", "1", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/a~1b");
    for (int i = 0; i < 100; i++)
        assert_int_equal(kd_rays_request_add(&request, i, -i, &error), KD_OK);
    assert_true(request.n == 100 && request.alpha_beta[199] == -99);
    kd_rays_request_finish(&request);
}

static struct kd_rays_answer some_answer(uint32_t orders)
{
    const struct kd_rays_params params = { 0.5, INFINITY, 60, orders, KD_ENGINE_CLOSED, KD_PRECISION_F64, 0 };
    double *rays = malloc(6 * sizeof *rays);
    struct kd_rays_answer answer;
    assert_non_null(rays);
    memcpy(rays, (double[]) { 1, 2, -3.5, 0.4, 0, 0 }, 6 * sizeof *rays);
    assert_int_equal(kd_rays_answer_init(&answer, &params, rays, 3, NULL), KD_OK);
    for (size_t i = 0; i < 3 * orders; i++)
        answer.crossings[i] = (struct kd_ray_crossing) { NAN, NAN, NAN, NAN };
    for (uint32_t n = 0; n < orders; n++)
        answer.crossings[n] = (struct kd_ray_crossing) { 1.2345678901234567e-300, -1.2345678901234567e-300,
                                                         -9.876543210987654e200, -1.7976931348623157e308 };
    answer.ends[0] = (struct kd_ray_end) { KD_RAY_ESCAPED, orders, 1.2345678901234567e-300, -1.2345678901234567e-300,
                                           1.2345678901234567e-300 };
    answer.ends[1] = (struct kd_ray_end) { KD_RAY_UNDECIDED, 0, NAN, NAN, NAN };
    answer.crossings[2 * orders] = (struct kd_ray_crossing) { 7, 0.5, NAN, 1 };
    answer.ends[2] = (struct kd_ray_end) { KD_RAY_CAPTURED, 1, NAN, NAN, INFINITY };
    assert_int_equal(kd_rays_answer_summarise(&answer, NULL), KD_OK);
    return answer;
}

static struct kd_buffer read_by(const struct kd_rays_answer *answer, enum kd_rays_format format, size_t piece)
{
    struct kd_rays_stream stream;
    struct kd_buffer all = { 0 };
    char bytes[10000];
    size_t n;
    assert_int_equal(kd_rays_stream_init(&stream, answer, format, NULL), KD_OK);
    while ((n = kd_rays_stream_read(&stream, bytes, piece)))
        assert_int_equal(kd_buffer_append(&all, bytes, n), KD_OK);
    assert_int_equal(kd_rays_stream_read(&stream, bytes, piece), 0);
    if (kd_rays_stream_size(&stream))
        assert_int_equal(kd_rays_stream_size(&stream), all.size);
    kd_rays_stream_finish(&stream);
    return all;
}

static void pieces_of_any_size(void **state)
{
    (void)state;
    for (uint32_t orders = 1; orders <= KD_RAYS_MAX_ORDERS; orders += 15) /* the longest row is tested as well */
        for (int format = KD_RAYS_JSON; format <= KD_RAYS_CSV; format++) {
            struct kd_rays_answer answer = some_answer(orders);
            struct kd_buffer whole = read_by(&answer, (enum kd_rays_format)format, 10000);
            for (size_t piece = 1; piece < 700; piece += 11) {
                struct kd_buffer parts = read_by(&answer, (enum kd_rays_format)format, piece);
                assert_int_equal(parts.size, whole.size);
                assert_memory_equal(parts.data, whole.data, whole.size);
                kd_buffer_finish(&parts);
            }
            kd_buffer_finish(&whole);
            kd_rays_answer_finish(&answer);
        }
}

static void what_does_not_exist_is_left_out(void **state)
{
    (void)state;
    struct kd_rays_answer answer = some_answer(1);
    assert_int_equal(answer.undecided, 1);
    struct kd_buffer json = read_by(&answer, KD_RAYS_JSON, 10000), csv = read_by(&answer, KD_RAYS_CSV, 10000);
    const char *text = (const char *)json.data, *tail = strstr(text, ",{\"fate\":\"undecided\"");
    assert_non_null(tail);
    assert_string_equal(tail, ",{\"fate\":\"undecided\",\"crossings\":[]},"
                              "{\"fate\":\"captured\",\"crossings\":[{\"order\":0,\"r\":7,\"phi\":0.5,\"g\":1}]}]}\n");
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf,"));
    tail = strstr((const char *)csv.data, "-3.5,");
    assert_non_null(tail);
    assert_string_equal(tail, "-3.5,0.4,undecided,0,,,,,,,\n0,0,captured,1,,,,7,0.5,,1\n");
    kd_buffer_finish(&json);
    kd_buffer_finish(&csv);
    kd_rays_answer_finish(&answer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_document),
        cmocka_unit_test(every_cut_and_change),
        cmocka_unit_test(fields_by_name),
        cmocka_unit_test(pieces_of_any_size),
        cmocka_unit_test(what_does_not_exist_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
