/* This answers for what libmicrohttpd refuses by itself: what it cannot read as HTTP, before it asks us or in the
 * middle of a body. It answers with a page of HTML of its own (0.9.75 with two headers for a Content-Length that is
 * no number), and has no hook that names the connection: it only writes a line to its log. Its thread works on one
 * connection at a time, so the one at fault is the one whose bytes that thread has read last, or that it asked us
 * about since. That one gets a problem document before the library's page, for which its socket then takes no more.
 * docs/decisions/0006-answers-of-the-library.md says why. */
#ifndef KD_SERVER_HTTP_LIBRARY_H
#define KD_SERVER_HTTP_LIBRARY_H

#include <stdarg.h>

/* The calling thread now works on the connection of this socket. Called in each callback of the library. */
void kd_library_works_on(int socket);

/* The function for MHD_OPTION_EXTERNAL_LOGGER. connections: the struct kd_connections that the sockets are found in. */
void kd_library_log(void *connections, const char *format, va_list args);

#endif
