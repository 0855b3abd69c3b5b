#include "server/server.h"

#include "base/hash.h"
#include "base/log.h"
#include "server/asset/sky.h"
#include "server/asset/store.h"
#include "server/http/access.h"
#include "server/http/link_budgets.h"
#include "server/http/cors.h"
#include "server/http/auth_throttle.h"
#include "server/http/descriptors.h"
#include "server/reaper.h"
#include "server/http/library.h"
#include "server/http/listen.h"
#include "server/http/measures.h"
#include "server/http/names.h"
#include "server/http/public_url.h"
#include "server/http/request.h"
#include "server/http/service.h"
#include "server/job/jobs.h"
#include "server/lesson/lesson.h"
#include "server/openapi/cached_documents.h"
#include "server/playground/sessions.h"
#include "server/render/queue.h"
#include "server/render/thumbnails.h"
#include "server/session/sessions.h"
#include "server/dispatch.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

static unsigned or_default(unsigned value, unsigned otherwise) { return value ? value : otherwise; }

static bool add_host(struct kd_server *server, size_t *n, const char *name)
{
    server->hosts[*n] = strdup(name);
    return server->hosts[(*n)++];
}

/* Collects the accepted Host names: loopback by name and number, the host of the public URL, the names in `more`,
 * and the address on which the server listens. If that is a wildcard address, the addresses and the name of this
 * machine replace it. */
static enum kd_status collect_hosts(struct kd_server *server, const char *listen, const char *public_host,
                                    const char *const *more, struct kd_error *error)
{
    const char *names[] = { "127.0.0.1", "localhost", "[::1]", listen, public_host ? public_host : listen };
    enum { NAMES = sizeof names / sizeof *names };
    char bracketed[80];
    size_t n = 0, n_more = 0, n_own = 0;
    bool good = true;

    if (strchr(listen, ':') && *listen != '[') {
        snprintf(bracketed, sizeof bracketed, "[%s]", listen);
        names[3] = bracketed;
    }
    if (kd_names_any(listen) && !(server->own = kd_names_own(listen)))
        return kd_error_set(error, KD_ENOMEM, "cannot list the addresses of this machine");
    while (more && more[n_more])
        n_more++;
    while (server->own && server->own[n_own])
        n_own++;
    server->hosts = calloc(NAMES + n_own + n_more + 1, sizeof *server->hosts);
    for (size_t i = 0; good && server->hosts && i < NAMES + n_own + n_more; i++)
        good = add_host(server, &n,
                        i < NAMES           ? names[i]
                        : i < NAMES + n_own ? server->own[i - NAMES]
                                            : more[i - NAMES - n_own]);
    return good && server->hosts ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory");
}

/* Computes the part of a picture's ETag that does not depend on the scene. */
static void set_etag_tail(struct kd_server *server)
{
    const char *device = kd_render_queue_device_name(server->renders);
    const uint64_t hash = kd_hash(kd_hash(KD_HASH_BEGIN, KD_VERSION, sizeof KD_VERSION), device, strlen(device) + 1);
    snprintf(server->etag_tail, sizeof server->etag_tail, "%016llx", (unsigned long long)hash);
}

static struct MHD_Daemon *start_daemon(struct kd_server *server, unsigned connections)
{
    return MHD_start_daemon(
        MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG | MHD_USE_NO_LISTEN_SOCKET, 0,
        NULL, NULL, kd_request_handle, server, MHD_OPTION_EXTERNAL_LOGGER, kd_library_log, server->connections,
        MHD_OPTION_CONNECTION_LIMIT, connections, MHD_OPTION_CONNECTION_TIMEOUT, KD_IDLE_S,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)KD_HEADER_POOL, MHD_OPTION_URI_LOG_CALLBACK, kd_request_open,
        server, MHD_OPTION_NOTIFY_COMPLETED, kd_request_close, server, MHD_OPTION_NOTIFY_CONNECTION,
        kd_request_connection, server, MHD_OPTION_END);
}

/* The daemons' limits are higher than the server's, because a daemon at its limit closes connections without an
 * answer. */
static enum kd_status start_http(struct kd_server *server, int listener, unsigned connections, struct kd_error *error)
{
    server->daemon = start_daemon(server, 2 * kd_connections_most(connections));
    server->health_daemon = start_daemon(server, 8 * KD_HEALTH_CONNECTIONS);
    if (!server->daemon || !server->health_daemon) {
        close(listener);
        return kd_error_set(error, KD_EIO, "the HTTP service could not be started");
    }
    const struct kd_front_params front = { listener, server->connections, &server->base, server->health_daemon,
                                           server->daemon };
    return kd_front_create(&front, &server->front, error);
}

