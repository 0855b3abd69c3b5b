/* State shared by the parts of the HTTP service. Private to src/server.
 *
 * Threads: the front (front.h) accepts connections. One libmicrohttpd thread runs the handlers of the health routes,
 * another all other handlers ("the HTTP thread"). The render queue has render threads and encoders. The task scheduler
 * (task_scheduler.h) has workers. The reaper (reaper.h) enforces deadlines, detects clients that have disconnected, and
 * runs the shutdown. */
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

#define KD_BODY_MAX KD_SCENE_JSON_MAX     /* bytes of one body, except KD_RAYS_BODY_MAX and KD_ORBIT_BODY_MAX */
#define KD_BODIES_MAX ((size_t)192 << 20) /* limit of bytes of all bodies being received */
/* one client's limit of these bytes; the rest is enough for the largest body of another client */
#define KD_BODIES_SHARE ((size_t)96 << 20)
#define KD_BODIES_SMALL ((size_t)16 << 20) /* reserve beyond KD_BODIES_MAX for bodies of at most KD_BODY_MAX bytes */
/* limit of bytes of all answers not yet sent; a single answer may exceed it */
#define KD_REPLIES_MAX (512u << 20)
#define KD_REPLIES_RESERVE ((size_t)64 << 20) /* reserve beyond KD_REPLIES_MAX for small answers */
#define KD_REPLIES_SMALL ((size_t)4 << 20)    /* largest size of a small answer */
#define KD_HEADER_POOL (32u << 10)            /* bytes of a connection for its header and read buffer */
#define KD_IDLE_S 30u                         /* a kept-alive connection without traffic is closed after this time */
#define KD_SESSION_IDLE_MS 60000u             /* a session without viewers ends after this time */
#define KD_PLAYS_BYTES ((size_t)1 << 30)      /* limit of the memory of all playgrounds */
#define KD_JOBS_KEPT 64u                      /* limit of jobs stored, including finished ones */
#define KD_JOB_LONGEST_S (24 * 3600.0)        /* largest estimated time of all frames of a job together */
#define KD_JOB_KEEP_S (24 * 3600.0)           /* a finished job is deleted after this time */
#define KD_JOB_BYTES ((uint64_t)16 << 30)     /* limit of the disk space of all jobs */
#define KD_ASSETS 64u                         /* limit of assets stored */
#define KD_ASSETS_BYTES ((uint64_t)256 << 20) /* limit of the bytes of all assets */
#define KD_ASSET_KEEP_S (24 * 3600.0)         /* an asset that is unused for this long may be evicted for a new one */

#define KD_STATUS_CLASSES 6

/* Phases of the shutdown, in order. */
enum kd_phase {
    KD_SERVING,
    KD_DRAINING, /* /readyz fails; everything else is served */
    KD_REFUSING, /* new renders are refused; accepted renders are finished */
    KD_CLOSING,  /* the server no longer listens; answers that have begun are sent */
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
    /* daemon for all routes except the health routes; daemon of the health routes (front.h) */
    struct MHD_Daemon *daemon, *health_daemon;
    struct kd_front *front;
    uint16_t port;
    struct kd_base_path base;
    /* address of the page without a slash at its end (public_url.h); NULL: taken from the request's Host */
    char *public_url;
    const char **hosts; /* accepted Host names, NULL-terminated; each malloc'd */
    char **own;         /* result of kd_names_own if the server listens on a wildcard address; otherwise NULL */
    unsigned drain_ms, drain_s, longest_s;
    struct kd_connections *connections;
    struct kd_render_queue *renders;
    struct kd_scheduler *rays;      /* scheduler of requests for rays */
    struct kd_scheduler *scheduler; /* scheduler of orbits, long quantities, paths of sessions, checks of jobs */
    struct kd_quota (*quota)(const struct kd_server *server, const char *client); /* NULL: no limit of device time */
    struct kd_sessions *sessions;
    struct kd_lessons *lessons;
    struct kd_playground_sessions *playgrounds;
    struct kd_jobs *jobs;
    struct kd_job_whole *cubes; /* cubes that are being downloaded (job/archive.c); HTTP thread only */
    struct kd_request *once;    /* requests under way that have an Idempotency-Key; HTTP thread only */
    struct kd_asset_store *assets;
    struct kd_asset *sky; /* the operator's photograph of the sky; NULL: none */
    struct kd_cached_documents *documents;
    struct kd_thumbnails *thumbnails;
    char etag_tail[20]; /* part of a picture's ETag that does not depend on the scene: version and device */

    _Atomic int phase;
    _Atomic unsigned requests;              /* number of requests that have begun and are not completely answered */
    struct kd_bytes *bodies, *replies;      /* memory budgets: bodies being received; answers not yet sent */
    struct kd_access *access;               /* access tokens; NULL: everybody may send every request */
    struct kd_link_budgets *links;          /* device time that signed links have used; used with access */
    const char *share_key;                  /* name of the key that signs shared scenes, in access; NULL: none */
    struct kd_auth_throttle *auth_throttle; /* throttle of wrong tokens, used with access */
    struct kd_cors *cors;                   /* origins that are permitted besides the server's own; NULL: none */
    /* true if requests that pages of other sites make are accepted; such pages cannot read the answers */
    bool cross_site;
    struct kd_measures *measures; /* durations of requests */
    /* Numbers of answers by the first digit of the status; 0: the connection was cut before a status. */
    _Atomic unsigned long answers[KD_STATUS_CLASSES];

    int stop_fd; /* eventfd that wakes the reaper */
    pthread_t reaper;
    bool reaper_runs;
    _Atomic bool abandon; /* the server is destroyed although it was never stopped, so it must not wait */
    /* set drain_s after a stop request; remaining work is then cancelled, and its clients get an answer */
    _Atomic bool ended;
    pthread_mutex_t lock;                      /* protects all members below */
    struct kd_sessions_counts sessions_counts; /* counts as they were last read, for use while a lock is not free */
    struct kd_jobs_counts jobs_counts;
    struct kd_playground_sessions_counts playgrounds_counts;
    pthread_cond_t changed;
    bool stopped;
};

#endif
