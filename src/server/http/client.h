/* A client is whom a request is from, for shares and limits. With a token file it is known by the name of its token,
 * wherever it comes from. Else, and for connections, it is known by where it comes from: an IPv4 address, or the
 * first half of an IPv6 address, since a host has all of the other half. All that comes through a proxy is one
 * client then. */
#ifndef KD_SERVER_HTTP_CLIENT_H
#define KD_SERVER_HTTP_CLIENT_H

#include "server/http/shares.h"

#include <microhttpd.h>

/* "" where it cannot be told: all of those are one client. */
void kd_client_of(struct MHD_Connection *mhd, char out[KD_CLIENT]); /* HTTP thread only */
/* The client that has a token of this name: no address is called so. */
void kd_client_named(const char *name, char out[KD_CLIENT]);
void kd_client_at(const struct sockaddr *address, char out[KD_CLIENT]);

#endif
