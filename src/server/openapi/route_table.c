#include "server/openapi/route_table.h"

#include "base/markup.h"
#include "render/output/format.h"
#include "server/http/access.h"
#include "server/http/request.h"
#include "server/http/route.h"
#include "server/job/formats.h"
#include "server/openapi/access.h"
#include "server/openapi/problems.h"
#include "server/openapi/responses.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A page that is being written. */
struct page {
    struct kd_buffer *out;
    enum kd_status status;
    bool html;
};

static void put(struct page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(struct page *page, const char *format, ...)
{
    char text[1200];
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (!page->status)
        page->status = n < (int)sizeof text ? kd_buffer_append(page->out, text, (size_t)n) : KD_ENOMEM;
}

/* Writes ASCII text from a table. Text between backquotes is code. */
static void put_words(struct page *page, const char *words)
{
    bool code = false;
    struct kd_buffer escaped = { 0 };
    if (page->html && !page->status)
        page->status = kd_markup_escape(words, KD_MARKUP_CONTENT, &escaped);
    for (const char *text = escaped.data ? (const char *)escaped.data : words; *text; text++)
        if (page->html && *text == '`')
            put(page, (code = !code) ? "<code>" : "</code>");
        else if (!page->html && (*text == '|' || *text == '*'))
            put(page, "\\%c", *text);
        else
            put(page, "%c", *text);
    kd_buffer_finish(&escaped);
}

static void next_cell(struct page *page) { put(page, page->html ? "<td>" : " | "); }

/* Writes a media type, without its parameters. */
static void put_type(struct page *page, const char *type, size_t n, const char *gap)
{
    put(page, page->html ? "%s<code>%.*s</code>" : "%s`%.*s`", gap, (int)n, type);
}

static void put_types(struct page *page, const char *types, const char *gap)
{
    for (size_t n; types && *types; types += n + strspn(types + n, " "), gap = ", ")
        put_type(page, types, n = strcspn(types, " "), gap);
}

static void put_bytes(struct page *page, size_t bytes)
{
    const bool mib = bytes >= (size_t)1 << 20;
    put(page, ", at most %zu %s", bytes >> (mib ? 20 : 10), mib ? "MiB" : "KiB");
}

static void put_taken(struct page *page, const struct kd_route *route, unsigned method)
{
    const struct kd_taken *taken = &kd_taken[route->takes];
    const bool body = method == KD_POST || method == KD_PATCH || method == KD_PUT;
    /* In a route with several methods, GET and DELETE accept no request, except that a scene may be in the query. */
    const bool nothing = !body && (method == KD_DELETE || taken->changes || route->methods != method) &&
                         !(route->takes == KD_TAKES_SCENE && !(route->methods & KD_PATCH));
    put_words(page, nothing ? "nothing" : taken->about);
    if (!nothing && body) {
        put(page, ": ");
        put_types(page, taken->types ? taken->types : KD_JSON_TYPE, "");
        if (method == KD_PATCH)
            put_types(page, KD_PATCH_TYPE, ", ");
        put_bytes(page, taken->most ? taken->most : KD_BODY_MAX);
    }
    const char *gap = "; query: ";
    for (const struct kd_query *query = route->queries; query && query->name; query++)
        if (kd_route_for(query->methods, method)) {
            put_type(page, query->name, strlen(query->name), gap);
            if (query->was)
                put_type(page, query->was, strlen(query->was), ", formerly ");
            gap = ", ";
        }
}

static void put_given(struct page *page, const struct kd_route *route, unsigned method)
{
    const char *gap = "";
    struct kd_job_format format;
    if (method == KD_DELETE)
        put(page, "nothing");
    else if (route->answer)
        put_type(page, route->answer, strcspn(route->answer, ";"), "");
    if (method != KD_DELETE)
        put_types(page, route->also, ", ");
    for (size_t i = 0; route->gives == KD_GIVES_PICTURE && i < kd_n_formats; i++, gap = ", ")
        put_types(page, kd_formats[i]->media_type, gap);
    for (size_t i = 0; route->gives == KD_GIVES_RESULT && kd_job_format(i, &format); i++, gap = ", ")
        put_types(page, format.media_type, gap);
}

static const char *role_of(const struct kd_route *route, unsigned method)
{
    return route->open                                ? "everybody"
           : kd_openapi_is_owners(route, method)      ? "render, and the object's token"
           : kd_role_may(KD_ROLE_VIEW, route, method) ? "view"
                                                      : "render";
}

static void put_operation(struct page *page, const struct kd_route *route, const struct kd_method *method)
{
    unsigned statuses[KD_OPENAPI_SUCCESSES];
    put(page, page->html ? "<tr><td><code>%s %s</code>" : "| `%s %s`", method->name, route->path);
    next_cell(page);
    put_words(page, route->summary);
    next_cell(page);
    put_taken(page, route, method->bit);
    next_cell(page);
    put_given(page, route, method->bit);
    next_cell(page);
    const size_t n = kd_openapi_successes(route, method->bit, statuses);
    for (size_t i = 0; i < n; i++)
        put(page, "%s%u", i ? ", " : "", statuses[i]);
    for (unsigned status = 400; status < 600; status++)
        if (kd_openapi_has_problem(route, method->bit, status) && !kd_openapi_problem_is_common(status))
            put(page, ", %u", status);
    next_cell(page);
    put_words(page, role_of(route, method->bit));
    put(page, page->html ? "\n" : " |\n");
}

static enum kd_status write_page(struct page *page, const char *begin, const char *end)
{
    put(page, "%s", begin);
    for (size_t i = 0; i < kd_n_routes; i++)
        for (size_t k = 0; k < KD_METHODS; k++)
            if (kd_routes[i].methods & kd_methods[k].bit)
                put_operation(page, &kd_routes[i], &kd_methods[k]);
    put(page, "%s", end);
    return page->status;
}

#define COMMON "400, 401, 403, 408, 412, 413, 414, 421, 429, 431, 500, 503 and 505"

enum kd_status kd_route_table_markdown(struct kd_buffer *out)
{
    return write_page(
        &(struct page) { .out = out },
        "# Routes\n\nThis page is generated from `src/server/http/routes.def`; do not edit it. A server shows "
        "the same table at `/docs`, and\n`/openapi.json` has it for programs, with the schemas of bodies and "
        "answers. HEAD is served wherever GET is.\nThe statuses beside these are the same for all: " COMMON
        ".\n[The HTTP service](http.md) explains roles, limits and problems.\n\n| operation | what it does | "
        "takes | gives | statuses | role |\n|---|---|---|---|---|---|\n",
        "");
}

enum kd_status kd_route_table_html(struct kd_buffer *out)
{
    return write_page(
        &(struct page) { .out = out, .html = true },
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>Routes of kerrd</title><style>body{font:1rem/1.4 system-ui;margin:1rem}"
        "table{border-collapse:collapse}td,th{border:1px solid #8888;padding:.3rem .5rem;text-align:left;"
        "vertical-align:top}@media(prefers-color-scheme:dark){body{background:#111;color:#eee}}"
        "</style></head><body><h1>Routes of kerrd " KD_VERSION "</h1><p>For programs: <a "
        "href=\"openapi.json\">openapi.json</a>. HEAD is served wherever GET is. The statuses beside these are the "
        "same for all: " COMMON ".</p><table><tr><th>operation<th>what it does<th>takes<th>gives<th>statuses<th>role"
        "\n",
        "</table></body></html>\n");
}
