/* Request IDs. The same ID appears in the log, in the answer, and in the records of proxies and clients. Any thread. */
#ifndef KD_SERVER_HTTP_REQUEST_ID_H
#define KD_SERVER_HTTP_REQUEST_ID_H

#include <stdbool.h>

#define KD_REQUEST_ID_HEADER "X-Request-Id"
#define KD_REQUEST_ID_MAX 64 /* characters */

/* True if a client's ID is accepted: 1 to KD_REQUEST_ID_MAX letters, digits and -._+/=. False for NULL. */
bool kd_request_id_is_sane(const char *given);
/* Copies the client's ID if it is accepted; otherwise makes an ID of 32 hexadecimal digits. The result is "" if
 * there are no random numbers. */
void kd_request_id_choose(const char *given, char out[KD_REQUEST_ID_MAX + 1]);

#endif
