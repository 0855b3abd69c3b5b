#include "server/http/public_url.h"

#include "document/text.h"
#include "server/http/negotiate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HOST_MOST 255 /* maximum number of bytes of a host, including the port */

/* Returns the text after "https://" or "http://". Returns NULL if the text begins with neither. */
static const char *behind_scheme(const char *text)
{
    static const char *const schemes[] = { "https://", "http://" };
    for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++)
        if (!strncmp(text, schemes[i], strlen(schemes[i])))
            return text + strlen(schemes[i]);
    return NULL;
}

static enum kd_status refuse(const char *text, const char *wrong, struct kd_error *error)
{
    char given[80];
    kd_text_clip(given, sizeof given, text);
    return kd_error_set(error, KD_EINVAL, "the public URL is \"%s\": %s, as in \"https://example.org\"", given, wrong);
}

enum kd_status kd_public_url_make(const char *text, const struct kd_base_path *base, char **out, char **host,
                                  struct kd_error *error)
{
    struct kd_base_path own;
    char name[HOST_MOST + 1];
    *out = *host = NULL;
    const char *begin = text ? behind_scheme(text) : NULL;
    if (!text)
        return KD_OK;
    if (!begin)
        return refuse(text, "it must begin with https:// or http://", error);
    const size_t n = strcspn(begin, "/?#");
    snprintf(name, sizeof name, "%.*s", (int)n, begin);
    if (n > HOST_MOST || !kd_host_is_sound(name))
        return refuse(text, "after the scheme it must have a host and optionally a port", error);
    if (begin[n] && kd_base_path_init(&own, begin + n, NULL))
        return refuse(text, "after the host it must have nothing or a path like /some/prefix, without a final slash",
                      error);
    const char *path = begin[n] ? "" : base->path;
    *out = malloc(strlen(text) + strlen(path) + 1);
    *host = strndup(name, *name == '[' ? strcspn(name, "]") + 1 : strcspn(name, ":"));
    if (!*out || !*host)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    sprintf(*out, "%s%s", text, path);
    return KD_OK;
}

enum kd_status kd_public_url_write(const struct kd_request *request, struct kd_buffer *out)
{
    const struct kd_server *server = request->server;
    return server->public_url
               ? kd_buffer_printf(out, "%s", server->public_url)
               : kd_buffer_printf(out, "http://%s%s", request->header.host ? request->header.host : "localhost",
                                  server->base.path);
}
