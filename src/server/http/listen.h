/* Opens a listening TCP socket on a numeric address. */
#ifndef KD_SERVER_HTTP_LISTEN_H
#define KD_SERVER_HTTP_LISTEN_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

/* address: "127.0.0.1", "::1" or "[::1]"; *port 0 is replaced by the one chosen. The caller closes *out. */
/* Whether other machines reach what listens there; false, too, of what is no numeric address. */
bool kd_listen_reaches_out(const char *address);
enum kd_status kd_listen_open(const char *address, uint16_t *port, int *out, struct kd_error *error);

#endif
