/* Passes requests from libmicrohttpd to the handlers of routes. Receives and checks header and body, and cancels the
 * work of clients that disconnect. HTTP thread only. */
#ifndef KD_SERVER_DISPATCH_H
#define KD_SERVER_DISPATCH_H

#include <microhttpd.h>

/* Callbacks for libmicrohttpd; cls is the struct kd_server. */
void *kd_request_open(void *cls, const char *uri, struct MHD_Connection *mhd);
enum MHD_Result kd_request_handle(void *cls, struct MHD_Connection *mhd, const char *url, const char *method,
                                  const char *version, const char *data, size_t *size, void **state);
void kd_request_close(void *cls, struct MHD_Connection *mhd, void **state, enum MHD_RequestTerminationCode why);
void kd_request_connection(void *cls, struct MHD_Connection *mhd, void **socket_context,
                           enum MHD_ConnectionNotificationCode what);

#endif
