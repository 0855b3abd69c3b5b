/* kerrd serve runs the HTTP service until a signal ends it. */
#include "cli/cli.h"
#include "cli/code.h"
#include "render/selftest/first_start.h"
#include "server/http/listen.h"
#include "server/server.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct arguments {
    const char *device, *listen, *base_path;
    const char *state, *token_file;
    uint64_t memory;
    unsigned port, queue, sessions, jobs, client_jobs, client_share, device_timeout, device_reopenings;
    bool cross_site, until_eof, insecure;
    const char **hosts; /* NULL-terminated once there is one */
    size_t n_hosts;
};

static const struct argp_option table[] = {
    { "listen", 'a', "ADDRESS", 0, "numeric address to listen on (default 127.0.0.1)", 0 },
    { "port", 'p', "PORT", 0, "TCP port, 0 for any free one (default 8080)", 0 },
    { "base-path", 'b', "/PREFIX", 0, "what stands before every path, as a proxy passes it on, like /some/prefix (default: $KERRD_BASE_PATH, else nothing)", 0 },
    { "token-file", 'T', "FILE", 0, "take requests with a token of this file alone; a line is NAME ROLE TOKEN, the role view or render", 0 },
    { "insecure", 'I', NULL, 0, "listen on an address that other machines reach without a token file: whoever reaches it may use it", 0 },
    { "queue", 'q', "N", 0, "renders that may wait for the device (default 16)", 0 },
    { "sessions", 's', "N", 0, "live sessions at once, and as many playgrounds (default 16)", 0 },
    { "jobs", 'j', "N", 0, "unfinished jobs at once (default 16)", 0 },
    { "client-share", 'C', "PERCENT", 0, "of each of these that one client, an address, may have (default 75)", 0 },
    { "jobs-per-client", 'J', "N", 0, "unfinished jobs of one client (default: by --client-share)", 0 },
    { "allow-cross-site", 'X', NULL, 0, "take requests that pages of other sites make, as by an <img>", 0 },
    { "state", 'S', "DIR", 0, "keep jobs and their frames, and assets, there, so that they survive a restart", 0 },
    { "until-eof", 'E', NULL, 0, "stop when standard input ends, as it does when the program that holds its other end is gone", 0 },
    { "device-timeout", 'D', "SECONDS", 0, "end with exit code 3 when the device has not finished a piece of work after so long (default 60)", 0 },
    { "device-reopenings", 'R', "N", 0, "open a device that fails again, so many times in ten minutes, before ending with exit code 3 (default 3)", 0 },
    KD_CLI_MEMORY,
    { "host", 'H', "NAME", 0, "answer requests for this host name too; may be repeated", 0 },
    { 0 },
};

static void add_host(struct arguments *arguments, const char *name, struct argp_state *state)
{
    const char **hosts = realloc(arguments->hosts, (arguments->n_hosts + 2) * sizeof *hosts);
    if (!hosts)
        argp_failure(state, KD_EXIT_FAILURE, ENOMEM, "--host");
    hosts[arguments->n_hosts++] = name;
    hosts[arguments->n_hosts] = NULL;
    arguments->hosts = hosts;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &arguments->device; return 0;
    case 'a': arguments->listen = text; return 0;
    case 'p': arguments->port = kd_cli_number(state, "--port", text, 0, 65535); return 0;
    case 'b': arguments->base_path = text; return 0;
    case 'q': arguments->queue = kd_cli_number(state, "--queue", text, 1, 100000); return 0;
    case 's': arguments->sessions = kd_cli_number(state, "--sessions", text, 1, 10000); return 0;
    case 'j': arguments->jobs = kd_cli_number(state, "--jobs", text, 1, 1000); return 0;
    case 'J': arguments->client_jobs = kd_cli_number(state, "--jobs-per-client", text, 1, 1000); return 0;
    case 'C': arguments->client_share = kd_cli_number(state, "--client-share", text, 1, 100); return 0;
    case 'D': arguments->device_timeout = kd_cli_number(state, "--device-timeout", text, 1, 3600); return 0;
    case 'R': arguments->device_reopenings = kd_cli_number(state, "--device-reopenings", text, 0, 1000000); return 0;
    case 'E': arguments->until_eof = true; return 0;
    case 'X': arguments->cross_site = true; return 0;
    case 'S': arguments->state = text; return 0;
    case 'T': arguments->token_file = text; return 0;
    case 'I': arguments->insecure = true; return 0;
    case 'M': arguments->memory = kd_cli_bytes(state, "--memory", text); return 0;
    case 'H': add_host(arguments, text, state); return 0;
    case ARGP_KEY_ARG: argp_error(state, "%s: it takes no argument", text); return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static struct kd_server *running; /* for the signal handler, which can be given nothing */

static void on_signal(int number)
{
    (void)number;
    kd_server_stop(running);
}

static void set_signals(void (*handler)(int))
{
    struct sigaction action = { .sa_handler = handler, .sa_flags = SA_RESTART };
    struct sigaction hangup;
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGINT, &action, NULL);
    if (!sigaction(SIGHUP, NULL, &hangup) && hangup.sa_handler != SIG_IGN) /* nohup wants it ignored */
        sigaction(SIGHUP, &action, NULL);
}

