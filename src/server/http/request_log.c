#include "server/http/request_log.h"

#include "base/log.h"
#include "server/http/measures.h"

#include <linux/tcp.h>
#include <math.h>
#include <netinet/in.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>

/* A sequence of at least this number of hexadecimal digits counts as an id or a token. It is not logged in full,
 * because anyone who knows it can read or change the object. */
#define SECRET 16
#define SHOWN 4 /* number of digits of an id or token that are logged */

static void target_for_log(const char *raw, char *out, size_t size)
{
    size_t n = 0;
    while (*raw && n + 7 + 4 < size) {
        size_t digits = strspn(raw, "0123456789abcdefABCDEF");
        size_t token = !strncmp(raw, "token=", 6) ? 6 : !strncmp(raw, "access=", 7) ? 7 : 0;
        bool secret = digits >= SECRET;
        size_t take = token ? token : secret ? SHOWN : 1;
        for (size_t i = 0; i < take; i++)
            out[n++] = (char)(raw[i] > ' ' && raw[i] < 0x7f ? raw[i] : '?'); /* prevents line breaks */
        raw += token ? token + strcspn(raw + token, "&") : secret ? digits : 1;
        for (int i = 0; i < 3 && (token || secret); i++)
            out[n++] = '.';
    }
    out[n] = 0;
}

/* Number of bytes that were written to the request's connection since it was opened; NAN if unknown. The client may
 * have received fewer. */
static double bytes_written(const struct kd_request *request)
{
    const size_t needed =
        offsetof(struct tcp_info, tcpi_bytes_retrans) + sizeof((struct tcp_info *)NULL)->tcpi_bytes_retrans;
    struct tcp_info info = { 0 };
    socklen_t size = sizeof info;
    if (!request->connection ||
        getsockopt(kd_connection_socket(request->connection), IPPROTO_TCP, TCP_INFO, &info, &size) || size < needed)
        return NAN;
    return (double)info.tcpi_bytes_sent - (double)info.tcpi_bytes_retrans + info.tcpi_notsent_bytes;
}

void kd_request_log_begin(struct kd_request *request)
{
    if (kd_log_tells(KD_LOG_INFO) && kd_log_get_format() == KD_LOG_JSON)
        request->bytes_before = bytes_written(request);
}

static void write_members(const struct kd_request *request, double ms, bool cut_off)
{
    const struct kd_log_member members[] = {
        { "id", *request->id ? request->id : NULL, NAN },
        { "trace_id", *request->trace.trace_id ? request->trace.trace_id : NULL, NAN },
        { "parent_id", *request->trace.parent_id ? request->trace.parent_id : NULL, NAN },
        { "method", request->method ? request->method : "-", 0 },
        { "route", kd_measures_route(request->matched), 0 },
        { "status", NULL, request->status },
        { "ms", NULL, floor(ms * 1e3 + 0.5) / 1e3 },
        { "bytes", NULL, bytes_written(request) - request->bytes_before },
        { "client", *request->client ? request->client : NULL, NAN },
        { "visitor", request->visitor ? request->visitor->name : NULL, NAN },
        { "cut_off", NULL, cut_off ? 1 : NAN },
    };
    kd_log_event(KD_LOG_INFO, "request", members, sizeof members / sizeof *members, "");
}

void kd_request_log_end(const struct kd_request *request, double ms, bool cut_off)
{
    char target[200];
    if (!kd_log_tells(KD_LOG_INFO))
        return;
    if (kd_log_get_format() == KD_LOG_JSON) {
        write_members(request, ms, cut_off);
        return;
    }
    target_for_log(request->raw ? request->raw : "", target, sizeof target);
    kd_log(KD_LOG_INFO, "%s %s %u %.1f ms%s%s%s", request->method ? request->method : "-", target, request->status, ms,
           request->visitor ? " by " : "", request->visitor ? request->visitor->name : "", cut_off ? " (cut off)" : "");
}
