#include "server/http/client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>

#define NETWORK 8 /* number of leading bytes of an IPv6 address that identify the network */

static void name_of_v4(const struct in_addr *address, char out[KD_CLIENT])
{
    if (!inet_ntop(AF_INET, address, out, KD_CLIENT))
        *out = 0;
}

static void name_of_v6(const struct in6_addr *address, char out[KD_CLIENT])
{
    struct in_addr v4;
    struct in6_addr network = *address;
    if (IN6_IS_ADDR_V4MAPPED(address)) {
        memcpy(&v4, address->s6_addr + 12, sizeof v4);
        name_of_v4(&v4, out);
        return;
    }
    bool whole = IN6_IS_ADDR_LOOPBACK(address);
    if (!whole)
        memset(network.s6_addr + NETWORK, 0, sizeof network.s6_addr - NETWORK);
    if (!inet_ntop(AF_INET6, &network, out, KD_CLIENT))
        *out = 0;
    else if (!whole)
        strncat(out, "/64", KD_CLIENT - strlen(out) - 1);
}

void kd_client_of(struct MHD_Connection *mhd, char out[KD_CLIENT])
{
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
    kd_client_at(info ? info->client_addr : NULL, out);
}

void kd_client_named(const char *name, char out[KD_CLIENT]) { snprintf(out, KD_CLIENT, "token %s", name); }

void kd_client_at(const struct sockaddr *address, char out[KD_CLIENT])
{
    *out = 0;
    if (address && address->sa_family == AF_INET)
        name_of_v4(&((const struct sockaddr_in *)(const void *)address)->sin_addr, out);
    else if (address && address->sa_family == AF_INET6)
        name_of_v6(&((const struct sockaddr_in6 *)(const void *)address)->sin6_addr, out);
}
