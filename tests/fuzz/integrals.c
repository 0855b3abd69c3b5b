/* Fuzz target: a request for an integral, whose kind the first byte selects. It is read as JSON, and line by line as
 * NAME=VALUE. */
#include "fuzz.h"

#include "integral/request.h"

static void check(struct kd_integral_request *request, enum kd_status status, const struct kd_error *error)
{
    if (status) {
        kd_fuzz_refused(status, error);
        return;
    }
    CHECK(kd_integral_rows(request) <= KD_INTEGRAL_LIST, "an answer has %zu rows", kd_integral_rows(request));
    if (request->scene)
        kd_fuzz_sound(request->scene);
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin(&out);
    kd_json_object(&json, NULL);
    const struct kd_document document = kd_integral_document(request->what);
    kd_document_write(&json, &document, request);
    kd_json_end(&json);
    CHECK(!kd_json_finish(&json), "a request cannot be written");
    kd_fuzz_json(&out);
    kd_buffer_finish(&out);
}

/* A comparison or a simulation first gets an observation by three stations. */
static void begin(struct kd_integral_request *request, enum kd_integral what)
{
    static const char seen[] = "#SRC:M87,DATE(MJD):57848,FREQ:227.0707GHz\n"
                               "#time(UTC),T1,T2,U(lambda),V(lambda),Iamp(Jy),Iphase(d),Isigma(Jy)\n"
                               "1,AA,LM,1e9,-3e9,0.1,20,0.01\n1,AA,PV,-4e9,-4e9,0.2,-60,0.01\n"
                               "1,LM,PV,-5e9,-1e9,0.3,170,0.01\n";
    kd_integral_request_init(request, what);
    CHECK(!kd_integral_is_observed(what) || !kd_integral_set_observation(request, seen, sizeof seen - 1, NULL),
          "the observation is not read");
}

static void read_lines(enum kd_integral what, const uint8_t *data, size_t size)
{
    struct kd_integral_request request;
    struct kd_error error = { 0 };
    struct kd_fuzz_text line;
    enum kd_status status = KD_OK;
    begin(&request, what);
    while (!status && kd_fuzz_next(&data, &size, &line)) {
        char *value = strchr(line.at, '=');
        if (value) {
            *value++ = 0;
            status = kd_integral_request_set(&request, line.at, value, &error);
        }
        free(line.at);
    }
    if (!status)
        status = kd_integral_request_check(&request, &error);
    check(&request, status, &error);
    kd_integral_request_finish(&request);
}

int kd_fuzz_integrals(const uint8_t *data, size_t size)
{
    static const enum kd_integral known[] = { KD_INTEGRAL_LINE,       KD_INTEGRAL_TRANSFER, KD_INTEGRAL_SPECTRUM,
                                              KD_INTEGRAL_VISIBILITY, KD_INTEGRAL_COMPARE,  KD_INTEGRAL_OBSERVE,
                                              KD_INTEGRAL_IMPULSE,    KD_INTEGRAL_LAGS };
    if (!size)
        return 0;
    const enum kd_integral what = known[*data % 8];
    struct kd_fuzz_text text = kd_fuzz_bare(data + 1, size - 1);
    if (text.size && *text.at != '{')
        read_lines(what, (const uint8_t *)text.at, text.size);
    else {
        struct kd_integral_request request;
        struct kd_error error = { 0 };
        begin(&request, what);
        const enum kd_status status = kd_integral_request_json(&request, text.at, text.size, &error);
        check(&request, status, &error);
        kd_integral_request_finish(&request);
    }
    free(text.at);
    return 0;
}
