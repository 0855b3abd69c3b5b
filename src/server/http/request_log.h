/* Logs each finished request as one line at level info. HTTP threads only. */
#ifndef KD_SERVER_HTTP_REQUEST_LOG_H
#define KD_SERVER_HTTP_REQUEST_LOG_H

#include "server/http/request.h"

/* Call this when the request begins. It records the connection's byte count. */
void kd_request_log_begin(struct kd_request *request);
/* Writes the line. A text line has method, target, status, time and client. A JSON line has id, method, route,
 * status, ms, bytes, client, visitor and cut_off. `bytes` is the number of bytes that were written to the socket,
 * including the header, if the system counts them. The JSON line has the route instead of the target, because
 * readers of the log could misuse the ids of sessions and jobs in a target. */
void kd_request_log_end(const struct kd_request *request, double ms, bool cut_off);

#endif
