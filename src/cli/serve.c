/* kerrd serve: runs the HTTP service until a signal ends it. */
#include "base/allocator.h"
#include "base/log.h"
#include "cli/cli.h"
#include "cli/code.h"
#include "cli/serve_settings.h"
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

#define ROW(id, name, letter, argument, kind, least, most, initial, where, doc) \
    { name, argument, KD_SETTING_##kind, least, most, initial, KD_SETTING_##where, doc },
const struct kd_cli_setting kd_serve_settings[KD_SERVE_COUNT] = { KD_SERVE_SETTINGS(ROW, KD_SERVE_NOTHING) };
_Static_assert((int)KD_SERVE_COUNT <= (int)KD_SETTINGS_MOST, "the reader of a file has room for the table");

/* A switch may also be given with the value yes or no, so that a flag can override the file. */
#define OPTION(id, name, letter, argument, kind, least, most, initial, where, doc) \
    { name, letter, argument, KD_SETTING_##kind == KD_SETTING_SWITCH && argument ? OPTION_ARG_OPTIONAL : 0, doc, 0 },
#define HEADING(text) { NULL, 0, NULL, 0, text, 0 },
static const struct argp_option table[] = {
    KD_SERVE_SETTINGS(OPTION, HEADING) { NULL, 'h', NULL, OPTION_HIDDEN, NULL,
                                         0 }, /* -h does the same as --help; argp itself adds -? */
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct kd_settings *settings = state->input;
    struct kd_error error;
    char allowed[KD_ALLOWED_SIZE];
    if (key == 'h')
        argp_state_help(state, stdout, ARGP_HELP_STD_HELP);
    if (key == ARGP_KEY_ARG)
        argp_error(state, "%s cannot be used, because the command takes no argument", text);
    size_t i = 0; /* index of the setting; headings do not count */
    const struct argp_option *option = table;
    while (i < KD_SERVE_COUNT && option->key != key)
        i += (option++)->key != 0;
    if (i == KD_SERVE_COUNT)
        return ARGP_ERR_UNKNOWN;
    const char *value = text ? text : "yes";
    if (!kd_setting_takes(&kd_serve_settings[i], value, allowed))
        argp_error(state, "--%s %s: %s", option->name, value, allowed);
    if (kd_settings_give(settings, i, KD_BY_FLAG, value, &error))
        argp_failure(state, KD_EXIT_FAILURE, ENOMEM, "--%s", option->name);
    return 0;
}

static struct kd_server *running; /* global, because a signal handler has no argument for it */

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
    /* A signal that nohup has set to be ignored stays ignored. */
    if (!sigaction(SIGHUP, NULL, &hangup) && hangup.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &action, NULL);
}

/* Shows the QR code, but only on a terminal: a log file needs none. */
static void show_code(const char *address, uint16_t port, const char *base_path, const char *const *own)
{
    const char *const listened[] = { address, NULL };
    const char *name = kd_cli_code_of(own ? own : listened);
    char text[600];
    if (!name || !isatty(STDOUT_FILENO))
        return;
    bool six = strchr(name, ':') && *name != '[';
    snprintf(text, sizeof text, "http://%s%s%s:%u%s/", six ? "[" : "", name, six ? "]" : "", port, base_path);
    printf("kerrd: a telephone on this network can open %s\n", text);
    if (kd_cli_code(stdout, text))
        kd_log(KD_LOG_ERROR, "out of memory for the QR code of %s", text);
}

static void announce(const char *address, uint16_t port, const char *base_path, const char *const *own)
{
    bool six = strchr(address, ':'); /* in a URL an IPv6 address needs brackets */
    printf("kerrd: listening on http://%s%s%s:%u%s/\n", six ? "[" : "", address, six ? "]" : "", port, base_path);
    for (const char *const *name = own; name && *name; name++)
        printf("kerrd: reachable at http://%s:%u%s/\n", *name, port, base_path);
    show_code(address, port, base_path, own);
    /* A parent process may wait for this line in a pipe. The service continues even if the line cannot be written. */
    if (fflush(stdout) || ferror(stdout))
        kd_log(KD_LOG_ERROR, "cannot write to standard output: %s", strerror(errno));
    clearerr(stdout);
}

/* Waits for the end of standard input. The parent process holds the other end of the pipe, which closes even if the
 * parent is killed. */
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
        kd_log(KD_LOG_ERROR, "cannot read standard input (%s); the server stops", strerror(errno));
    kill(getpid(), SIGTERM);
    return unused;
}

static enum kd_status stop_at_eof(struct kd_error *error)
{
    pthread_t thread;
    int code = pthread_create(&thread, NULL, await_eof, NULL);
    if (code)
        return kd_error_set(error, KD_EIO, "cannot start the thread that waits for the end of standard input: %s",
                            strerror(code));
    pthread_detach(thread); /* not joined, because the thread ends together with the process */
    return KD_OK;
}

