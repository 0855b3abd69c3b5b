/* Replaces libmicrohttpd's own error pages by problem documents. The library itself answers input that it cannot
 * parse as HTTP, before it calls a handler or in the middle of a body. It has no hook that names the connection; it
 * only logs a line. Its thread works on one connection at a time. So the connection at fault is the one from which
 * the library read last, or for which it last called one of our callbacks. That connection is sent a problem
 * document. Its socket then takes no more bytes, so that the library's page is dropped.
 * docs/decisions/0006-answers-of-the-library.md has the reasons. */
#ifndef KD_SERVER_HTTP_LIBRARY_H
#define KD_SERVER_HTTP_LIBRARY_H

#include <stdarg.h>

/* Records that the calling thread works on the connection of this socket from now on. Called in each callback of
 * the library. */
void kd_library_works_on(int socket);

/* Callback for MHD_OPTION_EXTERNAL_LOGGER. connections: the struct kd_connections of the server. */
void kd_library_log(void *connections, const char *format, va_list args);

#endif
