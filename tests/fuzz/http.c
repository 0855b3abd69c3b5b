/* Fuzz target: the head of a request. Each line of the input is a part of it: target, base path, Accept,
 * Accept-Encoding, If-None-Match, Content-Type, Host, X-Request-Id, Last-Event-ID. All lines are optional. */
#include "fuzz.h"

#include "base/utf8.h"
#include "server/http/negotiate.h"
#include "server/http/request.h"
#include "server/http/request_id.h"

enum { LINES = 9 };

static void check_target(const char *raw, const struct kd_base_path *base)
{
    static const char *const methods[] = { "GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "BREW" };
    static const char *const known[] = { "order", "since", NULL }, *const former[] = { "least", NULL };
    struct kd_target target;
    struct kd_error error = { 0 };
    uint64_t number;
    enum kd_status status = kd_target_parse(&target, raw, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        CHECK(kd_utf8_valid(target.path) && target.n_pairs <= KD_TARGET_PAIRS, "a target that was read is none: %s",
              raw);
        for (size_t i = 0; i < target.n_pairs; i++)
            CHECK(kd_utf8_valid(target.pairs[i].name) && kd_target_value(&target, target.pairs[i].name),
                  "a pair of %s is not there", raw);
        if (kd_target_whole(&target, "order", 7, 1000, &number))
            CHECK(number <= 1000, "order is %llu", (unsigned long long)number);
        if ((status = kd_target_only(&target, known, former, &error)))
            kd_fuzz_refused(status, &error);
        struct kd_server server = { .base = *base };
        struct kd_problem problem = { 0 };
        struct kd_request request = { .server = &server, .target = target, .method = methods[strlen(raw) % 7] };
        const bool found = kd_route_find(&request, &problem);
        CHECK(found ? request.route && request.rest : problem.detail && *problem.detail,
              "what is not found says nothing");
        struct kd_buffer text = { 0 };
        CHECK(found || !kd_problem_to_json(&problem, &text), "a problem cannot be written");
        if (!found)
            kd_fuzz_json(&text);
        kd_buffer_finish(&text);
    }
    kd_target_finish(&target);
}

/* A request is recognised as a health check from its beginning. The whole request must then be a health check. */
static void check_begins(const char *raw, const struct kd_base_path *base)
{
    struct kd_buffer line = { 0 };
    CHECK(!kd_buffer_printf(&line, "GET %s HTTP/1.1", raw), "out of memory");
    const enum kd_begins whole = kd_route_begins(base, (char *)line.data, line.size);
    for (size_t n = 0; n < line.size && n < KD_BEGINS_BYTES; n++) {
        const enum kd_begins part = kd_route_begins(base, (char *)line.data, n);
        CHECK(part == whole || part == KD_BEGINS_UNCLEAR, "%zu bytes of %s begin otherwise than all", n, raw);
    }
    if (!strchr(raw, ' '))
        CHECK((whole == KD_BEGINS_HEALTH) == kd_route_is_health(base, raw),
              "%s is of health by one, and not by the other", raw);
    kd_buffer_finish(&line);
}

/* Blanks round a list, and an empty entry in it, must not change the result. */
static void check_accept(const char *accept, const char *encoding)
{
    static const char *const types[] = { "image/png", "application/json", "text/csv", "application/x-npy" };
    struct kd_buffer wide = { 0 };
    const size_t best = kd_accept_best(accept, 4, kd_accept_string, types);
    CHECK(best <= 4, "the type %zu is best", best);
    if (accept[strspn(accept, " \t")] && !strchr(accept, '"')) {
        CHECK(!kd_buffer_printf(&wide, " ,%s\t, ,", accept), "out of memory");
        CHECK(kd_accept_best((char *)wide.data, 4, kd_accept_string, types) == best, "\"%s\" is otherwise with blanks",
              accept);
    }
    CHECK(kd_accept_best(NULL, 4, kd_accept_string, types) == 0, "nothing asked for is not the first");
    kd_accepts_coding(encoding, "gzip");
    kd_buffer_finish(&wide);
}

static void check_base(const char *text, struct kd_base_path *base)
{
    struct kd_error error = { 0 };
    const enum kd_status status = kd_base_path_init(base, text, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        kd_base_path_init(base, NULL, NULL);
        return;
    }
    CHECK(!strcmp(base->path, text) && kd_base_path_behind(base, text), "the base path %s became %s", text, base->path);
    CHECK(!*text || (*text == '/' && text[strlen(text) - 1] != '/'), "%s is a base path", text);
}

static void check_others(const char *etag, const char *type, const char *host)
{
    static const char *const hosts[] = { "localhost", "127.0.0.1", "[::1]", NULL };
    if (*etag && !strpbrk(etag, "\",*\\ \t")) {
        char quoted[100];
        snprintf(quoted, sizeof quoted, "\"%.90s\"", etag);
        CHECK(kd_etag_listed(quoted, quoted) && kd_etag_listed("*", quoted) && !kd_etag_listed(NULL, quoted),
              "%s does not list itself", quoted);
    }
    kd_etag_listed(etag, "\"abc-1\"");
    kd_media_type_is(type, "application/json");
    kd_host_listed(host, hosts);
    CHECK(!kd_host_listed("", hosts), "no host is one");
}

/* A request's own id is used if it may appear in a log and a header. Otherwise a new id is made. A number is accepted
 * only in its canonical form. */
static void check_numbers(const char *id, const char *event)
{
    static const char letters[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-._+/=";
    char chosen[KD_REQUEST_ID_MAX + 1];
    uint64_t number = 0;
    kd_request_id_choose(id, chosen);
    CHECK(*chosen && strlen(chosen) <= KD_REQUEST_ID_MAX && chosen[strspn(chosen, letters)] == 0,
          "\"%s\" is who asks, by \"%s\"", chosen, id);
    if (kd_target_number(event, UINT64_MAX, &number)) {
        char text[32];
        snprintf(text, sizeof text, "%llu", (unsigned long long)number);
        CHECK(!strcmp(text, event + strspn(event, "0") - (number == 0 && *event)), "\"%s\" is the number %s", event,
              text);
    }
}

int kd_fuzz_http(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text lines[LINES];
    struct kd_base_path base;
    for (size_t i = 0; i < LINES; i++)
        if (!kd_fuzz_next(&data, &size, &lines[i]))
            lines[i] = kd_fuzz_copy(NULL, 0);
    check_base(lines[1].at, &base);
    check_target(lines[0].at, &base);
    check_begins(lines[0].at, &base);
    check_accept(lines[2].at, lines[3].at);
    check_others(lines[4].at, lines[5].at, lines[6].at);
    check_numbers(lines[7].at, lines[8].at);
    for (size_t i = 0; i < LINES; i++)
        free(lines[i].at);
    return 0;
}