static enum kd_status serve(const struct kd_settings *settings, struct kd_error *error)
{
    const char *listen = kd_settings_text(settings, KD_SERVE_LISTEN),
               *base_path = kd_settings_text(settings, KD_SERVE_BASE_PATH);
    const unsigned reopenings = kd_settings_number(settings, KD_SERVE_DEVICE_REOPENINGS);
    const struct kd_server_params params = {
        .listen = listen,
        .port = (uint16_t)kd_settings_number(settings, KD_SERVE_PORT),
        .base_path = base_path,
        .public_url = kd_settings_text(settings, KD_SERVE_PUBLIC_URL),
        .hosts = kd_settings_list(settings, KD_SERVE_HOST),
        .cors_origins = kd_settings_list(settings, KD_SERVE_CORS_ORIGIN),
        .embed_origins = kd_settings_list(settings, KD_SERVE_EMBED_ORIGIN),
        .queue = kd_settings_number(settings, KD_SERVE_QUEUE),
        .sessions = kd_settings_number(settings, KD_SERVE_SESSIONS),
        .playgrounds = kd_settings_number(settings, KD_SERVE_SESSIONS),
        .jobs = kd_settings_number(settings, KD_SERVE_JOBS),
        .client_jobs = kd_settings_number(settings, KD_SERVE_CLIENT_JOBS),
        .client_share = kd_settings_number(settings, KD_SERVE_CLIENT_SHARE),
        .client_device_s = kd_settings_number(settings, KD_SERVE_CLIENT_DEVICE_S),
        .drain_s = kd_settings_number(settings, KD_SERVE_DRAIN),
        .cross_site = kd_settings_switch(settings, KD_SERVE_CROSS_SITE),
        .state = kd_settings_text(settings, KD_SERVE_STATE),
        .token_file = kd_settings_text(settings, KD_SERVE_TOKEN_FILE),
        .share_key = kd_settings_text(settings, KD_SERVE_SHARE_KEY),
        .sky = kd_settings_text(settings, KD_SERVE_SKY),
        .reopenings = reopenings ? reopenings : UINT_MAX,
        .renderer = { .device = kd_settings_text(settings, KD_SERVE_DEVICE),
                      .prove = kd_first_start,
                      .deadline_ms = 1000 * kd_settings_number(settings, KD_SERVE_DEVICE_TIMEOUT),
                      .memory_bytes = kd_settings_bytes(settings, KD_SERVE_MEMORY) },
    };
    if (kd_listen_reaches_out(listen) && !params.token_file && !kd_settings_switch(settings, KD_SERVE_INSECURE))
        return kd_error_set(error, KD_EINVAL,
                            "other machines can reach --listen %.100s: give --token-file FILE for users with tokens, "
                            "or --insecure for everybody",
                            listen);
    kd_allocator_for_long();
    enum kd_status status = kd_server_create(&params, &running, error);
    if (status)
        return status;
    set_signals(on_signal);
    if (kd_settings_switch(settings, KD_SERVE_UNTIL_EOF))
        status = stop_at_eof(error);
    if (status) {
        kd_server_destroy(running);
        return status;
    }
    announce(listen, kd_server_port(running), base_path ? base_path : "", kd_server_own_names(running));
    status = kd_server_wait(running, error);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
    /* From here on signals are ignored: the server has stopped, and another Ctrl-C must not change the exit code. */
    set_signals(SIG_IGN);
    kd_server_destroy(running);
    return status;
}

const struct argp *kd_cli_serve_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .doc = "Serve pictures over HTTP.\vOn SIGTERM, SIGINT or SIGHUP /readyz fails at once, and running and queued "
               "renders finish within --drain-seconds; then the exit code is 0. The exit code is 3 when the device is "
               "lost or hangs: start the server again.\nAn option may also be in the environment, as "
               "KERRD_CLIENT_SHARE=50 for --client-share, or in the file that --config names, as {\"client-share\": "
               "50}. A flag overrides the environment, which overrides the file.",
    };
    return &argp;
}

static void set_log(const struct kd_settings *settings)
{
    kd_cli_set_log_level(kd_settings_text(settings, KD_SERVE_LOG_LEVEL));
    kd_log_set_format(strcmp(kd_settings_text(settings, KD_SERVE_LOG_FORMAT), "json") ? KD_LOG_TEXT : KD_LOG_JSON);
}

/* Reads the environment and the configuration file. The flags were read before: they may name the file, and they
 * take precedence. */
static enum kd_status configure(struct kd_settings *settings, struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(kd_settings_read_environment(settings, environ, error));
    /* set before the file is read, so that errors in the file are logged at the level and in the format of flags and
     * environment */
    set_log(settings);
    if (kd_settings_text(settings, KD_SERVE_CONFIG))
        KD_TRY(kd_settings_read_file(settings, kd_settings_text(settings, KD_SERVE_CONFIG), error));
    set_log(settings);
    kd_settings_warn(settings, environ);
done:
    return status;
}

int kd_cli_serve(int argc, char **argv)
{
    struct kd_settings settings;
    struct kd_error error = { 0 };
    enum kd_status status = kd_settings_init(&settings, kd_serve_settings, KD_SERVE_COUNT, &error);
    if (status)
        return kd_cli_fail(&error);
    argp_parse(kd_cli_serve_argp(), argc, argv, 0, NULL, &settings);
    status = configure(&settings, &error);
    int code = KD_EXIT_OK;
    if (!status && kd_settings_switch(&settings, KD_SERVE_SHOW_CONFIG))
        code = kd_settings_show(&settings);
    else if (!status)
        status = serve(&settings, &error);
    kd_settings_finish(&settings);
    return status ? kd_cli_fail(&error) : code;
}
