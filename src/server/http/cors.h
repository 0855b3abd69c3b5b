/* Cross-origin access (the Fetch standard's CORS protocol): answers preflight requests and sets the CORS headers. These
 * permit pages of the origins of --cors-origin and --embed-origin to use the server.
 *
 * A page sends its access token in Authorization or Kerrd-Access. No answer allows credentials, and the cookie of our
 * own page is ignored in cross-origin requests. */
#ifndef KD_SERVER_HTTP_CORS_H
#define KD_SERVER_HTTP_CORS_H

#include "base/error.h"
#include "server/http/request.h"

struct kd_cors;

/* Parses lists of origins as browsers send them: "https://host" or "http://host:port", with commas between. texts and
 * embeds are NULL-terminated, or NULL for none. Pages of embeds may also show /embed in a frame. "null" stands for
 * pages without an origin, such as files; it is not permitted in embeds. Returns KD_EINVAL with a message that names
 * the malformed origin. */
enum kd_status kd_cors_create(const char *const *texts, const char *const *embeds, struct kd_cors **out,
                              struct kd_error *error);
void kd_cors_destroy(struct kd_cors *cors); /* accepts NULL */

/* Returns the listed origin that sent the request. NULL if the origin is not listed, or if the request has no
 * Origin. This and all functions below: HTTP threads. */
const char *kd_cors_origin(const struct kd_request *request);
/* True if the request comes from a listed origin other than the server's own. The cookies of such a request are
 * ignored. */
bool kd_cors_foreign(const struct kd_request *request);
/* Adds the CORS headers to an answer if the request's origin is listed. No effect on a server without a list. */
void kd_cors_add(const struct kd_request *request, struct MHD_Response *response);

/* Returns the origins that may show /embed in a frame, as the value of the policy frame-ancestors. NULL if there are
 * none or cors is NULL. */
const char *kd_cors_embedders(const struct kd_cors *cors);

/* True if the request is a preflight. False on a server without a list. */
bool kd_cors_is_preflight(const struct kd_request *request);
/* Answers a preflight with the methods and request headers of the route. */
enum MHD_Result kd_cors_preflight(struct kd_request *request);

#endif
