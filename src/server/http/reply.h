/* Builds and sends answers. Every answer has the same basic headers, and a deadline until which the client must have
 * read it. HTTP thread only. Functions with the type MHD_Result return MHD_NO when out of memory; the connection is
 * then closed. */
#ifndef KD_SERVER_HTTP_REPLY_H
#define KD_SERVER_HTTP_REPLY_H

#include "server/http/negotiate.h"
#include "server/http/problem.h"
#include "server/http/request.h"

/* Makes a response from the bytes of the buffer. The buffer is empty afterwards, even on failure. Returns NULL on
 * failure. */
struct MHD_Response *kd_reply_take(struct kd_buffer *body, const char *type);
/* Like kd_reply_take, for text, which is compressed by gzip if the client accepts that and the text is long enough. */
struct MHD_Response *kd_reply_text(struct kd_request *request, struct kd_buffer *body, const char *type);
/* Makes a response from bytes that must stay valid as long as the response. type NULL: there is no content, so
 * Content-Type is not sent. */
struct MHD_Response *kd_reply_static(const void *data, size_t size, const char *type);
/* Makes a response without a body. It is for HEAD and 304 if the length of the body of GET is unknown. Closes the
 * connection. */
struct MHD_Response *kd_reply_empty(const char *type);

/* Sets the file name (Content-Disposition) of the answer to this request. Browsers display KD_INLINE, and save
 * KD_ATTACHMENT. */
enum kd_disposition { KD_INLINE, KD_ATTACHMENT };
void kd_reply_file(struct kd_request *request, enum kd_disposition disposition, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Adds Location, the address of the object that this request has made. It is relative to the address of the request,
 * such as "sessions/ID" for /v1/sessions, so that it is valid behind a proxy that changes the prefix. response may
 * be NULL. */
void kd_reply_location(const struct kd_request *request, struct MHD_Response *response, const char *id);

/* Queues the response and drops its reference. If response is NULL, sends kd_reply_no_memory instead. */
enum MHD_Result kd_reply_send(struct kd_request *request, unsigned status, struct MHD_Response *response);

/* kd_reply_bare and kd_reply_no_memory send 503 without allocating memory, and close the connection. They are used
 * when memory has run out. kd_reply_bare needs no request. */
enum MHD_Result kd_reply_bare(struct MHD_Connection *mhd);
enum MHD_Result kd_reply_no_memory(struct kd_request *request);
enum MHD_Result kd_reply_problem(struct kd_request *request, const struct kd_problem *problem);
/* Sends an answer with the status and the headers of the problem, but with another body. */
enum MHD_Result kd_reply_refuse(struct kd_request *request, const struct kd_problem *problem,
                                struct MHD_Response *response);
/* Evaluates If-Match against the ETag of the resource (RFC 9110 13.1.1); etag NULL: the resource has none. Returns
 * true if there is no If-Match. Handlers that change something must call this before the change. For all other
 * handlers, kd_reply_send does it. */
bool kd_reply_matches(struct kd_request *request, const char *etag);
enum MHD_Result kd_reply_unmatched(struct kd_request *request);
/* Answers OPTIONS with 204. Allow lists these methods. */
enum MHD_Result kd_reply_options(struct kd_request *request, const char *allow);
/* Sends the problem that kd_problem_from makes of the error. */
enum MHD_Result kd_reply_error(struct kd_request *request, const struct kd_error *error);
/* Ends a request whose work was cancelled (KD_ECANCELLED). If the server is stopping, sends 503. Otherwise the
 * client has disconnected, and nothing is sent. */
enum MHD_Result kd_reply_cancelled(struct kd_request *request);

/* Joins all values of a request header that is a list, separated by commas. The result is empty if the header is
 * absent, or if memory has run out. */
struct kd_buffer kd_reply_header_list(struct kd_request *request, const char *name);
/* Calls kd_accept_best with the request's Accept header. */
size_t kd_reply_accepted(struct kd_request *request, size_t n, const char *(*type)(size_t i, const void *list),
                         const void *list);
/* Appends a name to the value of a header that is a List of Tokens (RFC 9651). */
enum kd_status kd_reply_item(struct kd_buffer *out, const char *name);

/* Sends a generated document, or the problem if status is an error. The buffer is empty afterwards. */
enum MHD_Result kd_reply_json(struct kd_request *request, enum kd_status status, struct kd_buffer *json,
                              const char *type);

#endif
