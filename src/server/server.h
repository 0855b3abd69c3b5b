/* The HTTP service: routes, limits, and a bounded queue before the render thread. This header uses no Vulkan types. */
#ifndef KD_SERVER_SERVER_H
#define KD_SERVER_SERVER_H

#include "base/error.h"
#include "render/render.h"

#include <stdint.h>

struct kd_server;

struct kd_server_params {
    const char *listen;    /* numeric address to listen on; default "127.0.0.1" */
    uint16_t port;         /* 0: any free port */
    const char *base_path; /* prefix of every path that a proxy adds, such as "/some/prefix"; NULL or "": none */
    /* public address of the page (http/public_url.h); NULL: it is made from the request's Host */
    const char *public_url;
    /* Host names, without port, that are accepted besides those of loopback; ends with NULL */
    const char *const *hosts;
    unsigned queue;           /* maximum number of waiting renders; default 16 */
    unsigned sessions;        /* maximum number of live sessions; default 16 */
    unsigned session_ms;      /* milliseconds without viewers after which a session ends; default 60 000 */
    unsigned playgrounds;     /* maximum number of playground sessions; default 16; session_ms applies to them too */
    unsigned playgrounds_kib; /* maximum memory of all playgrounds in KiB; default 1 GiB */
    unsigned jobs;            /* maximum number of unfinished jobs; default 16 */
    /* percentage of the limits of connections, waiting renders, sessions and jobs that one client may use; default
     * 75 */
    unsigned client_share;
    unsigned client_jobs;     /* maximum number of unfinished jobs of one client; 0: it follows from client_share */
    unsigned client_device_s; /* seconds of device time that a client may use per minute; 0: no limit */
    /* origins whose pages may use the server and read its answers (http/cors.h); ends with NULL; NULL: only the
     * server's own origin */
    const char *const *cors_origins;
    /* origins with the same permission, whose pages may also show /embed in a frame; ends with NULL; may be NULL */
    const char *const *embed_origins;
    bool cross_site;   /* true if requests that were made by pages of other sites are accepted */
    unsigned jobs_kib; /* maximum size of the frames of all jobs in KiB; default 16 GiB */
    /* maximum number of assets, and maximum of their total size in KiB; defaults 64 and 256 MiB */
    unsigned assets, assets_kib;
    unsigned asset_keep_s;  /* seconds without use after which an asset may be evicted for a new one; default: a day */
    const char *token_file; /* file of access tokens and roles (http/access.h); NULL: everybody may send all requests */
    const char *share_key;  /* name of the key in token_file that signs the addresses of shared scenes; NULL: none */
    const char *sky;        /* PNG file with a photograph of the whole sky, which the page offers; NULL: none */
    const char *state;      /* folder for data that survive a restart (jobs, assets, budgets of links); NULL: none */
    /* milliseconds after a request to stop for which the server still serves requests, while /readyz fails; default
     * 1000 */
    unsigned drain_ms;
    /* seconds after a request to stop after which unfinished work is cancelled; default 600 */
    unsigned drain_s;
    unsigned rest_ms; /* milliseconds without work after which unneeded memory is freed; default 60 000 */
    /* maximum number of open connections; beyond it, clients get 503, except on the health routes; default 512 */
    unsigned connections;
    unsigned header_ms; /* deadline of a request's header in ms; default 10 000 */
    unsigned body_ms;   /* deadline of a request's body in ms, counted from the end of its header; default 30 000 */
    unsigned longest_s; /* renders with a longer estimated time, in s, are refused with 422; default 600 */
    /* number of times that a failed device is reopened within ten minutes; default 3; UINT_MAX: it is never reopened */
    unsigned reopenings;
    struct kd_renderer_params renderer;
};

/* Opens the device, starts the render thread, and listens. params and its strings may be freed after the call. A
 * parameter of 0 stands for its default. drain_ms UINT_MAX stands for no drain time. */
enum kd_status kd_server_create(const struct kd_server_params *params, struct kd_server **out, struct kd_error *error);
uint16_t kd_server_port(const struct kd_server *server);
/* The addresses and the name of this machine, ending with NULL, if the server listens on a wildcard address;
 * otherwise NULL. */
const char *const *kd_server_own_names(const struct kd_server *server);
/* Begins to stop the server. /readyz fails at once; running and queued renders are finished. Async-signal-safe. */
void kd_server_stop(struct kd_server *server);
/* Blocks until the server has stopped. Returns KD_EDEVICE if the device was lost for good or hangs. The process must
 * then end by _exit. It must not call kd_server_destroy, which would wait for threads that may never return. */
enum kd_status kd_server_wait(struct kd_server *server, struct kd_error *error);
/* Destroys the server. If it was not stopped before, running renders are cancelled, without a drain time. Accepts
 * NULL. */
void kd_server_destroy(struct kd_server *server);

#endif
