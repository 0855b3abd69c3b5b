/* Builds and sends answers. Every answer has the same basic headers and a deadline by which the client must take it.
 * HTTP thread only.
 *
 * Functions that return an MHD_Result return MHD_NO when memory ran out, which closes the connection. */
#ifndef KD_SERVER_HTTP_REPLY_H
#define KD_SERVER_HTTP_REPLY_H

#include "server/http/negotiate.h"
#include "server/http/problem.h"
#include "server/http/request.h"

/* A response with the buffer's bytes, which it takes over (the buffer is empty afterwards, also on failure);
 * NULL on failure. */
struct MHD_Response *kd_reply_take(struct kd_buffer *body, const char *type);
/* The same for text, which goes as gzip where the client takes that and it pays. */
struct MHD_Response *kd_reply_text(struct kd_request *request, struct kd_buffer *body, const char *type);
/* A response with bytes that outlive it; type NULL: there are none. */
struct MHD_Response *kd_reply_static(const void *data, size_t size, const char *type);
/* A response for HEAD and 304, where the length of what a GET would give is not known. Closes the connection. */
struct MHD_Response *kd_reply_empty(const char *type);

/* The name under which this request's answer is saved. A browser shows what is inline and saves what is an
 * attachment. */
enum kd_disposition { KD_INLINE, KD_ATTACHMENT };
void kd_reply_file(struct kd_request *request, enum kd_disposition disposition, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Adds Location: the address of what this request has made. It is relative to the request's own, "sessions/ID" to
 * /v1/sessions, so that it holds whatever a proxy puts before or takes away. NULL is accepted. */
void kd_reply_location(const struct kd_request *request, struct MHD_Response *response, const char *id);

/* Queue the response and give up the reference; NULL: kd_reply_no_memory. */
enum MHD_Result kd_reply_send(struct kd_request *request, unsigned status, struct MHD_Response *response);

/* Sends 503 where memory ran out for anything else: it takes none of ours. Closes the connection. The first function
 * needs not even a request. */
enum MHD_Result kd_reply_bare(struct MHD_Connection *mhd);
enum MHD_Result kd_reply_no_memory(struct kd_request *request);
enum MHD_Result kd_reply_problem(struct kd_request *request, const struct kd_problem *problem);
/* Sends the problem's status and headers with a body of one's own. */
enum MHD_Result kd_reply_refuse(struct kd_request *request, const struct kd_problem *problem,
                                struct MHD_Response *response);
/* Whether the request's If-Match, if it has one, holds for what has this ETag; NULL: it has none (RFC 9110 13.1.1).
 * What changes something asks before it does; answers of all else are checked when they are sent. */
bool kd_reply_matches(struct kd_request *request, const char *etag);
enum MHD_Result kd_reply_unmatched(struct kd_request *request);
/* Answers OPTIONS: 204, with these methods as Allow. */
enum MHD_Result kd_reply_options(struct kd_request *request, const char *allow);
/* Sends what kd_problem_from makes of the error. */
enum MHD_Result kd_reply_error(struct kd_request *request, const struct kd_error *error);
/* Of work that was cancelled (KD_ECANCELLED): 503 where the way down has ended it; else its client has gone, and
 * nothing is sent. */
enum MHD_Result kd_reply_cancelled(struct kd_request *request);
/* Whether kd_target_only holds; if not *refused is the answer. */
bool kd_reply_only(struct kd_request *request, const char *const *known, enum MHD_Result *refused);

/* All values of a request header that is a list, joined by commas; empty when it is absent or memory ran out. */
struct kd_buffer kd_reply_header_list(struct kd_request *request, const char *name);
/* kd_accept_best of what the request accepts. */
size_t kd_reply_accepted(struct kd_request *request, size_t n, const char *(*type)(size_t i, const void *list),
                         const void *list);
/* Append a name to a header that is a List of Tokens (RFC 9651). */
enum kd_status kd_reply_item(struct kd_buffer *out, const char *name);

/* A generated document, or the problem of not having generated it. Empties the buffer. */
enum MHD_Result kd_reply_json(struct kd_request *request, enum kd_status status, struct kd_buffer *json,
                              const char *type);

#endif
