/* Checks a request's header before anything in it is trusted. libmicrohttpd accepts conflicting Content-Lengths,
 * Content-Length beside Transfer-Encoding, and several Hosts. Each lets a proxy and this server disagree about where a
 * request ends or whom it is for (request smuggling). */
#ifndef KD_SERVER_HTTP_GUARD_H
#define KD_SERVER_HTTP_GUARD_H

#include "server/http/problem.h"

#include <microhttpd.h>
#include <stdint.h>

struct kd_header {
    char wrong_host[280]; /* what is wrong with it, for the answer */
    char host_text[280];  /* Host without the blanks behind it */
    const char *host, *content_type;
    uint64_t content_length;
    bool has_length, chunked;
};

/* authority: the host of a target in absolute form, which counts in the place of Host (RFC 9112 3.2.2); NULL: the
 * target has none. hosts: NULL-terminated names. hostless: HTTP/1.0 without a Host is let through, as load balancers
 * ask for health. True when sound, with *header filled; else *problem, which closes the connection. HTTP thread. */
bool kd_guard_check(struct MHD_Connection *connection, const char *version, const char *authority,
                    const char *const *hosts, bool hostless, struct kd_header *header, struct kd_problem *problem);

#endif
