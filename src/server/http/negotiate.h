/* Reads the header values that select an answer: Accept, Accept-Encoding, If-None-Match, Content-Type, Host. Pure; any
 * thread. */
#ifndef KD_SERVER_HTTP_NEGOTIATE_H
#define KD_SERVER_HTTP_NEGOTIATE_H

#include <stdbool.h>
#include <stddef.h>

/* How much an Accept value (RFC 9110, 12.5.1) wants a type is said by the most specific range that matches it.
 * Malformed entries match nothing; NULL or a blank value admits all. Which of n types, named by type(i, list), it
 * wants most: of several the first; n: none. */
size_t kd_accept_best(const char *accept, size_t n, const char *(*type)(size_t i, const void *list), const void *list);
const char *kd_accept_string(size_t i, const void *list); /* where list is of strings, const char *[] */

/* Whether an Accept-Encoding value (RFC 9110, 12.5.3) names the coding, or "*", by a weight above zero. NULL: no. */
bool kd_accepts_coding(const char *accept_encoding, const char *coding);

/* Whether an If-None-Match value names the entity tag (with its quotes), compared weakly, or is "*". */
bool kd_etag_listed(const char *if_none_match, const char *etag);

/* Whether an If-Match value names the entity tag, compared strongly, or is "*". etag NULL: there is none to be
 * named. */
bool kd_etag_matches(const char *if_match, const char *etag);

/* Whether a Content-Type value is this media type, whatever its parameters. */
bool kd_media_type_is(const char *content_type, const char *type);

/* Whether a Host value is a host and perhaps a port at all (RFC 3986 3.2.2), and not empty. */
bool kd_host_is_sound(const char *host);
/* Whether a Host value, without its port and a dot behind its last letter, is one of the NULL-terminated names. IPv6
 * literals in brackets. */
bool kd_host_listed(const char *host, const char *const *names);

#endif
