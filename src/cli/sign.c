/* kerrd sign: makes an address that works without an access token until it expires. */
#include "cli/cli.h"

#include "server/http/link.h"
#include "server/http/route.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LONGEST_S (3650.0 * 86400)
#define WHEN "a time such as 90m, 12h or 30d, of at most 10 years, or a date such as 2027-01-31 or 2027-01-31T18:00:00Z"

struct arguments {
    const char *address, *token_file, *key;
    struct kd_link_terms terms;
};

static const struct argp_option options[] = {
    { "token-file", 'T', "FILE", 0, "token file of the server; a key is a line NAME link KEY", 0 },
    { "key", 'k', "NAME", 0, "name of the key", 0 },
    { "expires", 'e', "WHEN", 0, "when the link ends: " WHEN, 0 },
    { "budget", 'b', "SECONDS", 0,
      "device time that all pictures by the link may use together, 0.001 to 86400 (default: no limit)", 0 },
    { 0 },
};

/* Reads a time: either a duration from now, or a date in UTC, which means the midnight at its start. */
static bool read_when(const char *text, uint64_t *out)
{
    static const struct {
        char unit;
        double s;
    } units[] = { { 'm', 60 }, { 'h', 3600 }, { 'd', 86400 } };
    const time_t now = time(NULL);
    char *end;
    const double n = strtod(text, &end);
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (*end == units[i].unit && !end[1] && n > 0 && n * units[i].s <= LONGEST_S) {
            *out = (uint64_t)now + (uint64_t)ceil(n * units[i].s);
            return true;
        }
    struct tm tm = { 0 };
    const char *rest = strptime(text, "%Y-%m-%d", &tm);
    if (rest && *rest)
        rest = strptime(rest, "T%H:%M:%SZ", &tm);
    const time_t then = rest && !*rest ? timegm(&tm) : 0;
    *out = (uint64_t)then;
    return then > now && (double)(then - now) <= LONGEST_S;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *a = state->input;
    switch (key) {
    case 'T': a->token_file = text; return 0;
    case 'k': a->key = text; return 0;
    case 'e':
        if (!read_when(text, &a->terms.expires_s))
            argp_error(state, "--expires is %s; it must be " WHEN ", in the future", text);
        return 0;
    case 'b': {
        char *end;
        const double s = strtod(text, &end);
        if (*end || end == text || !(s >= 1e-3 && s * 1e3 <= KD_LINK_BUDGET_MS))
            argp_error(state, "--budget is %s; it must be a number of seconds, 0.001 to %u", text,
                       KD_LINK_BUDGET_MS / 1000);
        a->terms.budget_ms = (uint64_t)llround(s * 1e3);
        return 0;
    }
    case ARGP_KEY_ARG:
        if (a->address)
            argp_error(state, "%s cannot be used with %s, because the command takes one address", text, a->address);
        a->address = text;
        return 0;
    case ARGP_KEY_END:
        if (!a->address)
            argp_error(state, "ADDRESS is missing; it must be an address of the server, such as "
                              "https://example.org/v1/render?preset=jet");
        if (!a->token_file)
            argp_error(state, "--token-file is missing; it must name the server's token file");
        if (!a->key)
            argp_error(state, "--key is missing; it must be the name of a key in the token file");
        if (!a->terms.expires_s)
            argp_error(state, "--expires is missing; it must be " WHEN);
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

/* Finds the longest end of the path that is a route for which links can be signed. folders: true: tries only routes
 * whose last parameter may contain slashes; false: tries only the other routes. */
static enum kd_status find_end(const char *path, bool folders, struct kd_buffer *out, bool *found)
{
    enum kd_status status = KD_OK;
    *found = false;
    for (const char *at = strchr(path, '/'); at && !*found; at = strchr(at + 1, '/')) {
        const char *rest = "";
        char *copy = strdup(at);
        if (!copy)
            return KD_ENOMEM;
        const struct kd_route *route = kd_route_of(copy, &rest);
        *found = route && kd_role_may(KD_ROLE_LINK, route, KD_GET) && route->folders == folders;
        if (*found)
            status = kd_route_path(route, rest, out);
        free(copy);
    }
    return status;
}

/* Writes the part of the path after the server's base path. Routes whose last parameter may contain slashes are
 * tried last, because the base path may look like the beginning of such a route. */
static enum kd_status below_base(const char *path, struct kd_buffer *out, struct kd_error *error)
{
    bool found;
    enum kd_status status = find_end(path, false, out, &found);
    if (!status && !found)
        status = find_end(path, true, out, &found);
    if (status)
        return kd_error_set(error, status, "out of memory for a path");
    if (found)
        return KD_OK;
    struct kd_buffer list = { 0 };
    for (size_t i = 0; i < kd_n_routes && !status; i++)
        if (kd_routes[i].signable)
            status = kd_buffer_printf(&list, "%s%s", list.size ? ", " : "", kd_routes[i].path);
    kd_error_set(error, KD_EINVAL, "the path is %.100s; it must end as one of %s", path,
                 list.data ? (const char *)list.data : "");
    kd_buffer_finish(&list);
    return KD_EINVAL;
}

static enum kd_status sign(const struct arguments *a, struct kd_error *error)
{
    struct kd_access *access = NULL;
    struct kd_target *target = calloc(1, sizeof *target);
    struct kd_buffer path = { 0 }, query = { 0 }, line = { 0 };
    char *raw = strdup(a->address), *authority = NULL;
    enum kd_status status;
    if (!target || !raw || kd_target_origin(raw, &authority))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for an address"));
    if (*raw != '/' || strchr(raw, '#'))
        KD_TRY(kd_error_set(error, KD_EINVAL,
                            "the address is %.100s; it must begin with http://, https:// or / and have no fragment",
                            a->address));
    KD_TRY(kd_access_read(a->token_file, &access, error));
    KD_TRY(kd_target_parse(target, raw, error));
    KD_TRY(kd_target_distinct(target, error));
    KD_TRY(below_base(target->path, &path, error));
    KD_TRY(kd_link_sign(access, a->key, (const char *)path.data, target, &a->terms, &query, error));
    if (kd_buffer_printf(&line, "%s%s%s\n", a->address, strchr(a->address, '?') ? "&" : "?", (const char *)query.data))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for an address"));
    if (kd_cli_print(line.data, line.size))
        KD_TRY(kd_error_set(error, KD_EIO, "cannot write to standard output"));
done:
    kd_access_free(access);
    if (target)
        kd_target_finish(target);
    free(target);
    free(raw);
    free(authority);
    kd_buffer_finish(&path);
    kd_buffer_finish(&query);
    kd_buffer_finish(&line);
    return status;
}

static const char doc[] =
    "Make a link: an address of a server with a token file that works without a token until it expires.\vThe key is a "
    "line NAME link KEY of the server's token file, with 32 to 256 characters. Whoever has the link may GET that "
    "address and no other. A link ends early when its key is removed from the file and the server is started again. "
    "The work for a link counts towards the limits of its key's name.";

const struct argp *kd_cli_sign_argp(void)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 3 }, { 0 } };
    static const struct argp argp = {
        .options = options, .parser = parse, .args_doc = "ADDRESS", .doc = doc, .children = children
    };
    return &argp;
}

int kd_cli_sign(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_error error = { 0 };
    argp_parse(kd_cli_sign_argp(), argc, argv, 0, NULL, &arguments);
    return sign(&arguments, &error) ? kd_cli_fail(&error) : KD_EXIT_OK;
}
