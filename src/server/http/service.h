/* State shared by the parts of the HTTP service. Private to src/server.
 *
 * Threads: the front (front.h) accepts connections. One libmicrohttpd thread runs the handlers of the health routes,
 * another all other handlers ("the HTTP thread"). The render queue has render threads and encoders, the task scheduler
 * (turns.h) its workers. The keeper (keeper.h) enforces deadlines, notices clients that have left, and runs the
 * shutdown. */
#ifndef KD_SERVER_HTTP_SERVICE_H
#define KD_SERVER_HTTP_SERVICE_H

#include "server/http/allowance.h"
#include "server/http/base_path.h"
#include "server/http/bytes.h"
#include "server/http/connections.h"
#include "server/http/counts.h"
#include "server/http/front.h"
#include "server/http/turns.h"

#include <microhttpd.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

#define KD_BODY_MAX \
    KD_SCENE_JSON_MAX /* bytes of one request; of those for rays and orbits: KD_RAYS_BODY_MAX, KD_ORBIT_BODY_MAX */
#define KD_BODIES_MAX ((size_t)192 << 20) /* bytes of all requests being received */
#define KD_BODIES_SHARE \
    ((size_t)96 << 20) /* bytes of those of one client, which leaves room for the largest one of another */
#define KD_BODIES_SMALL ((size_t)16 << 20) /* bytes beside all these, for bodies of up to KD_BODY_MAX */
#define KD_REPLIES_MAX \
    (512u << 20) /* bytes of answers that clients have not taken yet; a single answer may exceed it */
#define KD_REPLIES_RESERVE ((size_t)64 << 20) /* bytes beside these, ... */
#define KD_REPLIES_SMALL ((size_t)4 << 20)    /* ... for answers of up to so many */
#define KD_HEADER_POOL (32u << 10)            /* a connection's memory for header and read buffer */
#define KD_IDLE_S 30u                         /* a kept-alive connection without traffic */
#define KD_SESSION_IDLE_MS 60000u             /* a session that nobody watches */
#define KD_PLAYS_BYTES ((size_t)1 << 30)      /* of memory, that all playgrounds may take */
#define KD_JOBS_KEPT 64u                      /* jobs in all, finished ones too */
#define KD_JOB_LONGEST_S (24 * 3600.0)        /* estimated, of all frames of a job */
#define KD_JOB_KEEP_S (24 * 3600.0)           /* a finished job */
#define KD_JOB_BYTES ((uint64_t)16 << 30)     /* on disk, of all jobs */
#define KD_ASSETS 64u                         /* at once, */
#define KD_ASSETS_BYTES ((uint64_t)256 << 20) /* of so many bytes */
#define KD_ASSET_KEEP_S (24 * 3600.0)         /* one that nobody asks for, if others want its room */

#define KD_STATUS_CLASSES 6

/* The way down, in order. */
enum kd_phase {
    KD_SERVING,
    KD_DRAINING, /* /readyz fails, everything else is served */
    KD_REFUSING, /* new renders are refused, those accepted finish */
    KD_CLOSING,  /* no longer listening; answers under way are sent */
    KD_STOPPED,
};

struct kd_access;
struct kd_cors;
struct kd_guesses;
struct kd_asset_store;
struct kd_jobs;
struct kd_kept;
struct kd_measures;
struct kd_plays;
struct kd_render_queue;
struct kd_request;
struct kd_sessions;
struct kd_thumbnails;

struct kd_server {
    struct MHD_Daemon *daemon, *health_daemon; /* by what connections begin with: front.h */
    struct kd_front *front;
    uint16_t port;
    struct kd_base_path base;
    char *public_url;   /* of the page, without the slash behind it (public_url.h); NULL: by the Host of a request */
    const char **hosts; /* accepted Host names, NULL-terminated; each malloc'd */
    char **own;         /* kd_names_own, where it listens on every address; else NULL */
    unsigned drain_ms, drain_s, longest_s;
    struct kd_connections *connections;
    struct kd_render_queue *renders;
    struct kd_turns *rays;  /* requests for them */
    struct kd_turns *turns; /* orbits, long quantities, paths of sessions, jobs being checked */
    struct kd_quota (*quota)(const struct kd_server *server, const char *client); /* NULL: there is no limit */
    struct kd_sessions *sessions;
    struct kd_plays *plays;
    struct kd_jobs *jobs;
    struct kd_job_whole *cubes; /* being fetched (job/whole.c); of the HTTP thread alone */
    struct kd_request *once;    /* those with an Idempotency-Key that are under way; of the HTTP thread alone */
    struct kd_asset_store *assets;
    struct kd_kept *kept;
    struct kd_thumbnails *thumbnails;
    char etag_tail[20]; /* what besides the scene a picture depends on: version, device */

    _Atomic int phase;
    _Atomic unsigned requests;         /* begun and not yet answered in full */
    struct kd_bytes *bodies, *replies; /* being received; not yet taken by their clients */
    struct kd_access *access;          /* who may use it; NULL: everybody may do everything */
    struct kd_guesses *guesses;        /* beside it: wrong tokens by address */
    struct kd_cors *cors;              /* pages of these origins may; NULL: of none but its own */
    bool cross_site;                   /* pages of other sites may make it work, which they cannot read */
    struct kd_measures *measures;      /* how long they took */
    _Atomic unsigned long answers[KD_STATUS_CLASSES]; /* by the first digit of their status; 0: cut off before one */

    int stop_fd; /* eventfd that wakes the keeper */
    pthread_t keeper;
    bool keeper_runs;
    _Atomic bool abandon; /* destroy without stop: do not wait */
    _Atomic bool ended;   /* drain_s after a stop request: what was left is cancelled, and its clients are told so */
    pthread_mutex_t lock; /* for what follows */
    struct kd_sessions_counts sessions_counts; /* as last known */
    struct kd_jobs_counts jobs_counts;
    struct kd_plays_counts plays_counts;
    pthread_cond_t changed;
    bool stopped;
};

#endif
