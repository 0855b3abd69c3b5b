/* Checks a request's header before any part of it is used. libmicrohttpd accepts conflicting Content-Lengths,
 * Content-Length together with Transfer-Encoding, and several Hosts. In these cases a proxy and this server may
 * disagree about the end of a request, or about the server for which it is meant (request smuggling). */
#ifndef KD_SERVER_HTTP_GUARD_H
#define KD_SERVER_HTTP_GUARD_H

#include "server/http/problem.h"

#include <microhttpd.h>
#include <stdint.h>

struct kd_header {
    char wrong_host[280]; /* detail of the answer if Host is malformed, or is not one of the names that are served */
    char host_text[280];  /* Host without trailing blanks */
    const char *host, *content_type;
    uint64_t content_length;
    bool has_length, chunked;
};

/* authority: host of a target in absolute form, which takes precedence over Host (RFC 9112 3.2.2); NULL if the
 * target has none. hosts: NULL-terminated list of the names that are served. hostless: if true, HTTP/1.0 requests
 * without Host are accepted, because load balancers send such requests to the health routes. If the result is true,
 * *header is filled. If it is false, *problem is filled, and that problem closes the connection. HTTP threads. */
bool kd_guard_check(struct MHD_Connection *connection, const char *version, const char *authority,
                    const char *const *hosts, bool hostless, struct kd_header *header, struct kd_problem *problem);

#endif
