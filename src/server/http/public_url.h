/* The public address of this server. It is used in URLs that must be absolute, such as links and pictures that other
 * sites show. The address is --public-url. Without this option it is "http://" and the Host of the request, which
 * the server has checked. */
#ifndef KD_SERVER_HTTP_PUBLIC_URL_H
#define KD_SERVER_HTTP_PUBLIC_URL_H

#include "server/http/request.h"

/* Parses text of the form "https://HOST" or "https://HOST:PORT", optionally with a path. *out: the address
 * (malloc'd), or NULL if text is NULL; if it has no path, the base path is appended. *host: the host of the address,
 * in the form in which Host headers are compared. Returns KD_EINVAL with a message if text is malformed. */
enum kd_status kd_public_url_make(const char *text, const struct kd_base_path *base, char **out, char **host,
                                  struct kd_error *error);

/* Appends the address of the page without a slash at its end: "https://example.org/black-holes". HTTP threads. */
enum kd_status kd_public_url_write(const struct kd_request *request, struct kd_buffer *out);

#endif
