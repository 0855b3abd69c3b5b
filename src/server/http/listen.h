/* Opens a listening TCP socket on a numeric address. */
#ifndef KD_SERVER_HTTP_LISTEN_H
#define KD_SERVER_HTTP_LISTEN_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

/* True if other machines can reach a socket that listens on this address. False if the text is not a numeric
 * address. */
bool kd_listen_reaches_out(const char *address);
/* Opens the socket. address: for example "127.0.0.1", "::1" or "[::1]". *port: if 0, it is replaced by the port that
 * the system has chosen. The caller closes *out. */
enum kd_status kd_listen_open(const char *address, uint16_t *port, int *out, struct kd_error *error);

#endif
