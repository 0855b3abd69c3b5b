/* Cross-origin access (the Fetch standard's CORS protocol): answers preflight requests and sets the headers that let
 * pages of the origins of --cors-origin and --embed-origin use the server.
 *
 * A page sends its access token in Authorization or Kerrd-Access. No answer allows credentials, and the cookie of our
 * own page is ignored in cross-origin requests. */
#ifndef KD_SERVER_HTTP_CORS_H
#define KD_SERVER_HTTP_CORS_H

#include "base/error.h"
#include "server/http/request.h"

struct kd_cors;

/* Reads origins as browsers send them, "https://host" or "http://host:port", several of them in a text with commas
 * between; texts and embeds are NULL-terminated, or NULL for none. Pages of embeds may have /embed in a frame, too.
 * "null" stands for pages without an origin, files among them, which may have no frame. KD_EINVAL: one of them is
 * none, with what it should be. */
enum kd_status kd_cors_create(const char *const *texts, const char *const *embeds, struct kd_cors **out,
                              struct kd_error *error);
void kd_cors_destroy(struct kd_cors *cors); /* accepts NULL */

/* The origin of the page that asks, if it is listed; NULL: it is not, or nothing says that a page asks. HTTP
 * threads, as all that follows. */
const char *kd_cors_origin(const struct kd_request *request);
/* Whether it is listed, and another one than the server's own: then no cookie is looked at. */
bool kd_cors_foreign(const struct kd_request *request);
/* Adds to any answer what lets the page read it, where it may; nothing on a server without a list. */
void kd_cors_add(const struct kd_request *request, struct MHD_Response *response);

/* Those that may have /embed in a frame, as the policy frame-ancestors lists them; NULL: there are none, or cors is
 * NULL. */
const char *kd_cors_embedders(const struct kd_cors *cors);

/* Whether this is what a browser asks first, on a server with a list. */
bool kd_cors_is_preflight(const struct kd_request *request);
/* Answers it for the route that its target leads to: methods and request headers that are taken there. */
enum MHD_Result kd_cors_preflight(struct kd_request *request);

#endif