/* Whoever sits before the terminal may hold a telephone to it; a log file needs no code. */
static void show_code(const char *address, uint16_t port, const char *base_path, const char *const *own)
{
    const char *const listened[] = { address, NULL };
    const char *name = kd_cli_code_of(own ? own : listened);
    char text[600];
    if (!name || !isatty(STDOUT_FILENO))
        return;
    bool six = strchr(name, ':') && *name != '[';
    snprintf(text, sizeof text, "http://%s%s%s:%u%s/", six ? "[" : "", name, six ? "]" : "", port, base_path);
    printf("kerrd: for a telephone on this network, %s\n", text);
    if (kd_cli_code(stdout, text))
        fprintf(stderr, "kerrd: no memory for the code of %s\n", text);
}

static void announce(const char *address, uint16_t port, const char *base_path, const char *const *own)
{
    bool six = strchr(address, ':'); /* an IPv6 address needs brackets in a URL */
    printf("kerrd: listening on http://%s%s%s:%u%s/\n", six ? "[" : "", address, six ? "]" : "", port, base_path);
    for (const char *const *name = own; name && *name; name++)
        printf("kerrd: reached at http://%s:%u%s/\n", *name, port, base_path);
    show_code(address, port, base_path, own);
    /* Whoever started us may be waiting for this line in a pipe. A service goes on without one. */
    if (fflush(stdout) || ferror(stdout))
        fprintf(stderr, "kerrd: cannot write to standard output: %s\n", strerror(errno));
    clearerr(stdout);
}

/* Whoever has started this server holds the other end of its standard input, and lets go of it even where it is killed. */
static void *await_eof(void *unused)
{
    char bytes[64];
    ssize_t n;
    while ((n = read(STDIN_FILENO, bytes, sizeof bytes)) != 0) {
        if (n < 0 && errno == EAGAIN)
            poll(&(struct pollfd) { .fd = STDIN_FILENO, .events = POLLIN }, 1, -1);
        else if (n < 0 && errno != EINTR)
            break;
    }
    if (n < 0)
        fprintf(stderr, "kerrd: standard input cannot be read (%s), and the server stops\n", strerror(errno));
    kill(getpid(), SIGTERM);
    return unused;
}

static enum kd_status stop_at_eof(struct kd_error *error)
{
    pthread_t thread;
    int code = pthread_create(&thread, NULL, await_eof, NULL);
    if (code)
        return kd_error_set(error, KD_EIO, "no thread that waits for standard input to end: %s", strerror(code));
    pthread_detach(thread); /* it ends with the process */
    return KD_OK;
}

static enum kd_status serve(const struct arguments *arguments, struct kd_error *error)
{
    const struct kd_server_params params = {
        .listen = arguments->listen,
        .port = (uint16_t)arguments->port,
        .base_path = arguments->base_path,
        .hosts = arguments->hosts,
        .queue = arguments->queue,
        .sessions = arguments->sessions,
        .playgrounds = arguments->sessions,
        .jobs = arguments->jobs,
        .client_jobs = arguments->client_jobs,
        .client_share = arguments->client_share,
        .cross_site = arguments->cross_site,
        .state = arguments->state,
        .token_file = arguments->token_file,
        .reopenings = arguments->device_reopenings ? arguments->device_reopenings : UINT_MAX,
        .renderer = { .device = arguments->device, .prove = kd_first_start, .deadline_ms = 1000 * arguments->device_timeout, .memory_bytes = arguments->memory },
    };
    if (kd_listen_reaches_out(arguments->listen) && !arguments->token_file && !arguments->insecure)
        return kd_error_set(error, KD_EINVAL, "other machines reach --listen %.100s: --token-file FILE says who may use the server, --insecure lets everybody",
                            arguments->listen);
    enum kd_status status = kd_server_create(&params, &running, error);
    if (status)
        return status;
    set_signals(on_signal);
    if (arguments->until_eof)
        status = stop_at_eof(error);
    if (status) {
        kd_server_destroy(running);
        return status;
    }
    announce(arguments->listen, kd_server_port(running), arguments->base_path ? arguments->base_path : "", kd_server_own_names(running));
    status = kd_server_wait(running, error);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
    set_signals(SIG_IGN); /* nothing is left to stop; a second Ctrl-C must not cut the exit code short */
    kd_server_destroy(running);
    return status;
}

const struct argp *kd_cli_serve_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .doc =
            "Serve pictures over HTTP.\v"
            "SIGTERM, SIGINT or SIGHUP: /readyz fails at once, running and queued renders finish, then the exit code "
            "is 0. It is 3 when the device was lost for good, or hangs: start it again.",
        .children = kd_cli_device_children,
    };
    return &argp;
}

int kd_cli_serve(int argc, char **argv)
{
    struct arguments arguments = { .listen = "127.0.0.1", .base_path = getenv("KERRD_BASE_PATH"), .port = 8080, .device_timeout = 60, .device_reopenings = 3, .queue = 16, .sessions = 16, .jobs = 16 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_serve_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = serve(&arguments, &error);
    free(arguments.hosts);
    return status ? kd_cli_fail(&error) : KD_EXIT_OK;
}