static enum kd_status start_reaper(struct kd_server *server, struct kd_error *error)
{
    if (pthread_create(&server->reaper, NULL, kd_reaper_main, server))
        return kd_error_set(error, KD_ENOMEM, "the reaper thread could not be started");
    server->reaper_runs = true;
    return KD_OK;
}

/* The part of a limit that one client may use, at least 1. */
static unsigned share_of(const struct kd_server_params *params, unsigned limit)
{
    unsigned percent = or_default(params->client_share, 75);
    unsigned share = (unsigned)((uint64_t)limit * (percent > 100 ? 100 : percent) / 100);
    return share ? share : 1;
}

static uint64_t bytes_share_of(const struct kd_server_params *params, uint64_t bytes)
{
    unsigned percent = or_default(params->client_share, 75);
    return bytes / 100 * (percent > 100 ? 100 : percent);
}

static enum kd_status start_sessions(struct kd_server *server, const struct kd_server_params *params,
                                     struct kd_error *error)
{
    const unsigned most = or_default(params->sessions, 16);
    const struct kd_sessions_params sessions = {
        .renders = server->renders,
        .limit = most,
        .client_limit = share_of(params, most),
        .idle_ms = or_default(params->session_ms, KD_SESSION_IDLE_MS),
        .longest_s = server->longest_s,
        .assets = kd_asset_store_assets(server->assets),
    };
    return kd_sessions_create(&sessions, &server->sessions, error);
}

static enum kd_status start_plays(struct kd_server *server, const struct kd_server_params *params,
                                  struct kd_error *error)
{
    const unsigned most = or_default(params->playgrounds, 16);
    const size_t bytes = params->playgrounds_kib ? (size_t)params->playgrounds_kib << 10 : KD_PLAYS_BYTES;
    const struct kd_playground_sessions_params playgrounds = {
        .sessions = server->sessions,
        .renders = server->renders,
        .limit = most,
        .client_limit = share_of(params, most),
        .idle_ms = or_default(params->session_ms, KD_SESSION_IDLE_MS),
        .bytes = bytes,
        .client_bytes = (size_t)bytes_share_of(params, bytes),
    };
    return kd_playground_sessions_create(&playgrounds, &server->playgrounds, error);
}

static enum kd_status start_jobs(struct kd_server *server, const struct kd_server_params *params,
                                 struct kd_error *error)
{
    const unsigned most = or_default(params->jobs, 16);
    const struct kd_jobs_params jobs = {
        .renders = server->renders,
        .scheduler = server->scheduler,
        .state = params->state,
        .limit = most,
        .stored = KD_JOBS_KEPT,
        .client_limit = params->client_jobs ? params->client_jobs : share_of(params, most),
        .longest_s = server->longest_s,
        .longest_job_s = KD_JOB_LONGEST_S,
        .bytes = params->jobs_kib ? (uint64_t)params->jobs_kib << 10 : KD_JOB_BYTES,
        .keep_s = KD_JOB_KEEP_S,
    };
    return kd_jobs_create(&jobs, &server->jobs, error);
}

static enum kd_status make_assets(struct kd_server *server, const struct kd_server_params *params,
                                  struct kd_error *error)
{
    const unsigned most = or_default(params->assets, KD_ASSETS);
    const uint64_t bytes = params->assets_kib ? (uint64_t)params->assets_kib << 10 : KD_ASSETS_BYTES;
    const struct kd_asset_limits limits = { most, share_of(params, most), bytes, bytes_share_of(params, bytes),
                                            params->asset_keep_s ? params->asset_keep_s : KD_ASSET_KEEP_S };
    return kd_asset_store_create(&limits, &server->assets, error);
}

static struct kd_renderer_params renderer_params(const struct kd_server *server, const struct kd_server_params *params)
{
    struct kd_renderer_params renderer = params->renderer;
    renderer.assets = kd_asset_store_assets(server->assets);
    return renderer;
}

static struct kd_quota quota_of(const struct kd_server *server, const char *client)
{
    return kd_render_queue_quota(server->renders, client);
}

