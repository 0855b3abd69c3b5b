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
    char client[KD_CLIENT];         /* identity of the client for shares and limits (client.h) */
    char id[KD_REQUEST_ID_MAX + 1]; /* the request ID, which is set when the header has arrived */
    struct kd_traceparent trace;    /* the trace to which the request belongs */
    char *raw;                      /* the target as received, but without scheme and host if it has absolute form */
    char *authority;                /* host of a target in absolute form; NULL for other forms */
    struct kd_target target;
    struct kd_header header;
    const struct kd_route *route;
    /* route of the path, even if the request is refused; NULL if no route has the path */
    const struct kd_route *matched;
    const struct kd_visitor *visitor; /* owner of the access token; NULL if the request needs none */
    struct kd_link link;              /* the signed link by which the request came */
    /* true if Authorization contains the access token, and so cannot contain the token of a session */
    bool spent;
    const char *method, *rest; /* rest: the segment of the path that is in braces in the route */
    bool head, begun, body_announced, close;
    struct kd_once once;          /* hash of the request's Idempotency-Key, and hash of its content */
    struct sha256_ctx taken;      /* hash state of target and body, if the request has a key */
    struct kd_request *once_next; /* next request in progress that has a key */
    struct kd_buffer body;
    size_t body_mark; /* size of the body when its deadline was last extended */
    unsigned quality; /* quality that the client has requested for a lossy format; 0: the default of the format */
    /* the requested format of the picture; NULL: any format, or the answer is no picture */
    const struct kd_format *format;
    /* all formats that Accept permits, the preferred one first; `format` is the first of these that can contain the
     * scene, or accepts[0] if none can */
    const struct kd_format *accepts[16];
    struct kd_render_job *job;          /* the render in progress for this request; owned */
    struct kd_request *also_waiting;    /* next request that waits for the same thumbnail */
    bool waited;                        /* true if the request has waited for a thumbnail */
    struct kd_orbits_job *orbits;       /* the computation of orbits for this request; a counted reference */
    struct kd_particles_job *particles; /* the list of particles that is made for this request; owned */
    struct kd_task *task;               /* the request's work in the task scheduler; owned */
    /* set while the request waits for the next frame of a session; owned */
    struct kd_viewer *viewer;
    /* set while the request waits for the next tick of a playground; owned */
    struct kd_playground_session_watcher *watcher;
    char etag[120];
    char file[96];      /* Content-Disposition for an answer with status 200 (kd_reply_file) */
    size_t reply_bytes; /* size of a large reply in bytes, which extends its deadline */
    double start_ms;
    double bytes_before; /* number of bytes that were written to the connection before this request, for the log */
    unsigned status;     /* status of the answer, for the log */
};

/* The token in the header Authorization; NULL if there is none. Defined in reply.c. */
const char *kd_bearer_of(struct kd_request *request);
/* The token of a session, playground, job or asset, from Authorization or from the query; NULL if there is none.
 * Defined in reply.c. */
const char *kd_token_of(struct kd_request *request);

#endif
