#include "server/http/library.h"

#include "base/log.h"
#include "server/http/connections.h"
#include "server/http/problem.h"

#include <stdio.h>
#include <string.h>
#include <sys/socket.h>

/* start of a log line of the library, in libmicrohttpd 0.9.75 and 1.0.1 */
#define SAYS_STATUS "HTTP response code is "

static _Thread_local int current = -1;

void kd_library_works_on(int socket) { current = socket; }

/* Replaces the C library's recv in the whole program, including shared libraries. This is the only way to find out
 * whose bytes a thread of libmicrohttpd is parsing. The function is declared by its symbol, because headers may
 * define recv as an inline function. */
ssize_t kd_recv(int socket, void *data, size_t size, int flags) __asm__("recv");
ssize_t kd_recv(int socket, void *data, size_t size, int flags)
{
    current = socket;
    return recvfrom(socket, data, size, flags, NULL, NULL);
}

static const struct refusal {
    unsigned status;
    enum kd_problem_type type;
    const char *detail;
} refusals[] = {
    { 400, KD_PROBLEM_BAD_REQUEST, "the request line, a header line or a chunk of the body is not valid HTTP/1.1" },
    { 413, KD_PROBLEM_BODY_TOO_LARGE, "the body, or a line between its chunks, is too long" },
    { 414, KD_PROBLEM_URI_TOO_LONG, "the address is too long; address and header together must have at most 32 KiB" },
    { 431, KD_PROBLEM_HEADER_TOO_LARGE, "the header is too large; it must have at most 32 KiB" },
    { 500, KD_PROBLEM_BAD_REQUEST, "a line of the header, or between chunks of the body, is too long" },
    { 505, KD_PROBLEM_HTTP_VERSION, "the request line must name HTTP/1.1 or HTTP/1.0" },
};

/* Finds the refusal that a log line reports. Returns NULL if it reports none. */
static const struct refusal *refusal_of(const char *line)
{
    const char *says = strstr(line, SAYS_STATUS);
    unsigned status;
    if (!says || sscanf(says + strlen(SAYS_STATUS), "%u", &status) != 1)
        return NULL;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++)
        if (refusals[i].status == status)
            return &refusals[i];
    return &refusals[0];
}

void kd_library_log(void *connections, const char *format, va_list args)
{
    char line[512];
    vsnprintf(line, sizeof line, format, args);
    line[strcspn(line, "\r\n")] = 0;
    kd_log(KD_LOG_DEBUG, "libmicrohttpd: %s", line);
    const struct refusal *refusal = refusal_of(line);
    if (refusal)
        kd_connections_refuse(connections, current, refusal->type, refusal->detail);
}
