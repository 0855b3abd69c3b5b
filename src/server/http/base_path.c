#include "server/http/base_path.h"

#include "document/text.h"

#include <stdio.h>
#include <string.h>

#define CHARACTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~@"

/* Returns the fault of the text, or NULL if it is valid. */
static const char *fault(const char *text)
{
    if (*text != '/')
        return "it must begin with a slash";
    if (strlen(text) > KD_BASE_PATH_MOST)
        return "it must have at most 200 characters";
    _Static_assert(KD_BASE_PATH_MOST == 200, "the sentence says so");
    for (const char *at = text; *at;) {
        const char *segment = at + 1;
        size_t n = strspn(segment, CHARACTERS);
        at = segment + n;
        if (*at && *at != '/')
            return "its segments must consist of letters, digits and - . _ ~ @";
        if (!n)
            return *at ? "it must not have two slashes in a row" : "it must not end with a slash";
        if ((n == 1 && *segment == '.') || (n == 2 && !strncmp(segment, "..", 2)))
            return "no segment of it may be . or ..";
    }
    return NULL;
}

enum kd_status kd_base_path_init(struct kd_base_path *base, const char *text, struct kd_error *error)
{
    char given[60];
    const char *wrong = text && *text ? fault(text) : NULL;
    *base = (struct kd_base_path) { 0 };
    if (wrong) {
        kd_text_clip(given, sizeof given, text);
        return kd_error_set(error, KD_EINVAL, "the base path is \"%s\": %s, as in \"/some/prefix\"", given, wrong);
    }
    snprintf(base->path, sizeof base->path, "%s", text ? text : "");
    snprintf(base->unknown, sizeof base->unknown, "there is no such path; %s/openapi.json lists all paths", base->path);
    snprintf(base->outside, sizeof base->outside,
             "this server answers only paths below its base path %s (kerrd serve --base-path), and /healthz, /readyz "
             "and /metrics",
             base->path);
    return KD_OK;
}

const char *kd_base_path_behind(const struct kd_base_path *base, const char *path)
{
    size_t n = strlen(base->path);
    if (!n)
        return path;
    return !strncmp(path, base->path, n) && (!path[n] || path[n] == '/') ? path + n : NULL;
}
