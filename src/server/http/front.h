/* Accepts connections on the listening socket, on a thread of its own. It peeks at the first bytes of each connection,
 * and hands the connection to one of two libmicrohttpd daemons. One daemon serves the health routes, and the other
 * serves all other routes. Therefore /healthz, /readyz and /metrics are delayed neither by a busy HTTP thread nor by an
 * exhausted limit of connections, although all routes share one port. */
#ifndef KD_SERVER_HTTP_FRONT_H
#define KD_SERVER_HTTP_FRONT_H

#include "base/error.h"
#include "server/http/base_path.h"
#include "server/http/connections.h"

#include <microhttpd.h>

struct kd_front;

struct kd_front_params {
    int listener; /* listening socket, non-blocking; the front closes it, even if kd_front_create fails */
    struct kd_connections *connections;
    const struct kd_base_path *base;    /* outlives the front */
    struct MHD_Daemon *health, *others; /* daemons without listening sockets; they outlive the front */
};

enum kd_status kd_front_create(const struct kd_front_params *params, struct kd_front **out, struct kd_error *error);
/* Stops listening, and closes all connections that were not handed over yet. Accepts NULL. */
void kd_front_destroy(struct kd_front *front);

#endif
