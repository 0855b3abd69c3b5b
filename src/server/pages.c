#include "server/assets.h"
#include "server/negotiate.h"
#include "server/reply.h"
#include "server/routes.h"

#include <stdlib.h>
#include <string.h>

static const struct kd_asset *find(const char *name)
{
    for (size_t i = 0; i < kd_n_assets; i++)
        if (!strcmp(kd_assets[i].name, name))
            return &kd_assets[i];
    return NULL;
}

/* "/" and what lies below "/web/". A page is small and may change with the next version of the program: it is asked for again each time, and
 * 304 says that it has not. */
enum MHD_Result kd_handle_page(struct kd_request *request)
{
    const struct kd_asset *asset = find(strcmp(request->route->path, "/") ? request->target.text + strlen("/web/") : "index.html");
    if (!asset)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND });
    struct kd_buffer encodings = kd_reply_header_list(request, "Accept-Encoding");
    struct kd_buffer known = kd_reply_header_list(request, "If-None-Match");
    bool gzip = kd_accepts_coding((const char *)encodings.data, "gzip");
    const struct kd_asset_form *form = gzip ? &asset->gzip : &asset->plain;
    bool same = kd_etag_listed((const char *)known.data, form->etag);
    kd_buffer_finish(&encodings);
    kd_buffer_finish(&known);

    struct MHD_Response *response = kd_reply_static(form->data, form->size, asset->type); /* of which 304 sends the header alone */
    if (!response)
        return MHD_NO;
    if (gzip)
        MHD_add_response_header(response, "Content-Encoding", "gzip");
    MHD_add_response_header(response, "ETag", form->etag);
    MHD_add_response_header(response, "Vary", "Accept-Encoding");
    /* blob: is how a picture whose headers were read gets into an <img>. */
    MHD_add_response_header(response, "Content-Security-Policy",
                            "default-src 'self'; img-src 'self' blob:; base-uri 'none'; form-action 'self'; "
                            "frame-ancestors 'none'");
    MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
    MHD_add_response_header(response, "Cache-Control", "no-cache");
    return kd_reply_send(request, same ? MHD_HTTP_NOT_MODIFIED : MHD_HTTP_OK, response);
}
