/* The public address of this server, for URLs that must be absolute: links and pictures that other sites show. It is
 * --public-url; without that, "http://" and the Host of the request, which the server has checked. */
#ifndef KD_SERVER_HTTP_PUBLIC_URL_H
#define KD_SERVER_HTTP_PUBLIC_URL_H

#include "server/http/request.h"

/* Makes the address out of text, "https://HOST", "https://HOST:PORT" or one of these and a path, in *out (malloc'd;
 * NULL where text is), and its host in *host, as a Host header is compared. Without a path the base path follows.
 * KD_EINVAL: a sentence says what it must be. */
enum kd_status kd_public_url_make(const char *text, const struct kd_base_path *base, char **out, char **host,
                                  struct kd_error *error);

/* Appends the address of the page without the slash behind it: "https://example.org/black-holes". HTTP threads. */
enum kd_status kd_public_url_write(const struct kd_request *request, struct kd_buffer *out);

#endif
