/* The listening socket has a thread of its own. It accepts, looks at the first bytes of a connection without taking
 * them, and hands the connection to one of two daemons of libmicrohttpd: that of the health routes, or that of
 * everything else. So neither a busy HTTP thread nor connections at their limit can hold up /healthz, /readyz and
 * /metrics, which stay on the port they share. */
#ifndef KD_SERVER_HTTP_FRONT_H
#define KD_SERVER_HTTP_FRONT_H

#include "base/error.h"
#include "server/http/base_path.h"
#include "server/http/connections.h"

#include <microhttpd.h>

struct kd_front;

struct kd_front_params {
    int listener; /* non-blocking; the front closes it, also when it cannot be created */
    struct kd_connections *connections;
    const struct kd_base_path *base;    /* outlives the front */
    struct MHD_Daemon *health, *others; /* without listening sockets; they outlive the front */
};

enum kd_status kd_front_create(const struct kd_front_params *params, struct kd_front **out, struct kd_error *error);
/* Stop listening, and close the connections that have not said anything yet. Accepts NULL. */
void kd_front_destroy(struct kd_front *front);

#endif
