/* The HTTP service: routes, limits, and a bounded queue in front of the render thread. This header uses no Vulkan
 * type. */
#ifndef KD_SERVER_SERVER_H
#define KD_SERVER_SERVER_H

#include "base/error.h"
#include "render/render.h"

#include <stdint.h>

struct kd_server;

struct kd_server_params {
    const char *listen;     /* numeric address, default "127.0.0.1" */
    uint16_t port;          /* 0: any free port */
    const char *base_path;  /* prefix of every path, set by a proxy: "/some/prefix"; NULL or "": none */
    const char *public_url; /* public address of the page (http/public_url.h); NULL: taken from the request's Host */
    /* Host names that are accepted besides those of loopback, without port; NULL-terminated */
    const char *const *hosts;
    unsigned queue;           /* limit of waiting renders, default 16 */
    unsigned sessions;        /* limit of live sessions, default 16 */
    unsigned session_ms;      /* a session without viewers ends after this time, default 60 000 */
    unsigned playgrounds;     /* limit of playground sessions, default 16; session_ms applies to them too */
    unsigned playgrounds_kib; /* limit of the memory of all playgrounds in KiB, default 1 GiB */
    unsigned jobs;            /* limit of unfinished jobs, default 16 */
    /* percentage of the limits of connections, waiting renders, sessions and jobs that one client may use, default
     * 75 */
    unsigned client_share;
    unsigned client_jobs;     /* limit of unfinished jobs of one client; 0: the limit follows from client_share */
    unsigned client_device_s; /* seconds of device time that a client may use in a minute; 0: no limit */
    /* origins whose pages may use the server and read its answers (http/cors.h), NULL-terminated; NULL: only the
     * server's own origin */
    const char *const *cors_origins;
    /* origins with the same permission whose pages may also show /embed in a frame, NULL-terminated; or NULL */
    const char *const *embed_origins;
    bool cross_site;   /* true if requests are accepted that pages of other sites make */
    unsigned jobs_kib; /* limit of the size of all jobs' frames in KiB, default 16 GiB */
    /* limits of the number of assets, and of their total size in KiB; default 64 and 256 MiB */
    unsigned assets, assets_kib;
    unsigned asset_keep_s;  /* an asset unused for this long may be evicted for a new one; default: a day */
    const char *token_file; /* access tokens and roles (http/access.h); NULL: everybody may send every request */
    const char *share_key;  /* name of the key of token_file that signs the addresses of shared scenes; NULL: none */
    const char *sky;        /* PNG file of a photograph of the whole sky that the page offers; NULL: none */
    const char *state;      /* folder of the data that survive a restart: jobs, assets, budgets of links; NULL: none */
    /* time after a stop request during which the server still serves while /readyz fails; default 1000 */
    unsigned drain_ms;
    /* accepted work that is unfinished this long after a stop request is cancelled; default 600 */
    unsigned drain_s;
    unsigned rest_ms;     /* unneeded memory is freed after this time without work; default 60 000 */
    unsigned connections; /* limit of open connections; further ones get 503 except on the health routes; default 512 */
    unsigned header_ms;   /* deadline of a request's header; default 10 000 */
    unsigned body_ms;     /* deadline of a request's body after the end of its header; default 30 000 */
    unsigned longest_s;   /* renders estimated to take longer are refused with 422; default 600 */
    unsigned reopenings;  /* number of times that a failed device is reopened within ten minutes; default 3;
                           * UINT_MAX: never */
    struct kd_renderer_params renderer;
};

/* Opens the device, starts the render thread and listens. params and its strings may be freed after the call. A
 * parameter of 0 means the default. drain_ms UINT_MAX means no drain. */
enum kd_status kd_server_create(const struct kd_server_params *params, struct kd_server **out, struct kd_error *error);
uint16_t kd_server_port(const struct kd_server *server);
/* If the server listens on a wildcard address, the machine's addresses and name, NULL-terminated; otherwise NULL. */
const char *const *kd_server_own_names(const struct kd_server *server);
/* Begins to stop: /readyz fails at once; running and queued renders finish. Async-signal-safe. */
void kd_server_stop(struct kd_server *server);
/* Blocks until the server has stopped. Returns KD_EDEVICE if the device was lost for good or hangs. The process must
 * then end by _exit, without kd_server_destroy, which would wait for threads that may never return. */
enum kd_status kd_server_wait(struct kd_server *server, struct kd_error *error);
/* Destroys the server. If it was not stopped before, running renders are cancelled and nothing is drained. Accepts
 * NULL. */
void kd_server_destroy(struct kd_server *server);

#endif