static enum kd_status start_renders(struct kd_server *server, const struct kd_server_params *params, unsigned tasks,
                                    struct kd_error *error)
{
    const struct kd_renderer_params renderer = renderer_params(server, params);
    return kd_render_queue_create(&renderer, tasks, share_of(params, tasks), params->client_device_s,
                                  params->reopenings, &server->renders, error);
}

/* Stores the name of the key for shared scenes, if the token file contains this key. */
static enum kd_status take_share_key(struct kd_server *server, const char *name, struct kd_error *error)
{
    uint8_t ignored[KD_ACCESS_SIGNATURE];
    const struct kd_visitor *owner = NULL;
    if (!server->access || !kd_access_sign(server->access, name, "", 0, ignored, &owner))
        return kd_error_set(error, KD_EINVAL,
                            "--share-key is %.40s; it must be the name of a key of --token-file, a line NAME link KEY",
                            name);
    server->share_key = owner->name;
    return KD_OK;
}

static enum kd_status start(struct kd_server *server, const struct kd_server_params *params, struct kd_error *error)
{
    const char *address = params->listen ? params->listen : "127.0.0.1";
    unsigned connections = kd_descriptors_for(or_default(params->connections, 512));
    char *public_host = NULL;
    int fd = -1;

    server->port = params->port;
    server->drain_ms = params->drain_ms == UINT_MAX ? 0 : or_default(params->drain_ms, 1000);
    server->drain_s = or_default(params->drain_s, 600);
    server->longest_s = or_default(params->longest_s, 600);
    server->stop_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    server->connections =
        kd_connections_create(connections, share_of(params, connections), or_default(params->header_ms, 10000),
                              or_default(params->body_ms, 30000));
    server->cross_site = params->cross_site;
    const unsigned clients = kd_connections_most(connections);
    server->bodies = kd_bytes_create(
        &(struct kd_bytes_params) { clients, KD_BODIES_MAX, KD_BODIES_SHARE, KD_BODIES_SMALL, KD_BODY_MAX, false });
    server->replies = kd_bytes_create(&(struct kd_bytes_params) {
        clients, KD_REPLIES_MAX, share_of(params, KD_REPLIES_MAX), KD_REPLIES_RESERVE, KD_REPLIES_SMALL, true });
    server->measures = kd_measures_create();
    if (server->stop_fd < 0 || !server->connections || !server->bodies || !server->replies || !server->measures)
        return kd_error_set(error, KD_ENOMEM, "no memory or no descriptor for the server");
    enum kd_status status;
    KD_TRY(kd_base_path_init(&server->base, params->base_path, error));
    if (params->token_file)
        KD_TRY(kd_access_read(params->token_file, &server->access, error));
    if (params->token_file && !(server->links = kd_link_budgets_create()))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    if (params->share_key)
        KD_TRY(take_share_key(server, params->share_key, error));
    if (params->token_file && !(server->auth_throttle = kd_auth_throttle_create()))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    if (params->cors_origins || params->embed_origins)
        KD_TRY(kd_cors_create(params->cors_origins, params->embed_origins, &server->cors, error));
    KD_TRY(kd_public_url_make(params->public_url, &server->base, &server->public_url, &public_host, error));
    KD_TRY(collect_hosts(server, address, public_host, params->hosts, error));
    KD_TRY(kd_cached_documents_create(server->base.path, server->access != NULL, &server->documents, error));
    /* The socket comes first, because opening a device takes long, and "address in use" is the most common failure. */
    KD_TRY(kd_listen_open(address, &server->port, &fd, error));
    const unsigned tasks = or_default(params->queue, 16);
    KD_TRY(make_assets(server, params, error));
    KD_TRY(start_renders(server, params, tasks, error));
    server->quota = params->client_device_s ? quota_of : NULL;
    if (params->rest_ms)
        kd_render_queue_rest_after(server->renders, params->rest_ms);
    set_etag_tail(server);
    const struct kd_renderer_params renderer = renderer_params(server, params);
    KD_TRY(kd_thumbnails_create(server, &renderer, &server->thumbnails, error));
    KD_TRY(kd_scheduler_create(tasks, share_of(params, tasks), &server->rays, error));
    KD_TRY(kd_scheduler_create(tasks, share_of(params, tasks), &server->scheduler, error));
    KD_TRY(start_sessions(server, params, error));
    if (!(server->lessons = kd_lessons_create(share_of(params, KD_LESSONS))))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    KD_TRY(start_plays(server, params, error));
    KD_TRY(start_jobs(server, params, error));
    /* Assets are opened after the jobs, which lock the folder, and before kd_jobs_begin, because jobs may use
     * assets. */
    if (params->state)
        KD_TRY(kd_asset_store_open(server->assets, params->state, error));
    if (params->sky)
        KD_TRY(kd_asset_sky_open(server->assets, params->sky, &server->sky, error));
    if (params->state && server->links)
        KD_TRY(kd_link_budgets_open(server->links, params->state, error));
    kd_jobs_begin(server->jobs);
    const int listening = fd;
    fd = -1; /* from here on, the front owns the socket and closes it */
    KD_TRY(start_http(server, listening, connections, error));
    KD_TRY(start_reaper(server, error));
done:
    free(public_host);
    if (fd >= 0)
        close(fd);
    return status;
}

