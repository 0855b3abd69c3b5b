/* The identity of a client, for shares and limits. With a token file, a client is identified by the name of its
 * token. Without a token file, a client is identified by its IPv4 address, or by the first 64 bits of its IPv6
 * address, because one host controls all the other bits. Limits on connections always use the address. Without
 * tokens, all users behind a proxy count as one client. */
#ifndef KD_SERVER_HTTP_CLIENT_H
#define KD_SERVER_HTTP_CLIENT_H

#include "server/http/shares.h"

#include <microhttpd.h>

/* Writes the identity by address; "" if the address is unknown. All clients with unknown addresses count as one. */
void kd_client_of(struct MHD_Connection *mhd, char out[KD_CLIENT]); /* HTTP thread only */
/* Writes the identity of the owner of an access token. It never equals the text of an address. */
void kd_client_named(const char *name, char out[KD_CLIENT]);
void kd_client_at(const struct sockaddr *address, char out[KD_CLIENT]);

#endif
