/* Logs each finished request as one line at level info. HTTP threads only. */
#ifndef KD_SERVER_HTTP_REQUEST_LOG_H
#define KD_SERVER_HTTP_REQUEST_LOG_H

#include "server/http/request.h"

/* Call it when the request begins: it records the connection's byte count. */
void kd_request_log_begin(struct kd_request *request);
/* Writes the line. A text line has method, target, status, time and client. A JSON line has id, method, route,
 * status, ms, bytes, client, visitor and cut_off. `bytes` is the number of bytes written to the socket, including
 * the header, if the system counts them. JSON has the route instead of the target, because whoever reads the log
 * could use the ids of sessions and jobs in a target. */
void kd_request_log_end(const struct kd_request *request, double ms, bool cut_off);

#endif
