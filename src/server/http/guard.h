/* Checks a request's header before anything in it is trusted. libmicrohttpd accepts conflicting Content-Lengths,
 * Content-Length beside Transfer-Encoding, and several Hosts. In each of these cases a proxy and this server may
 * disagree about where a request ends, or which server the request is for (request smuggling). */
#ifndef KD_SERVER_HTTP_GUARD_H
#define KD_SERVER_HTTP_GUARD_H

#include "server/http/problem.h"

#include <microhttpd.h>
#include <stdint.h>

struct kd_header {
    char wrong_host[280]; /* detail of the answer if Host is malformed, or is not one of the names served */
    char host_text[280];  /* Host without trailing blanks */
    const char *host, *content_type;
    uint64_t content_length;
    bool has_length, chunked;
};

/* authority: host of a target in absolute form, which takes precedence over Host (RFC 9112 3.2.2); NULL if the
 * target has none. hosts: NULL-terminated list of the names served. hostless: HTTP/1.0 requests without Host are
 * accepted, because load balancers send such requests to the health routes. Returns true with *header filled, or
 * false with *problem filled; that problem closes the connection. HTTP threads. */
bool kd_guard_check(struct MHD_Connection *connection, const char *version, const char *authority,
                    const char *const *hosts, bool hostless, struct kd_header *header, struct kd_problem *problem);

#endif
