#include "cli/cli.h"

#include "base/log.h"
#include "base/utf8.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool kd_cli_set_log_level(const char *word)
{
    static const char *const levels[] = { "error", "warn", "info", "debug" };
    for (int i = 0; i < 4; i++)
        if (strcmp(word, levels[i]) == 0) {
            kd_log_set_level((enum kd_log_level)i);
            return true;
        }
    return false;
}

static error_t parse_log(int key, char *text, struct argp_state *state)
{
    if (key == 'h')
        argp_state_help(state, stdout, ARGP_HELP_STD_HELP);
    if (key != 'l')
        return ARGP_ERR_UNKNOWN;
    if (kd_cli_set_log_level(text))
        return 0;
    argp_error(state, "--log-level is %s; it must be error, warn, info or debug", text);
    return EINVAL;
}

static const struct argp_option log_options[] = {
    { "log-level", 'l', KD_CLI_LOG_LEVELS, 0, KD_CLI_LOG_LEVEL_DOC, 1 },
    { NULL, 'h', NULL, OPTION_HIDDEN, NULL, 1 }, /* -h does the same as --help; argp itself adds -? */
    { 0 },
};
const struct argp kd_cli_log_argp = { .options = log_options, .parser = parse_log };

static error_t parse_device(int key, char *text, struct argp_state *state)
{
    const char **device = state->input;
    if (key == ARGP_KEY_INIT) {
        const char *wish = getenv("KERRD_DEVICE");
        *device = wish && *wish ? wish : "auto";
        return 0;
    }
    if (key != 'd')
        return ARGP_ERR_UNKNOWN;
    *device = text;
    return 0;
}

static const struct argp_option device_options[] = {
    { "device", 'd', "DEVICE", 0, KD_CLI_DEVICE_DOC, 1 },
    { 0 },
};
const struct argp kd_cli_device_argp = { .options = device_options, .parser = parse_device };
const struct argp_child kd_cli_device_children[] = { { &kd_cli_device_argp, 0, NULL, 0 },
                                                     { &kd_cli_log_argp, 0, NULL, 0 },
                                                     { 0 } };

int kd_cli_fail(const struct kd_error *error)
{
    char line[sizeof error->message + sizeof error->pointer + 8], shown[4 * sizeof line];
    snprintf(line, sizeof line, error->pointer[0] ? "%s (at %s)" : "%s", error->message, error->pointer);
    /* Escapes the message, because it may quote escape sequences of a document, which terminals would execute. */
    kd_utf8_print(shown, sizeof shown, line);
    if (kd_log_get_format() == KD_LOG_JSON)
        kd_log(KD_LOG_ERROR, "%s", shown);
    else
        fprintf(stderr, "kerrd: %s\n", shown);
    return error->status == KD_EINVAL || error->status == KD_ETOOBIG ? KD_EXIT_USAGE : KD_EXIT_FAILURE;
}

enum kd_status kd_cli_prefix(struct kd_error *error, const char *name)
{
    char message[sizeof error->message];
    memcpy(message, error->message, sizeof message);
    /* Name and message are truncated if necessary; the message gets more room, because it matters more than the end
     * of a long path. */
    snprintf(error->message, sizeof error->message, "%.120s: %.350s", name, message);
    return error->status;
}

_Noreturn void kd_cli_device_lost(const struct kd_error *error)
{
    kd_cli_fail(error);
    fflush(NULL);
    _exit(KD_EXIT_DEVICE);
}

void kd_cli_stdout_failed(int number)
{
    static bool told; /* true after the first report: kd_cli_close_stdout fails as well, and must not report it again */
    if (number == EPIPE) {
        signal(SIGPIPE, SIG_DFL);
        raise(SIGPIPE);
    }
    if (!told)
        fprintf(stderr, "kerrd: cannot write to standard output: %s\n", strerror(number));
    told = true;
}

int kd_cli_print(const void *data, size_t size)
{
    errno = 0;
    if (!ferror(stdout) && fwrite(data, 1, size, stdout) == size && fflush(stdout) == 0)
        return KD_EXIT_OK;
    kd_cli_stdout_failed(errno ? errno : EIO);
    return KD_EXIT_FAILURE;
}

void kd_cli_close_stdout(void)
{
    errno = 0;
    if (!ferror(stdout) && fflush(stdout) == 0)
        return;
    kd_cli_stdout_failed(errno ? errno : EIO);
    _exit(KD_EXIT_FAILURE);
}

bool kd_cli_read_number(const char *text, unsigned minimum, unsigned maximum, unsigned *out)
{
    char *end;
    errno = 0;
    unsigned long value = strtoul(text, &end, 10);
    /* The first character is checked, because strtoul also accepts "-1" and " 1". */
    if (text[0] < '0' || text[0] > '9' || *end || errno || value < minimum || value > maximum)
        return false;
    *out = (unsigned)value;
    return true;
}

unsigned kd_cli_number(const struct argp_state *state, const char *option, const char *text, unsigned minimum,
                       unsigned maximum)
{
    unsigned value = 0;
    if (!kd_cli_read_number(text, minimum, maximum, &value))
        argp_error(state, "%s is %s; it must be a whole number from %u to %u", option, text, minimum, maximum);
    return value;
}

bool kd_cli_read_bytes(const char *text, uint64_t *out)
{
    static const char units[] = "KMGT";
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    const char *unit = *end ? strchr(units, *end) : NULL;
    int shift = unit ? 10 * (int)(unit - units + 1) : 0;
    if (text[0] < '0' || text[0] > '9' || !unit || end[1] || errno || value > UINT64_C(1) << (50 - shift) ||
        value << shift < 64 << 20)
        return false;
    *out = (uint64_t)value << shift;
    return true;
}

uint64_t kd_cli_bytes(const struct argp_state *state, const char *option, const char *text)
{
    uint64_t value = 0;
    if (!kd_cli_read_bytes(text, &value))
        argp_error(state, "%s %s: " KD_CLI_BYTES_ALLOWED, option, text);
    return value;
}

void kd_cli_add_axis(const char ***axes, size_t *n, const char *text, const struct argp_state *state)
{
    const char **more = realloc(*axes, (*n + 1) * sizeof *more);
    if (!more)
        argp_failure(state, KD_EXIT_FAILURE, 0, "out of memory");
    *axes = more;
    more[(*n)++] = text;
}
