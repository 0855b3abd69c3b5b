/* Handlers of /s/CODE and /embed/CODE. /s/CODE is a page from which other sites read the title, the description and
 * the picture of a link (Open Graph, https://ogp.me; oEmbed). For visitors, its script opens the main page with the
 * scene. Without scripts, and for a visitor who came by a signed link, it shows the picture and a link instead. */
#include "server/answers/share.h"

#include "base/markup.h"
#include "base/percent.h"
#include "server/http/cors.h"
#include "server/http/reply.h"

#include <string.h>

/* Indices of the page's placeholders. STYLE, ICON and SEEN (the picture): queries that sign these files. URL: the
 * address, encoded as the value of a parameter. OTHER: the signed path of the right picture of a pair, or "". */
enum { TITLE, ABOUT, ADDRESS, PICTURE, HOME, CODE, URL, OPEN, STYLE, ICON, SEEN, OTHER, OTHER_PICTURE, TEXTS };

/* Writes elements that are useful only if the visitor has access or the server requires no access token: the link to
 * oEmbed, for other sites, and the script that opens the page with the live view. */
static enum kd_status write_live(const char *const t[TEXTS], struct kd_buffer *page)
{
    return kd_buffer_printf(
        page,
        "<link rel=\"alternate\" type=\"application/json+oembed\" href=\"%s/oembed?url=%s\" title=\"%s\">\n"
        "<script type=\"module\" src=\"../web/share/shared.js\"></script>\n",
        t[HOME], t[URL], t[TITLE]);
}

/* Writes the picture, or both pictures of a pair. */
static enum kd_status write_pictures(const char *const t[TEXTS], struct kd_buffer *page)
{
    enum kd_status status =
        kd_buffer_printf(page, "<img src=\"../v1/share/%s/picture.png%s\" width=\"%d\" height=\"%d\" alt=\"%s\">",
                         t[CODE], t[SEEN], KD_SHARED_WIDTH, KD_SHARED_HEIGHT, t[ABOUT]);
    if (!status && *t[OTHER])
        status = kd_buffer_printf(page, "<img src=\"%s\" width=\"%d\" height=\"%d\" alt=\"\">", t[OTHER],
                                  KD_SHARED_WIDTH, KD_SHARED_HEIGHT);
    return status;
}

/* live: true if the visitor can use the page with the live view without signing in. */
static enum kd_status write_page(const char *const t[TEXTS], bool live, struct kd_buffer *page)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(
        page,
        "<!doctype html>\n<html lang=\"en\" prefix=\"og: https://ogp.me/ns#\">\n<head>\n"
        "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"dark\">\n"
        "<title>%s – kerrd</title>\n<meta name=\"description\" content=\"%s\">\n"
        "<link rel=\"canonical\" href=\"%s\">\n"
        "<meta property=\"og:type\" content=\"website\">\n<meta property=\"og:site_name\" content=\"kerrd\">\n"
        "<meta property=\"og:title\" content=\"%s\">\n<meta property=\"og:description\" content=\"%s\">\n"
        "<meta property=\"og:url\" content=\"%s\">\n<meta property=\"og:image\" content=\"%s\">\n"
        "<meta property=\"og:image:type\" content=\"image/png\">\n"
        "<meta property=\"og:image:width\" content=\"%d\">\n<meta property=\"og:image:height\" content=\"%d\">\n"
        "<meta property=\"og:image:alt\" content=\"%s\">\n"
        "<meta name=\"twitter:card\" content=\"summary_large_image\">\n"
        "<link rel=\"icon\" type=\"image/svg+xml\" href=\"../web/icon.svg%s\">\n"
        "<link rel=\"stylesheet\" href=\"../web/share/shared.css%s\">\n",
        t[TITLE], t[ABOUT], t[ADDRESS], t[TITLE], t[ABOUT], t[ADDRESS], t[PICTURE], KD_SHARED_WIDTH, KD_SHARED_HEIGHT,
        t[ABOUT], t[ICON], t[STYLE]));
    if (*t[OTHER_PICTURE]) /* the second picture, in an Open Graph array: sites prefer the first one */
        KD_TRY(kd_buffer_printf(page, "<meta property=\"og:image\" content=\"%s\">\n", t[OTHER_PICTURE]));
    if (live)
        KD_TRY(write_live(t, page));
    KD_TRY(kd_buffer_printf(page, "</head>\n<body>\n<main>\n<h1>%s</h1>\n%s", t[TITLE], live ? "<noscript>" : ""));
    KD_TRY(write_pictures(t, page));
    KD_TRY(kd_buffer_printf(page,
                            "%s\n<p>%s</p>\n<p><a id=\"open\" href=\"../#%s\">Open it live</a></p>\n"
                            "</main>\n</body>\n</html>\n",
                            live ? "</noscript>" : "", t[ABOUT], t[OPEN]));
done:
    return status;
}

