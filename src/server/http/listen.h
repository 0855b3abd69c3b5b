/* Opens a listening TCP socket on a numeric address. */
#ifndef KD_SERVER_HTTP_LISTEN_H
#define KD_SERVER_HTTP_LISTEN_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

/* True if a socket that listens on the address can be reached from other machines. False if the text is not a
 * numeric address. */
bool kd_listen_reaches_out(const char *address);
/* Opens the socket. address: "127.0.0.1", "::1" or "[::1]". *port 0 is replaced by the port that the system chose. The
 * caller closes *out. */
enum kd_status kd_listen_open(const char *address, uint16_t *port, int *out, struct kd_error *error);

#endif