enum kd_status kd_server_create(const struct kd_server_params *params, struct kd_server **out, struct kd_error *error)
{
    struct kd_server *server = calloc(1, sizeof *server);
    if (!server)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    server->stop_fd = -1;
    pthread_mutex_init(&server->lock, NULL);
    pthread_cond_init(&server->changed, NULL);
    enum kd_status status = start(server, params, error);
    if (status) {
        kd_server_destroy(server);
        return status;
    }
    *out = server;
    return KD_OK;
}

const char *const *kd_server_own_names(const struct kd_server *server) { return (const char *const *)server->own; }

uint16_t kd_server_port(const struct kd_server *server) { return server->port; }

void kd_server_stop(struct kd_server *server)
{
    int serving = KD_SERVING;
    uint64_t one = 1;
    atomic_compare_exchange_strong(&server->phase, &serving, KD_DRAINING);
    if (write(server->stop_fd, &one, sizeof one) < 0) {
        /* The write can fail only if the counter is full. Then the reaper was already woken. */
    }
}

enum kd_status kd_server_wait(struct kd_server *server, struct kd_error *error)
{
    pthread_mutex_lock(&server->lock);
    while (!server->stopped)
        pthread_cond_wait(&server->changed, &server->lock);
    pthread_mutex_unlock(&server->lock);
    return kd_render_queue_lost(server->renders, error) ? KD_EDEVICE : KD_OK;
}

void kd_server_destroy(struct kd_server *server)
{
    if (!server)
        return;
    if (server->reaper_runs) {
        atomic_store(&server->abandon, true);
        kd_server_stop(server);
        pthread_join(server->reaper, NULL);
    } else {
        kd_front_destroy(server->front);
        if (server->daemon)
            MHD_stop_daemon(server->daemon);
        if (server->health_daemon)
            MHD_stop_daemon(server->health_daemon);
    }
    if (server->sessions)
        kd_sessions_close(server->sessions);
    if (server->playgrounds)
        kd_playground_sessions_close(server->playgrounds);
    if (server->jobs)
        kd_jobs_close(server->jobs);
    kd_playground_sessions_destroy(server->playgrounds);
    kd_scheduler_destroy(server->scheduler);
    kd_scheduler_destroy(server->rays);
    kd_thumbnails_destroy(server->thumbnails);
    kd_render_queue_destroy(server->renders);
    /* The sessions are destroyed after the queue, whose last frames refer to sessions. */
    kd_sessions_destroy(server->sessions);
    kd_lessons_destroy(server->lessons);
    kd_jobs_destroy(server->jobs);
    if (server->sky)
        kd_asset_release(server->assets, server->sky);
    kd_asset_store_close(server->assets);
    kd_connections_destroy(server->connections);
    kd_bytes_destroy(server->bodies);
    kd_bytes_destroy(server->replies);
    kd_cached_documents_destroy(server->documents);
    kd_measures_destroy(server->measures);
    for (size_t i = 0; server->hosts && server->hosts[i]; i++)
        free((void *)server->hosts[i]);
    free(server->hosts);
    free(server->public_url);
    kd_names_free(server->own);
    kd_access_free(server->access);
    kd_link_budgets_destroy(server->links);
    kd_auth_throttle_destroy(server->auth_throttle);
    kd_cors_destroy(server->cors);
    if (server->stop_fd >= 0)
        close(server->stop_fd);
    pthread_cond_destroy(&server->changed);
    pthread_mutex_destroy(&server->lock);
    free(server);
}
