/* The HTTP service: routes, limits, and a bounded queue in front of the render thread. It sees no Vulkan type. */
#ifndef KD_SERVER_SERVER_H
#define KD_SERVER_SERVER_H

#include "base/error.h"
#include "render/render.h"

#include <stdint.h>

struct kd_server;

struct kd_server_params {
    const char *listen; /* numeric address, default "127.0.0.1" */
    uint16_t port;      /* 0: any free port */
    const char
        *base_path; /* what stands before every path, as a proxy passes it on: "/some/prefix"; NULL or "": nothing */
    const char *public_url;   /* by which others reach the page (http/public_url.h); NULL: by the Host of a request */
    const char *const *hosts; /* Host names to accept besides loopback's, without port; NULL-terminated */
    unsigned queue;           /* renders that may wait, default 16 */
    unsigned sessions;        /* live ones at once, default 16 */
    unsigned session_ms;      /* that one lives on unwatched, default 60 000 */
    unsigned playgrounds;     /* at once, default 16; what session_ms says holds for them too */
    unsigned playgrounds_kib; /* of memory that all of them may take, default 1 GiB */
    unsigned jobs;            /* unfinished ones, default 16 */
    unsigned client_share;    /* percent of connections, renders that wait, sessions and jobs that one client may have;
                                 default 75 */
    unsigned client_jobs;     /* unfinished ones of one client; 0: by client_share */
    unsigned client_device_s; /* seconds of the device's time that one client may use in a minute; 0: all */
    const char *const *cors_origins;  /* of pages that may use it and read its answers (http/cors.h), NULL-terminated;
                                         NULL: none but its own */
    const char *const *embed_origins; /* of pages that may do so, and have /embed in a frame, NULL-terminated; NULL */
    bool cross_site;                  /* take requests that pages of other sites make */
    unsigned jobs_kib;                /* bytes of the frames of all jobs, default 16 GiB */
    unsigned assets, assets_kib;      /* assets at once, and the size of all of them; default 64 and 256 MiB */
    unsigned asset_keep_s;  /* how long an asset stays that nobody asks for, if others want its room; default a day */
    const char *token_file; /* who may use it, and how (http/access.h); NULL: everybody may do everything */
    const char *state;      /* a folder in which jobs and assets survive a restart; NULL: none */
    unsigned drain_ms;      /* how long it goes on serving after a stop request, with /readyz failing; default 1000 */
    unsigned
        drain_s; /* how long after a stop request accepted work may take; what is left then is cancelled. Default 600 */
    unsigned rest_ms;     /* without anything to do before memory is given back; default 60 000 */
    unsigned connections; /* connections at once; one more is answered 503, but on the health routes; default 512 */
    unsigned header_ms;   /* a request's header must be complete by then; default 10 000 */
    unsigned body_ms;     /* and its body so long after that; default 30 000 */
    unsigned longest_s;   /* a render estimated to take longer than this is refused with 422; default 600 */
    unsigned reopenings;  /* of a device that fails, within ten minutes; default 3, UINT_MAX: none */
    struct kd_renderer_params renderer;
};

/* Opens the device, starts the render thread and listens. params and its strings are not needed after the
 * call. A zero in it means the default; drain_ms UINT_MAX means no drain. */
enum kd_status kd_server_create(const struct kd_server_params *params, struct kd_server **out, struct kd_error *error);
uint16_t kd_server_port(const struct kd_server *server);
/* The addresses of this machine and its name, by which a server that listens on every address is reached,
 * NULL-terminated; else NULL. */
const char *const *kd_server_own_names(const struct kd_server *server);
/* Begin to stop: /readyz fails at once, running and queued renders finish. Async-signal-safe. */
void kd_server_stop(struct kd_server *server);
/* Block until stopped and drained. KD_EDEVICE when the device was lost for good, or hangs: end the process soon, by
 * _exit and without kd_server_destroy, which would wait for threads that may never come back. */
enum kd_status kd_server_wait(struct kd_server *server, struct kd_error *error);
/* Destroys the server. Without a stop before it, running renders are cancelled and nothing is drained. Accepts NULL. */
void kd_server_destroy(struct kd_server *server);

#endif
