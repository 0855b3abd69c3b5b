#include "server/http/problem.h"

#include "base/json.h"
#include "base/utf8.h"
#include "server/http/request_id.h"

#include <stdio.h>
#include <string.h>
#include <sys/socket.h>

static const struct {
    unsigned status;
    const char *uri, *title;
} table[] = {
#define ROW(name, status, word, title) { status, "urn:kerrd:problem:" word, title },
    KD_PROBLEMS(ROW)
#undef ROW
};

unsigned kd_problem_status(enum kd_problem_type type) { return table[type].status; }
const char *kd_problem_title(enum kd_problem_type type) { return table[type].title; }
const char *kd_problem_uri(size_t type) { return type < sizeof table / sizeof *table ? table[type].uri : NULL; }

struct kd_problem kd_problem_from(const struct kd_error *error)
{
    struct kd_problem problem = { .detail = error->message, .pointer = error->pointer };
    switch (error->status) {
    case KD_EINVAL: problem.type = KD_PROBLEM_INVALID_SCENE; break;
    case KD_ETOOBIG: problem.type = KD_PROBLEM_TOO_LARGE; break;
    case KD_ENOMEM: problem.type = KD_PROBLEM_NO_MEMORY, problem.retry_after = 5; break;
    case KD_EFULL: problem.type = KD_PROBLEM_DISK_FULL, problem.retry_after = 60; break;
    case KD_EBUSY:
        problem.type = KD_PROBLEM_QUEUE_FULL, problem.retry_after = error->retry_s ? error->retry_s : 1;
        break;
    case KD_ECANCELLED: problem.type = KD_PROBLEM_STOPPING, problem.retry_after = 1; break;
    case KD_EABSENT: problem.type = KD_PROBLEM_ABSENT; break;
    case KD_EDEVICE: problem.type = KD_PROBLEM_DEVICE_LOST; break;
    case KD_OK:
    case KD_EINTERNAL:
    case KD_EIO: problem.type = KD_PROBLEM_INTERNAL; break;
    }
    return problem;
}

void kd_problem_limit(struct kd_problem *problem, const struct kd_error *error, bool quota, unsigned otherwise_s)
{
    if (quota)
        problem->type = KD_PROBLEM_QUOTA;
    if (error->status == KD_EBUSY)
        problem->retry_after = error->retry_s ? error->retry_s : otherwise_s;
}

/* Text for JSON: a message may contain bytes of the request, or may end within a character, and JSON permits
 * neither. */
static void add_text(struct kd_json *json, const char *key, const char *text)
{
    char copy[512];
    snprintf(copy, sizeof copy, "%s", text);
    if (!kd_utf8_valid(copy))
        for (char *p = copy; *p; p++)
            if (*p & 0x80)
                *p = '?';
    kd_json_string(json, key, copy);
}

enum kd_status kd_problem_to_json(const struct kd_problem *problem, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);

    kd_json_object(&json, NULL);
    kd_json_string(&json, "type", table[problem->type].uri);
    kd_json_string(&json, "title", table[problem->type].title);
    kd_json_number(&json, "status", table[problem->type].status);
    add_text(&json, "detail", problem->detail ? problem->detail : table[problem->type].title);
    if (problem->pointer && *problem->pointer)
        add_text(&json, "pointer", problem->pointer);
    if (problem->offered)
        add_text(&json, "offered", problem->offered);
    if (problem->request_id && *problem->request_id)
        add_text(&json, "request_id", problem->request_id);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

void kd_problem_send_raw(int socket, enum kd_problem_type type, const char *detail, const char *request_id)
{
    struct kd_problem problem = { .type = type, .detail = detail, .request_id = request_id };
    const bool named = request_id && *request_id;
    struct kd_buffer body = { 0 }, reply = { 0 };
    bool later = type == KD_PROBLEM_CROWDED || type == KD_PROBLEM_QUOTA || type == KD_PROBLEM_NO_MEMORY;

    if (!kd_problem_to_json(&problem, &body) &&
        !kd_buffer_printf(
            &reply,
            "HTTP/1.1 %u Refused\r\nContent-Type: application/problem+json\r\n"
            "X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-site\r\nCache-Control: no-store\r\n"
            "Connection: close\r\n%s%s%s%sContent-Length: %zu\r\n\r\n%s",
            table[type].status, later ? "Retry-After: 1\r\n" : "", named ? KD_REQUEST_ID_HEADER ": " : "",
            named ? request_id : "", named ? "\r\n" : "", body.size, (const char *)body.data))
        if (send(socket, reply.data, reply.size, MSG_DONTWAIT | MSG_NOSIGNAL) < 0) {
            /* errors are ignored: the peer has closed the connection or does not read, and the connection will be
             * closed anyway */
        }
    kd_buffer_finish(&body);
    kd_buffer_finish(&reply);
}
