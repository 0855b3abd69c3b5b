#include "server/http/listen.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

union address {
    struct sockaddr any;
    struct sockaddr_in v4;
    struct sockaddr_in6 v6;
};

static socklen_t parse(const char *text, uint16_t port, union address *out)
{
    char bare[64];
    size_t n = strlen(text);

    memset(out, 0, sizeof *out);
    if (n > 2 && *text == '[' && text[n - 1] == ']')
        snprintf(bare, sizeof bare, "%.*s", (int)(n - 2 < sizeof bare ? n - 2 : 0), text + 1);
    else
        snprintf(bare, sizeof bare, "%s", n < sizeof bare ? text : "");
    if (inet_pton(AF_INET, bare, &out->v4.sin_addr) == 1) {
        out->v4.sin_family = AF_INET;
        out->v4.sin_port = htons(port);
        return sizeof out->v4;
    }
    if (inet_pton(AF_INET6, bare, &out->v6.sin6_addr) == 1) {
        out->v6.sin6_family = AF_INET6;
        out->v6.sin6_port = htons(port);
        return sizeof out->v6;
    }
    return 0;
}

bool kd_listen_reaches_out(const char *address)
{
    union address where;
    if (!parse(address, 0, &where))
        return false;
    return where.any.sa_family == AF_INET6 ? !IN6_IS_ADDR_LOOPBACK(&where.v6.sin6_addr)
                                           : ntohl(where.v4.sin_addr.s_addr) >> 24 != IN_LOOPBACKNET;
}

static int bound(int fd, union address *address, socklen_t *size)
{
    int on = 1;
    if (setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) ||
        (address->any.sa_family == AF_INET6 && setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on)) ||
        bind(fd, &address->any, *size) || listen(fd, SOMAXCONN))
        return -1;
    return getsockname(fd, &address->any, size);
}

enum kd_status kd_listen_open(const char *address, uint16_t *port, int *out, struct kd_error *error)
{
    union address where;
    socklen_t size = parse(address, *port, &where);

    if (!size)
        return kd_error_set(error, KD_EINVAL, "%.100s is not a numeric IPv4 or IPv6 address", address);
    int fd = socket(where.any.sa_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0)
        return kd_error_set(error, KD_EIO, "no socket: %s", strerror(errno));
    if (bound(fd, &where, &size)) {
        kd_error_set(error, KD_EIO, "cannot listen on %.100s port %u: %s", address, *port, strerror(errno));
        close(fd);
        return KD_EIO;
    }
    *port = ntohs(where.any.sa_family == AF_INET6 ? where.v6.sin6_port : where.v4.sin_port);
    *out = fd;
    return KD_OK;
}
