/* Handles the page and its files below /web/, and the sign-in by a token in the address. */
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

/* True if a file is sent with a Content-Security-Policy. Browsers apply this policy only to documents (HTML, SVG),
 * so scripts and styles are sent without it, which saves bytes. */
static bool document(const struct kd_served *file)
{
    return strncmp(file->type, "text/javascript", strlen("text/javascript")) &&
           strncmp(file->type, "text/css", strlen("text/css"));
}

/* Redirects from the base path without a slash at its end to the one with a slash. Without the slash, a browser
 * would look for the page's files one folder too high. */
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

/* If a page's address contains a token, sends it as a cookie, and redirects to the address without the token. The
 * browser keeps the fragment. The cookie has no Path, so browsers use the folder of the address. Behind a proxy only
 * the browser knows which folder that is. All pages are in the same folder. */
static enum MHD_Result signed_in(struct kd_request *request, const char *token)
{
    char cookie[KD_ACCESS_TOKEN_MAX + 80];
    const char *name = strrchr(request->route->path, '/') + 1;
    snprintf(cookie, sizeof cookie, "%s=%s; HttpOnly; SameSite=Strict", KD_ACCESS_COOKIE, token);
    struct MHD_Response *response = kd_reply_static("", 0, NULL);
    if (response) {
        MHD_add_response_header(response, "Set-Cookie", cookie);
        MHD_add_response_header(response, "Location", *name ? name : ".");
        MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
    }
    return kd_reply_send(request, MHD_HTTP_SEE_OTHER, response);
}

/* With blob: in the policy, a script can show pictures and films that it has fetched itself. It fetches a picture in
 * order to read its headers, and a film so that the <video> element can seek in it. */
static const char *const guarded[] = {
    "Content-Security-Policy",
    "default-src 'self'; img-src 'self' blob:; media-src 'self' blob:; base-uri 'none'; "
    "form-action 'self'; frame-ancestors 'none'",
    "Referrer-Policy", "no-referrer", NULL
};

/* Name of the file that belongs to a route. */
static const char *file_of(const struct kd_request *request)
{
    static const struct {
        const char *path, *file;
    } pages[] = {
        { "/", "index.html" },
        { "/story", "story/story.html" },
        { "/storia", "story/story-it.html" },
        { "/lesson", "lesson/lesson.html" },
    };
    for (size_t i = 0; i < sizeof pages / sizeof *pages; i++)
        if (!strcmp(request->route->path, pages[i].path))
            return pages[i].file;
    return request->target.path + strlen("/web/");
}

/* Handles "/", "/story", "/storia", "/lesson" and the files below "/web/". Browsers revalidate these files at each
 * use, because they are small and may change with the next version. */
enum MHD_Result kd_handle_page(struct kd_request *request)
{
    if (!*request->target.path)
        return moved(request);
    const char *token = kd_access_query(request);
    if (token)
        return signed_in(request, token);
    const struct kd_served *file = find(file_of(request));
    if (!file)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND });
    return kd_reply_served(request, file, document(file) ? guarded : NULL);
}
