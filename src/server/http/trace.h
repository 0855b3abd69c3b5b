/* Parses the header traceparent (W3C Trace Context, section 3.2). The trace is logged with the request. Pure; any
 * thread. */
#ifndef KD_SERVER_HTTP_TRACE_H
#define KD_SERVER_HTTP_TRACE_H

#include <stdbool.h>

struct kd_traceparent { char trace_id[33], parent_id[17]; /* "": none */ };

/* Returns false, and sets *out to empty texts, if value is NULL or malformed. */
bool kd_trace_read(const char *value, struct kd_traceparent *out);

#endif
