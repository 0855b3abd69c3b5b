/* Replaces libmicrohttpd's own error pages by problem documents. If input is not valid HTTP, the library answers it
 * without calling a handler, or in the middle of a body. It has no hook that identifies the connection; it only logs
 * a line. But each of its threads works on one connection at a time. Therefore the connection at fault is the one
 * from which the library read last, or for which it last called one of our callbacks. A problem document is sent to
 * that connection. Its socket is then shut down for writing, so the library's own page is dropped. For the reasons
 * see docs/decisions/0006-answers-of-the-library.md. */
#ifndef KD_SERVER_HTTP_LIBRARY_H
#define KD_SERVER_HTTP_LIBRARY_H

#include <stdarg.h>

/* Records that from now on the calling thread works on the connection of this socket. Called in every callback of
 * the library. */
void kd_library_works_on(int socket);

/* Callback for MHD_OPTION_EXTERNAL_LOGGER. connections: the struct kd_connections of the server. */
void kd_library_log(void *connections, const char *format, va_list args);

#endif
