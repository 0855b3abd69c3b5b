#include "server/http/once.h"

#include "scene/sha256.h"
#include "server/http/reply.h"
#include "server/http/request.h"

#include <stdio.h>
#include <string.h>

static void add(struct sha256_ctx *hash, const char *text)
{
    sha256_update(hash, strlen(text) + 1, (const void *)text);
}

static void digest(struct sha256_ctx *hash, char out[65])
{
    uint8_t bytes[SHA256_DIGEST_SIZE];
    sha256_digest(hash, sizeof bytes, bytes);
    kd_sha256_text(bytes, out);
}

/* Parses a String (RFC 9651 3.3.3). The quotes are optional, because many clients omit them; *out has no quotes.
 * Backslash escapes are refused. */
static bool key_of(const char *value, char out[KD_ONCE_MOST + 1])
{
    const size_t all = strlen(value), quoted = all >= 2 && *value == '"' && value[all - 1] == '"', n = all - 2 * quoted;
    if (!n || n > KD_ONCE_MOST)
        return false;
    memcpy(out, value + quoted, n);
    out[n] = 0;
    for (const char *p = out; *p; p++)
        if (*p < ' ' || *p > '~' || *p == '"' || *p == '\\' || (*p == ',' && !quoted))
            return false;
    return true;
}

bool kd_once_read(struct kd_request *request, struct kd_problem *problem, char text[KD_ONCE_TEXT])
{
    char key[KD_ONCE_MOST + 1];
    if (!request->route->once || strcmp(request->method, "POST"))
        return true;
    struct kd_buffer value = kd_reply_header_list(request, KD_ONCE_HEADER);
    const bool good = !value.data || key_of((const char *)value.data, key);
    if (!good) {
        snprintf(text, KD_ONCE_TEXT,
                 KD_ONCE_HEADER " is %.140s; it must be a string of 1 to %d ASCII characters in double quotes, without "
                                "quotes and backslashes inside",
                 (const char *)value.data, KD_ONCE_MOST);
        *problem = (struct kd_problem) { .type = KD_PROBLEM_BAD_REQUEST, .detail = text };
    } else if (value.data) {
        sha256_init(&request->taken);
        add(&request->taken, request->client);
        add(&request->taken, request->route->path);
        add(&request->taken, key);
        digest(&request->taken, request->once.key);
        add(&request->taken, request->raw);
    }
    kd_buffer_finish(&value);
    return good;
}

void kd_once_take(struct kd_request *request, const void *data, size_t size)
{
    if (*request->once.key)
        sha256_update(&request->taken, size, data);
}

static bool is_under_way(const struct kd_request *request)
{
    const struct kd_request *other = request->server->once;
    while (other && (other == request || strcmp(other->once.key, request->once.key)))
        other = other->once_next;
    return other;
}

enum kd_once_verdict kd_once_begin(struct kd_request *request, const struct kd_once *earlier, enum MHD_Result *refused)
{
    /* either the request has no key, or kd_once_begin has already decided about it */
    if (!*request->once.key || *request->once.request)
        return KD_ONCE_FIRST;
    digest(&request->taken, request->once.request);
    if (earlier && !strcmp(earlier->request, request->once.request))
        return KD_ONCE_AGAIN;
    if (earlier || is_under_way(request)) {
        *refused = kd_reply_problem(
            request,
            &(struct kd_problem) { .type = earlier ? KD_PROBLEM_KEY_REUSED : KD_PROBLEM_CONFLICT,
                                   .retry_after = earlier ? 0 : 1,
                                   .detail = earlier ? "the resource made with this " KD_ONCE_HEADER
                                                       " belongs to a request with another address or body; a "
                                                       "different request must have a different key"
                                                     : "a request with this " KD_ONCE_HEADER " is in progress" });
        return KD_ONCE_REFUSED;
    }
    request->once_next = request->server->once;
    request->server->once = request;
    return KD_ONCE_FIRST;
}

void kd_once_end(struct kd_request *request)
{
    struct kd_request **link = &request->server->once;
    while (*link && *link != request)
        link = &(*link)->once_next;
    if (*link)
        *link = request->once_next;
}
