/* State of one request, from its first line to the last byte of its answer. HTTP thread only. */
#ifndef KD_SERVER_HTTP_REQUEST_H
#define KD_SERVER_HTTP_REQUEST_H

#include "server/http/access.h"
#include "server/http/client.h"
#include "server/http/guard.h"
#include "server/http/once.h"
#include "server/http/request_id.h"
#include "server/http/route.h"
#include "server/http/service.h"
#include "server/http/target.h"
#include "server/http/trace.h"

#include <nettle/sha2.h>

#define KD_NPY_TYPE "application/x-npy"
#define KD_PATCH_TYPE "application/merge-patch+json"

struct kd_request {
    struct kd_server *server;
    struct MHD_Connection *mhd;
    struct kd_connection *connection;
    char client[KD_CLIENT];         /* who it is from */
    char id[KD_REQUEST_ID_MAX + 1]; /* once its header is there */
    struct kd_traceparent trace;    /* that it is part of */
    char *raw;                      /* the target as received; of one in absolute form what stands behind its host */
    char *authority;                /* that host; NULL: the target is in another form */
    struct kd_target target;
    struct kd_header header;
    const struct kd_route *route;
    const struct kd_route *matched;   /* where its path leads, also if it is refused; NULL: nowhere */
    const struct kd_visitor *visitor; /* whose access token came with it; NULL: none was needed */
    bool spent;                       /* its Authorization holds that token, and so no other */
    const char *method, *rest;        /* rest: the rest of the path, behind a route that ends in "/" */
    bool head, begun, body_announced, close;
    struct kd_once once;          /* its Idempotency-Key */
    struct sha256_ctx taken;      /* of what it asks for, while that comes, if it has one */
    struct kd_request *once_next; /* that has one and is under way */
    struct kd_buffer body;
    size_t body_mark;                /* bytes of it when its deadline was last set */
    const struct kd_format *format;  /* that the picture asked for has; NULL: none is asked for, or it may have any */
    struct kd_render_job *job;       /* a render under way; owned */
    struct kd_request *also_waiting; /* for the same thumbnail; */
    bool waited;                     /* it has waited for one */
    struct kd_orbits_job *orbits;    /* orbits under way; held */
    struct kd_particles_job *particles; /* particles being listed; owned */
    struct kd_task *task;               /* what workers compute; owned */
    struct kd_viewer *viewer;           /* the wait for a session's next frame; owned */
    struct kd_play_watcher *watcher;    /* the wait for a playground's next tick; owned */
    char etag[120];
    char file[96];      /* Content-Disposition of an answer of 200, by kd_reply_file */
    size_t reply_bytes; /* of a large reply, for its deadline */
    double start_ms;
    double bytes_before; /* that its connection has had, for the log */
    unsigned status;     /* of the reply, for the log */
};

/* The token in its Authorization; NULL: none. reply.c */
const char *kd_bearer_of(struct kd_request *request);
/* The token of a session, playground, job or asset that comes with a request, in its Authorization or query; NULL:
 * none. reply.c */
const char *kd_token_of(struct kd_request *request);

#endif
