/* Cross-origin access (the CORS protocol of the Fetch standard). Answers preflight requests and sets the CORS
 * headers, which permit pages from the origins of --cors-origin and --embed-origin to use the server. Such a page
 * sends its access token in Authorization or Kerrd-Access. No answer allows credentials, and kerrd's own cookie is
 * ignored in cross-origin requests. */
#ifndef KD_SERVER_HTTP_CORS_H
#define KD_SERVER_HTTP_CORS_H

#include "base/error.h"
#include "server/http/request.h"

struct kd_cors;

/* Parses lists of origins in the form that browsers send, "https://host" or "http://host:port", separated by commas.
 * texts and embeds are NULL-terminated arrays, or NULL if there are none. Pages from the origins in embeds may also
 * show /embed in a frame. "null" stands for pages without an origin, such as files; it is permitted only in texts.
 * Returns KD_EINVAL with a message that names the malformed origin. */
enum kd_status kd_cors_create(const char *const *texts, const char *const *embeds, struct kd_cors **out,
                              struct kd_error *error);
void kd_cors_destroy(struct kd_cors *cors); /* accepts NULL */

/* Returns the listed origin from which the request comes. Returns NULL if the origin is not listed, or if the
 * request has no Origin header. HTTP threads, like all functions below. */
const char *kd_cors_origin(const struct kd_request *request);
/* True if the request comes from a listed origin other than the server's own. The cookies of such a request are
 * ignored. */
bool kd_cors_foreign(const struct kd_request *request);
/* Adds the CORS headers to an answer if the request's origin is listed. Does nothing on a server without a list. */
void kd_cors_add(const struct kd_request *request, struct MHD_Response *response);

/* Returns the origins that may show /embed in a frame, as the value of the policy frame-ancestors. Returns NULL if
 * there are none, or if cors is NULL. */
const char *kd_cors_embedders(const struct kd_cors *cors);

/* True if the request is a preflight. Always false on a server without a list. */
bool kd_cors_is_preflight(const struct kd_request *request);
/* Answers a preflight with the methods and request headers of the route. */
enum MHD_Result kd_cors_preflight(struct kd_request *request);

#endif
