/* Reads the headers by which an answer is selected: Accept, Accept-Encoding, If-None-Match, Content-Type, Host.
 * Pure; any thread. */
#ifndef KD_SERVER_HTTP_NEGOTIATE_H
#define KD_SERVER_HTTP_NEGOTIATE_H

#include <stdbool.h>
#include <stddef.h>

/* Chooses, from n types, the media type that an Accept header (RFC 9110 12.5.1) prefers. type(i, list) returns the
 * types. The weight of a type is that of the most specific range that matches it. Of equally preferred types, the
 * first is chosen. Malformed entries match nothing; NULL or a blank header accepts everything. Returns n if no type
 * is acceptable. */
size_t kd_accept_best(const char *accept, size_t n, const char *(*type)(size_t i, const void *list), const void *list);
/* for use as `type` if the list is an array of const char * */
const char *kd_accept_string(size_t i, const void *list);

/* True if an Accept-Encoding header (RFC 9110 12.5.3) contains the coding, or "*", with a weight above zero. False
 * for NULL. */
bool kd_accepts_coding(const char *accept_encoding, const char *coding);

/* True if an If-None-Match header is "*" or contains the entity tag (given with its quotes), by weak comparison. */
bool kd_etag_listed(const char *if_none_match, const char *etag);

/* True if an If-Match header is "*" or contains the entity tag, by strong comparison. etag NULL: the resource has no
 * tag. */
bool kd_etag_matches(const char *if_match, const char *etag);

/* True if a Content-Type value is this media type; parameters are ignored. */
bool kd_media_type_is(const char *content_type, const char *type);

/* True if a Host value is well formed: a non-empty host, optionally followed by a port (RFC 3986 3.2.2). */
bool kd_host_is_sound(const char *host);
/* True if the host of a Host value is one of the NULL-terminated names. The port and a final dot are ignored. IPv6
 * literals have brackets. */
bool kd_host_listed(const char *host, const char *const *names);

#endif
