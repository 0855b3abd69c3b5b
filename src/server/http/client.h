/* Client identity, for shares and limits. With a token file, a client is the name of its token, wherever it connects
 * from. Without one, and for limits on connections, a client is its IPv4 address, or the first 64 bits of its IPv6
 * address, since a host controls the rest. Without tokens, everything behind one proxy is one client. */
#ifndef KD_SERVER_HTTP_CLIENT_H
#define KD_SERVER_HTTP_CLIENT_H

#include "server/http/shares.h"

#include <microhttpd.h>

/* Writes "" if the address is unknown; all such clients count as one. */
void kd_client_of(struct MHD_Connection *mhd, char out[KD_CLIENT]); /* HTTP thread only */
/* Client name for the owner of an access token. It never equals the text of an address. */
void kd_client_named(const char *name, char out[KD_CLIENT]);
void kd_client_at(const struct sockaddr *address, char out[KD_CLIENT]);

#endif
