#include "server/http/reply.h"
#include "server/http/representation.h"
#include "server/http/route.h"

#include <stdio.h>
#include <string.h>

static const struct kd_served *find(const char *name)
{
    for (size_t i = 0; i < kd_n_page_files; i++)
        if (!strcmp(kd_page_files[i].name, name))
            return &kd_page_files[i];
    return NULL;
}

/* A policy binds what a browser shows as a document by itself: HTML, SVG. Of a script or a style it binds nothing,
 * and with all those of the page it would weigh as much as the largest of them. */
static bool document(const struct kd_served *file)
{
    return strncmp(file->type, "text/javascript", strlen("text/javascript")) &&
           strncmp(file->type, "text/css", strlen("text/css"));
}

/* The base path itself, without the slash behind it, would have a browser look for the page's files one folder too
 * high. */
static enum MHD_Result moved(struct kd_request *request)
{
    const char *token = kd_access_query(request);
    char to[KD_BASE_PATH_MOST + KD_ACCESS_TOKEN_MAX + 16];
    snprintf(to, sizeof to, "%s/%s%s", strrchr(request->server->base.path, '/') + 1,
             token ? "?" KD_ACCESS_QUERY "=" : "", token ? token : "");
    struct MHD_Response *response = kd_reply_static("", 0, NULL);
    if (response)
        MHD_add_response_header(response, "Location", to);
    return kd_reply_send(request, MHD_HTTP_PERMANENT_REDIRECT, response);
}

/* Turns a token in the page's address into a cookie, and the address into one without it. The cookie's path is the
 * folder of the address, as browsers have it where none is named: behind a proxy only the browser knows that. */
static enum MHD_Result signed_in(struct kd_request *request, const char *token)
{
    char cookie[KD_ACCESS_TOKEN_MAX + 80];
    snprintf(cookie, sizeof cookie, "%s=%s; HttpOnly; SameSite=Strict", KD_ACCESS_COOKIE, token);
    struct MHD_Response *response = kd_reply_static("", 0, NULL);
    if (response) {
        MHD_add_response_header(response, "Set-Cookie", cookie);
        MHD_add_response_header(response, "Location", ".");
        MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
    }
    return kd_reply_send(request, MHD_HTTP_SEE_OTHER, response);
}

/* blob: is how a picture whose headers were read gets into an <img>. */
static const char *const guarded[] = { "Content-Security-Policy",
                                       "default-src 'self'; img-src 'self' blob:; base-uri 'none'; form-action "
                                       "'self'; frame-ancestors 'none'",
                                       "Referrer-Policy", "no-referrer", NULL };

/* "/" and what lies below "/web/". A page is small and may change with the next version of the program: it is asked
 * for again each time, and 304 says that it has not. */
enum MHD_Result kd_handle_page(struct kd_request *request)
{
    if (!*request->target.path)
        return moved(request);
    const char *token = kd_access_query(request);
    if (token)
        return signed_in(request, token);
    const struct kd_served *file =
        find(strcmp(request->route->path, "/") ? request->target.path + strlen("/web/") : "index.html");
    if (!file)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND });
    return kd_reply_served(request, file, document(file) ? guarded : NULL);
}