static enum kd_status make_page(const struct kd_request *request, const struct kd_shared *shared,
                                struct kd_buffer *page)
{
    struct kd_buffer url = { 0 }, open = { 0 }, style = { 0 }, icon = { 0 }, seen = { 0 }, other = { 0 },
                     escaped[TEXTS] = { 0 };
    const char *texts[TEXTS], *query = strchr((const char *)shared->picture.data, '?');
    const char *right = (const char *)shared->other_picture.data;
    enum kd_status status;
    KD_TRY(kd_percent_append(shared->address.data, shared->address.size, "", &url));
    KD_TRY(kd_shared_sign(request, "/web/share/shared.css", &style));
    KD_TRY(kd_shared_sign(request, "/web/icon.svg", &icon));
    KD_TRY(kd_buffer_printf(&seen, "%s", query ? query : ""));
    KD_TRY(kd_shared_fragment(shared, &open));
    KD_TRY(kd_buffer_printf(&other, "%s%s", *right ? ".." : "", *right ? right + shared->home.size : ""));
    const struct kd_buffer *const all[TEXTS] = {
        [TITLE] = &shared->title,
        [ABOUT] = &shared->about,
        [ADDRESS] = &shared->address,
        [PICTURE] = &shared->picture,
        [HOME] = &shared->home,
        [CODE] = &shared->code,
        [URL] = &url,
        [OPEN] = &open,
        [STYLE] = &style,
        [ICON] = &icon,
        [SEEN] = &seen,
        [OTHER] = &other,
        [OTHER_PICTURE] = &shared->other_picture,
    };
    for (int i = 0; i < TEXTS; i++) {
        KD_TRY(kd_markup_escape((const char *)all[i]->data, KD_MARKUP_ATTRIBUTE, &escaped[i]));
        texts[i] = (const char *)escaped[i].data;
    }
    KD_TRY(write_page(texts, !request->link.on, page));
done:
    kd_buffer_finish(&url);
    kd_buffer_finish(&open);
    kd_buffer_finish(&style);
    kd_buffer_finish(&icon);
    kd_buffer_finish(&seen);
    kd_buffer_finish(&other);
    for (int i = 0; i < TEXTS; i++)
        kd_buffer_finish(&escaped[i]);
    return status;
}

static enum MHD_Result reply(struct kd_request *request, const struct kd_shared *shared)
{
    struct kd_buffer page = { 0 };
    if (make_page(request, shared, &page)) {
        kd_buffer_finish(&page);
        return kd_reply_no_memory(request);
    }
    struct MHD_Response *response = kd_reply_text(request, &page, KD_HTML_TYPE);
    if (response) {
        MHD_add_response_header(response, "Content-Security-Policy",
                                "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
        MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
        MHD_add_response_header(response, "Cache-Control", "no-cache");
    }
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

/* Makes the page that other sites embed in a frame. The code is decoded to a link, and the page contains a new code
 * made from this link, never the received one. */
static enum kd_status make_frame(const struct kd_shared *shared, struct kd_buffer *page)
{
    struct kd_buffer texts[3] = { 0 };
    const struct kd_buffer *const all[] = { &shared->title, &shared->link, &shared->about };
    enum kd_status status;
    for (int i = 0; i < 3; i++)
        KD_TRY(kd_markup_escape((const char *)all[i]->data, KD_MARKUP_ATTRIBUTE, &texts[i]));
    KD_TRY(kd_buffer_printf(page,
                            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                            "<meta name=\"robots\" content=\"noindex\">\n<title>%s – kerrd</title>\n"
                            "<link rel=\"stylesheet\" href=\"../web/embed.css\">\n"
                            "<script type=\"module\" src=\"../web/kerr-hole.js\"></script>\n</head>\n<body>\n"
                            "<main>\n<h1>%s</h1>\n<kerr-hole scene=\"%s\" label=\"%s\" interactive></kerr-hole>\n"
                            "<noscript><img src=\"../v1/share/%s/picture.png\" alt=\"%s\"></noscript>\n"
                            "</main>\n</body>\n</html>\n",
                            (const char *)texts[0].data, (const char *)texts[0].data, (const char *)texts[1].data,
                            (const char *)texts[2].data, (const char *)shared->code.data, (const char *)texts[2].data));
done:
    for (int i = 0; i < 3; i++)
        kd_buffer_finish(&texts[i]);
    return status;
}

static enum MHD_Result reply_frame(struct kd_request *request, const struct kd_shared *shared)
{
    struct kd_buffer page = { 0 }, policy = { 0 };
    const char *embedders = kd_cors_embedders(request->server->cors);
    struct MHD_Response *response = NULL;
    if (!make_frame(shared, &page) && !kd_buffer_printf(&policy,
                                                        "default-src 'self'; img-src 'self' blob:; base-uri 'none'; "
                                                        "form-action 'none'; frame-ancestors %s",
                                                        embedders ? embedders : "'none'"))
        response = kd_reply_text(request, &page, KD_HTML_TYPE);
    if (response) {
        MHD_add_response_header(response, "Content-Security-Policy", (const char *)policy.data);
        MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
        MHD_add_response_header(response, "Cache-Control", "no-cache");
    }
    kd_buffer_finish(&page);
    kd_buffer_finish(&policy);
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result answer(struct kd_request *request,
                              enum MHD_Result (*reply_with)(struct kd_request *, const struct kd_shared *))
{
    struct kd_shared_scenes scenes;
    struct kd_problem problem;
    struct kd_error error = { 0 };
    struct kd_shared shared;
    enum MHD_Result result;
    if (!kd_shared_read(request->rest, &scenes, &problem, &error))
        return kd_reply_problem(request, &problem);
    result = kd_shared_tell(request, &scenes, &shared, &error) ? kd_reply_error(request, &error)
                                                               : reply_with(request, &shared);
    kd_shared_finish(&shared);
    return result;
}

enum MHD_Result kd_handle_shared(struct kd_request *request) { return answer(request, reply); }

/* /embed/CODE: the picture alone, for a frame in another page. When it is touched, it becomes a live view. */
enum MHD_Result kd_handle_embed(struct kd_request *request) { return answer(request, reply_frame); }
