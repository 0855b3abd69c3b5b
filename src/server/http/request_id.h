/* Request IDs: the log line, the answer and the records of proxies and clients carry the same ID. Any thread. */
#ifndef KD_SERVER_HTTP_REQUEST_ID_H
#define KD_SERVER_HTTP_REQUEST_ID_H

#include <stdbool.h>

#define KD_REQUEST_ID_HEADER "X-Request-Id"
#define KD_REQUEST_ID_MAX 64 /* characters */

/* Whether an id that came with a request is taken: 1 to KD_REQUEST_ID_MAX letters, digits and -._+/=. NULL is none. */
bool kd_request_id_is_sane(const char *given);
/* The one that came with it, if it is sane, else a new one of 32 hexadecimal digits; "" if there are no random
 * numbers. */
void kd_request_id_choose(const char *given, char out[KD_REQUEST_ID_MAX + 1]);

#endif
