/* Logs each finished request as one line of level info. HTTP threads. */
#ifndef KD_SERVER_HTTP_REQUEST_LOG_H
#define KD_SERVER_HTTP_REQUEST_LOG_H

#include "server/http/request.h"

/* Called when the request begins: where its bytes are counted from. */
void kd_request_log_begin(struct kd_request *request);
/* As text: method, target, status, time, who. As JSON: id, method, route, status, ms, bytes (those that went to the
 * socket, header and all, where the system counts them), client, visitor, cut_off. What a target names is told by
 * its route: ids of sessions and jobs are capabilities. */
void kd_request_log_end(const struct kd_request *request, double ms, bool cut_off);

#endif
