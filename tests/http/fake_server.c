/* The HTTP service with the renderer that it is linked with: fake_server [--NAME VALUE]... NAME is a number of struct
 * kd_server_params, or --listen, --public-url, --host and --cors-origin (once each), --token-file, --share-key, --sky
 * or --device. */
#include "base/log.h"
#include "server/server.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct kd_server *server;

static void on_signal(int number)
{
    (void)number;
    kd_server_stop(server);
}

static int set(struct kd_server_params *params, const char *hosts[2], const char *origins[2], const char *embeds[2],
               const char *name, const char *value)
{
    struct {
        const char *name;
        unsigned *number;
    } numbers[] = {
        { "--queue", &params->queue },
        { "--sessions", &params->sessions },
        { "--session-ms", &params->session_ms },
        { "--playgrounds", &params->playgrounds },
        { "--playgrounds-kib", &params->playgrounds_kib },
        { "--jobs", &params->jobs },
        { "--client-jobs", &params->client_jobs },
        { "--client-share", &params->client_share },
        { "--client-device-seconds", &params->client_device_s },
        { "--jobs-kib", &params->jobs_kib },
        { "--assets", &params->assets },
        { "--assets-kib", &params->assets_kib },
        { "--asset-keep-s", &params->asset_keep_s },
        { "--drain-ms", &params->drain_ms },
        { "--drain-s", &params->drain_s },
        { "--rest-ms", &params->rest_ms },
        { "--header-ms", &params->header_ms },
        { "--body-ms", &params->body_ms },
        { "--connections", &params->connections },
        { "--longest-s", &params->longest_s },
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!strcmp(name, numbers[i].name))
            return *numbers[i].number = (unsigned)strtoul(value, NULL, 10), 1;
    if (!strcmp(name, "--port"))
        return params->port = (uint16_t)atoi(value), 1;
    if (!strcmp(name, "--listen"))
        return params->listen = value, 1;
    if (!strcmp(name, "--base-path"))
        return params->base_path = value, 1;
    if (!strcmp(name, "--public-url"))
        return params->public_url = value, 1;
    if (!strcmp(name, "--token-file"))
        return params->token_file = value, 1;
    if (!strcmp(name, "--share-key"))
        return params->share_key = value, 1;
    if (!strcmp(name, "--sky"))
        return params->sky = value, 1;
    if (!strcmp(name, "--state"))
        return params->state = value, 1;
    if (!strcmp(name, "--log-format"))
        return kd_log_set_format(strcmp(value, "json") ? KD_LOG_TEXT : KD_LOG_JSON), 1;
    if (!strcmp(name, "--device"))
        return params->renderer.device = value, 1;
    if (!strcmp(name, "--cors-origin"))
        return origins[0] = value, params->cors_origins = origins, 1;
    if (!strcmp(name, "--embed-origin"))
        return embeds[0] = value, params->embed_origins = embeds, 1;
    if (!strcmp(name, "--host"))
        return hosts[0] = value, params->hosts = hosts, 1;
    return !strcmp(name, "--log") ? kd_log_set_level((enum kd_log_level)atoi(value)), 1 : 0;
}

int main(int argc, char **argv)
{
    /* one client may use the whole limit, because most tests reach a limit from one address */
    struct kd_server_params params = { .client_share = 100 };
    struct kd_error error;
    const char *hosts[2] = { NULL, NULL }, *origins[2] = { NULL, NULL }, *embeds[2] = { NULL, NULL };

    for (int i = 1; i + 1 < argc; i += 2)
        if (!set(&params, hosts, origins, embeds, argv[i], argv[i + 1]))
            return fprintf(stderr, "fake_server: unknown option %s\n", argv[i]), 2;
    if (kd_server_create(&params, &server, &error))
        return fprintf(stderr, "fake_server: %s\n", error.message), 1;
    signal(SIGTERM, on_signal);
    signal(SIGINT, on_signal);
    printf("kerrd: listening on http://127.0.0.1:%u%s/\n", kd_server_port(server),
           params.base_path ? params.base_path : "");
    fflush(stdout);
    enum kd_status status = kd_server_wait(server, &error);
    if (status) {
        fprintf(stderr, "fake_server: %s\n", error.message);
        kd_server_destroy(server);
        _exit(1); /* the exit code of a process that has lost its device */
    }
    kd_server_destroy(server);
    return 0;
}
