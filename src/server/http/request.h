/* State of one request, from its first line to the last byte of its answer. HTTP thread only. */
#ifndef KD_SERVER_HTTP_REQUEST_H
#define KD_SERVER_HTTP_REQUEST_H

#include "base/json.h"
#include "server/http/access.h"
#include "server/http/client.h"
#include "server/http/guard.h"
#include "server/http/link.h"
#include "server/http/once.h"
#include "server/http/request_id.h"
#include "server/http/route.h"
#include "server/http/service.h"
#include "server/http/target.h"
#include "server/http/trace.h"

#include <nettle/sha2.h>

struct kd_request {
    struct kd_server *server;
    struct MHD_Connection *mhd;
    struct kd_connection *connection;
    char client[KD_CLIENT];         /* identity for shares and limits (client.h) */
    char id[KD_REQUEST_ID_MAX + 1]; /* X-Request-Id; set when the header has arrived */
    struct kd_traceparent trace;    /* trace that the request belongs to */
    char *raw;                      /* the target as received, without scheme and host if it came in absolute form */
    char *authority;                /* host of a target in absolute form; NULL for other forms */
    struct kd_target target;
    struct kd_header header;
    const struct kd_route *route;
    /* route of the path, set also if the request is refused; NULL: no route has the path */
    const struct kd_route *matched;
    const struct kd_visitor *visitor; /* owner of the access token; NULL: the request needed none */
    struct kd_link link;              /* the signed link by which the request came */
    /* Authorization holds the access token, so it cannot also hold the token of a session */
    bool spent;
    const char *method, *rest; /* rest: the segment of the path that the route has in braces */
    bool head, begun, body_announced, close;
    struct kd_once once;          /* hashes of the request's Idempotency-Key and content */
    struct sha256_ctx taken;      /* running hash of target and body, if the request has a key */
    struct kd_request *once_next; /* next request under way that has a key */
    struct kd_buffer body;
    size_t body_mark; /* size of body when its deadline was last extended */
    unsigned quality; /* requested quality of a lossy format; 0: the format's default */
    /* requested format of the picture; NULL: any format, or not a picture */
    const struct kd_format *format;
    /* all formats that Accept allows, the preferred one first; `format` is the first of them that can hold the
     * scene, or accepts[0] if none can */
    const struct kd_format *accepts[16];
    struct kd_render_job *job;                     /* the render under way for this request; owned */
    struct kd_request *also_waiting;               /* next request waiting for the same thumbnail */
    bool waited;                                   /* the request has waited for a thumbnail */
    struct kd_orbits_job *orbits;                  /* orbits being computed for the request; a counted reference */
    struct kd_particles_job *particles;            /* list of particles being made; owned */
    struct kd_task *task;                          /* work of the task scheduler; owned */
    struct kd_viewer *viewer;                      /* the request waits for a session's next frame; owned */
    struct kd_playground_session_watcher *watcher; /* the request waits for a playground's next tick; owned */
    char etag[120];
    char file[96];      /* Content-Disposition if the answer is 200 (kd_reply_file) */
    size_t reply_bytes; /* size of a large reply, which extends its deadline */
    double start_ms;
    double bytes_before; /* bytes written to the connection before this request, for the log */
    unsigned status;     /* status of the reply, for the log */
};

/* Token in the header Authorization; NULL if there is none. Defined in reply.c. */
const char *kd_bearer_of(struct kd_request *request);
/* Token of a session, playground, job or asset, from Authorization or the query; NULL if there is none. Defined in
 * reply.c. */
const char *kd_token_of(struct kd_request *request);

#endif
