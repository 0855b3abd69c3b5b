/* Replaces libmicrohttpd's own error pages by problem documents. The library answers by itself what it cannot parse as
 * HTTP, before it calls a handler or in the middle of a body. It has no hook that names the connection; it only logs a
 * line. Since its thread works on one connection at a time, the connection at fault is the one it read from, or asked
 * us about, last. That connection gets a problem document first, and its socket then takes no more bytes, so the
 * library's page is dropped. docs/decisions/0006-answers-of-the-library.md has the reasons. */
#ifndef KD_SERVER_HTTP_LIBRARY_H
#define KD_SERVER_HTTP_LIBRARY_H

#include <stdarg.h>

/* The calling thread now works on the connection of this socket. Called in each callback of the library. */
void kd_library_works_on(int socket);

/* Callback for MHD_OPTION_EXTERNAL_LOGGER. connections: the struct kd_connections of the server. */
void kd_library_log(void *connections, const char *format, va_list args);

#endif
