#include "server/assets.h"
#include "server/reply.h"
#include "server/routes.h"

#include <string.h>

enum MHD_Result kd_handle_page(struct kd_request *request)
{
    for (size_t i = 0; i < kd_n_assets; i++) {
        if (strcmp(kd_assets[i].path, request->route->path))
            continue;
        struct MHD_Response *response =
            kd_reply_static(kd_assets[i].data, kd_assets[i].size, request->route->answer);
        if (!response)
            return MHD_NO;
        /* blob: is how a picture whose headers were read gets into an <img>. */
        MHD_add_response_header(
            response, "Content-Security-Policy",
            "default-src 'self'; img-src 'self' blob:; base-uri 'none'; form-action 'self'; "
            "frame-ancestors 'none'");
        MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
        MHD_add_response_header(response, "Cache-Control", "no-cache");
        return kd_reply_send(request, MHD_HTTP_OK, response);
    }
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND });
}
