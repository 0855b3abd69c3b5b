/* State shared by the parts of the HTTP service. Private to src/server.
 *
 * Threads: the front (front.h) accepts connections. One libmicrohttpd thread runs the handlers of the health routes.
 * Another one runs all other handlers, and is called "the HTTP thread". The render queue has render threads and
 * encoders. The task scheduler (task_scheduler.h) has workers. The reaper (reaper.h) enforces deadlines, detects
 * clients that have disconnected, and runs the shutdown. */
#ifndef KD_SERVER_HTTP_SERVICE_H
#define KD_SERVER_HTTP_SERVICE_H

#include "server/http/allowance.h"
#include "server/http/base_path.h"
#include "server/http/bytes.h"
#include "server/http/connections.h"
#include "server/http/counts.h"
#include "server/http/front.h"
#include "server/http/task_scheduler.h"

#include <microhttpd.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

/* maximum bytes of one body; KD_RAYS_BODY_MAX and KD_ORBIT_BODY_MAX are exceptions */
#define KD_BODY_MAX KD_SCENE_JSON_MAX
#define KD_BODIES_MAX ((size_t)192 << 20) /* maximum bytes of all bodies that are being received */
/* maximum of these bytes for one client; the rest is enough for the largest body of another client */
#define KD_BODIES_SHARE ((size_t)96 << 20)
/* reserve in bytes beyond KD_BODIES_MAX, for bodies of at most KD_BODY_MAX bytes */
#define KD_BODIES_SMALL ((size_t)16 << 20)
/* maximum bytes of all answers that are not sent yet; a single answer may exceed it */
#define KD_REPLIES_MAX (512u << 20)
#define KD_REPLIES_RESERVE ((size_t)64 << 20) /* reserve in bytes beyond KD_REPLIES_MAX, for small answers */
#define KD_REPLIES_SMALL ((size_t)4 << 20)    /* maximum bytes of a small answer */
#define KD_HEADER_POOL (32u << 10)            /* memory of a connection for its header and its read buffer, bytes */
/* seconds without traffic after which a connection that was kept open is closed */
#define KD_IDLE_S 30u
#define KD_SESSION_IDLE_MS 60000u             /* milliseconds without viewers after which a session ends */
#define KD_PLAYS_BYTES ((size_t)1 << 30)      /* maximum bytes of memory of all playgrounds */
#define KD_JOBS_KEPT 64u                      /* maximum number of stored jobs, including finished ones */
#define KD_JOB_LONGEST_S (24 * 3600.0)        /* maximum estimated time of a job, all frames together, in s */
#define KD_JOB_KEEP_S (24 * 3600.0)           /* seconds after which a finished job is deleted */
#define KD_JOB_BYTES ((uint64_t)16 << 30)     /* maximum bytes on disk of all jobs */
#define KD_ASSETS 64u                         /* maximum number of stored assets */
#define KD_ASSETS_BYTES ((uint64_t)256 << 20) /* maximum bytes of all assets */
/* seconds without use after which an asset may be evicted for a new one */
#define KD_ASSET_KEEP_S (24 * 3600.0)

#define KD_STATUS_CLASSES 6

/* Phases of the server until the end of its shutdown, in order. */
enum kd_phase {
    KD_SERVING,
    KD_DRAINING, /* /readyz fails, but everything else is served */
    KD_REFUSING, /* new renders are refused, and accepted renders are finished */
    KD_CLOSING,  /* the server no longer listens, and finishes the answers that it has begun to send */
    KD_STOPPED,
};

struct kd_access;
struct kd_cors;
struct kd_auth_throttle;
struct kd_asset_store;
struct kd_jobs;
struct kd_cached_documents;
struct kd_lessons;
struct kd_link_budgets;
struct kd_measures;
struct kd_playground_sessions;
struct kd_render_queue;
struct kd_request;
struct kd_sessions;
struct kd_thumbnails;

struct kd_server {
    /* daemon: for all routes except the health routes; health_daemon: for the health routes (front.h) */
    struct MHD_Daemon *daemon, *health_daemon;
    struct kd_front *front;
    uint16_t port;
    struct kd_base_path base;
    /* address of the page, without a slash at its end (public_url.h); NULL: it is made from the request's Host */
    char *public_url;
    const char **hosts; /* accepted Host names, an array that ends with NULL; each name is malloc'd */
    char **own;         /* result of kd_names_own if the server listens on a wildcard address; NULL otherwise */
    unsigned drain_ms, drain_s, longest_s;
    struct kd_connections *connections;
    struct kd_render_queue *renders;
    struct kd_scheduler *rays; /* scheduler of requests for rays */
    struct kd_scheduler
        *scheduler; /* scheduler of all other tasks, such as orbits, long quantities and checks of jobs */
    /* callback that returns the client's quota; NULL: device time is not limited */
    struct kd_quota (*quota)(const struct kd_server *server, const char *client);
    struct kd_sessions *sessions;
    struct kd_lessons *lessons;
    struct kd_playground_sessions *playgrounds;
    struct kd_jobs *jobs;
    struct kd_job_whole *cubes; /* cubes that clients are downloading now (job/archive.c); HTTP thread only */
    struct kd_request *once;    /* requests in progress that have an Idempotency-Key; HTTP thread only */
    struct kd_asset_store *assets;
    struct kd_asset *sky; /* the operator's photograph of the sky; NULL if there is none */
    struct kd_cached_documents *documents;
    struct kd_thumbnails *thumbnails;
    char etag_tail[20]; /* the part of a picture's ETag that does not depend on the scene: version and device */

    _Atomic int phase;
    _Atomic unsigned requests; /* number of requests that are not completely answered yet */
    /* memory budgets; bodies: of bodies that are being received; replies: of answers that are not sent yet */
    struct kd_bytes *bodies, *replies;
    struct kd_access *access; /* access tokens; NULL: everybody may send all requests */
    /* device time that signed links have used; only set together with `access` */
    struct kd_link_budgets *links;
    /* name of the key in `access` that signs shared scenes; NULL if there is none */
    const char *share_key;
    struct kd_auth_throttle *auth_throttle; /* throttle of wrong tokens; only set together with `access` */
    /* origins that are permitted besides the server's own; NULL if there are none */
    struct kd_cors *cors;
    /* true if requests are accepted that were made by pages of other sites; such pages cannot read the answers */
    bool cross_site;
    struct kd_measures *measures; /* durations of requests */
    /* Number of answers by the first digit of the status; index 0: the connection was cut before a status was sent. */
    _Atomic unsigned long answers[KD_STATUS_CLASSES];

    int stop_fd; /* eventfd that wakes the reaper */
    pthread_t reaper;
    bool reaper_runs;
    _Atomic bool abandon; /* true if the server is destroyed without having been stopped, so that it must not wait */
    /* set drain_s seconds after a request to stop; the remaining work is then cancelled, and its clients get an
     * answer */
    _Atomic bool ended;
    pthread_mutex_t lock; /* protects all members below */
    /* counts that were read last; they are used while the lock of the counts' owner is not free */
    struct kd_sessions_counts sessions_counts;
    struct kd_jobs_counts jobs_counts;
    struct kd_playground_sessions_counts playgrounds_counts;
    pthread_cond_t changed;
    bool stopped;
};

#endif
